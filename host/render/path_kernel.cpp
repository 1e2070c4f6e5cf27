#include "host/render/path_kernel.h"

#include <algorithm>
#include <cassert>

#include "host/render/kernel_setup.h"
#include "shaders/embedded.h"

namespace duolux {

namespace {

std::vector<Specialization> specialize(const DeviceScene& deviceScene, const Scene& scene, bool closedForm) {
    std::uint32_t directLight = closedForm ? shared::kDirectLightClosedForm : shared::kDirectLightSampled;
    if (deviceScene.lightCount == 0) directLight = shared::kDirectLightNone;
    std::vector<Specialization> constants = sceneSpecialization(deviceScene, scene);
    constants.push_back({shared::kSpecDirectLight, directLight});
    constants.push_back({shared::kSpecHasEmitters, deviceScene.hasEmitters});
    return constants;
}

std::vector<Binding> pathBindings(std::vector<Binding> bindings, const Buffer& pixels, const Buffer& results,
                                  const Teams& teams) {
    bindings.push_back({shared::kBindingPixels, &pixels});
    bindings.push_back({shared::kBindingResults, &results});
    bindings.push_back({shared::kBindingTeams, &teams.progress()});
    return bindings;
}

}  // namespace

PathKernel::PathKernel(const Device& device, const DeviceScene& deviceScene, const Scene& scene,
                       std::span<const std::uint32_t> pixels, std::uint32_t maxSlots, bool closedForm)
    : laneSamples_(lanePaths(deviceScene)),
      maxSlots_(maxSlots),
      pixels_(pixels),
      teams_(device, deviceScene.tuning, maxSlots),
      params_(uploadParams(device, deviceScene, scene)),
      pixelOrder_(Buffer::upload(device, BufferUse::kTexels, pixels, "pixel order")),
      results_(Buffer::readback(device, 2 * sizeof(shared::SlotResult) * std::uint64_t{maxSlots}, "results")),
      kernel_(device, "path",
              variantFor(deviceScene.tuning.layout, spirv::kPathKernelTexel, spirv::kPathKernelStorage,
                         spirv::kPathKernelRayQuery),
              pathBindings(sceneBindings(deviceScene, params_), pixelOrder_, results_, teams_),
              specialize(deviceScene, scene, closedForm), sizeof(shared::DispatchParams)),
      commands_{CommandSlot(device), CommandSlot(device)} {}

std::uint64_t PathKernel::deviceBytes() const {
    return params_.allocated() + pixelOrder_.allocated() + results_.allocated() + teams_.deviceBytes();
}

void PathKernel::submit(unsigned place, const WorkRange& range) {
    assert(range.slots <= maxSlots_ && range.samples <= std::min(kMaxSamples, laneSamples_));
    const std::uint32_t teamSlots = teams_.share(range.slots, laneSamples_ / range.samples);
    submitted_[place] = {range, teamSlots};
    const shared::DispatchParams push{range.firstSlot,        range.slots, range.firstSample,
                                      range.samples,          teamSlots,   place * maxSlots_,
                                      teams_.firstTeam(place)};
    commands_[place].submit("tracing paths", [&](const vk::raii::CommandBuffer& commands) {
        teams_.record(commands, kernel_, push, place, range.slots, teamSlots);
    });
}

PathKernel::Results PathKernel::wait(unsigned place) {
    const double seconds = commands_[place].wait("tracing paths");
    const auto& [range, teamSlots] = submitted_[place];
    return {range, teamSlots / teams_.lanes() * range.samples, teams_.complete(place), seconds};
}

PathKernel::Totals PathKernel::addTo(Film& film, unsigned place) {
    results_.invalidate();
    const WorkRange& range = submitted_[place].range;
    const auto* slots =
        reinterpret_cast<const shared::SlotResult*>(results_.mapped()) + std::size_t{place} * maxSlots_;
    Totals totals;
    sums_.resize(range.slots);
    for (std::size_t i = 0; i < range.slots; ++i) {
        const shared::SlotResult& r = slots[i];
        for (std::size_t c = 0; c < 3; ++c) {
            sums_[i].invisible[c] = signed64(r.invisible[2 * c], r.invisible[2 * c + 1]);
            sums_[i].visible[c] = signed64(r.visible[2 * c], r.visible[2 * c + 1]);
        }
        totals.nonFinite += r.nonFinite;
        totals.clamped = totals.clamped || r.clamped > 0;
        totals.cameraRays += r.cameraRays;
        totals.bounceRays += r.bounceRays;
        totals.shadowRays += r.shadowRays;
        totals.emitterRays += r.emitterRays;
        totals.lastBounce += static_cast<double>(r.lastBounce);
        totals.previousBounce += static_cast<double>(r.previousBounce);
    }
    film.add(pixels_.subspan(range.firstSlot, range.slots), sums_, range.samples);
    return totals;
}

}  // namespace duolux

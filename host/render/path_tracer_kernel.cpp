#include "host/render/path_tracer_kernel.h"

#include <algorithm>
#include <cassert>

#include "shaders/embedded.h"

namespace duolux {

namespace {

std::vector<Binding> pathBindings(std::vector<Binding> bindings, const Buffer& pixels, const Buffer& results,
                                  const Buffer& layerResults, const Teams& teams) {
    bindings.push_back({shared::kBindingPixels, &pixels});
    bindings.push_back({shared::kBindingResults, &results});
    bindings.push_back({shared::kBindingLayers, &layerResults});
    bindings.push_back({shared::kBindingTeams, &teams.progress()});
    return bindings;
}

/// Pixels of a grid over the image, at most 64 x 64.
std::vector<std::uint32_t> gridPixels(std::uint32_t width, std::uint32_t height) {
    constexpr std::uint32_t kMost = 64;
    const std::uint32_t columns = std::min(width, kMost), rows = std::min(height, kMost);
    std::vector<std::uint32_t> pixels;
    for (std::uint32_t row = 0; row < rows; ++row) {
        for (std::uint32_t column = 0; column < columns; ++column) {
            const std::uint32_t x = (2 * column + 1) * width / (2 * columns);
            const std::uint32_t y = (2 * row + 1) * height / (2 * rows);
            pixels.push_back(y * width + x);
        }
    }
    return pixels;
}

Buffer uploadPixels(const Device& device, std::span<const std::uint32_t> pixels,
                    std::span<const std::uint32_t> look) {
    std::vector<std::uint32_t> all(pixels.begin(), pixels.end());
    all.insert(all.end(), look.begin(), look.end());
    return Buffer::upload<std::uint32_t>(device, BufferUse::kTexels, all, "pixel order");
}

std::span<const std::uint32_t> chooseVariant(const DeviceScene& deviceScene) {
    const Layout layout = deviceScene.tuning.layout;
    return deviceScene.isPlain() ? variantFor(layout, spirv::kPathTracerPlainTexel,
                                              spirv::kPathTracerPlainStorage, spirv::kPathTracerPlainRayQuery)
                                 : variantFor(layout, spirv::kPathTracerTexel, spirv::kPathTracerStorage,
                                              spirv::kPathTracerRayQuery);
}

}  // namespace

std::vector<Specialization> pathTracerSpecialization(const RenderInputs& inputs, bool closedForm) {
    const DeviceScene& deviceScene = inputs.deviceScene;
    std::uint32_t directLight = closedForm ? shared::kDirectLightClosedForm : shared::kDirectLightSampled;
    if (deviceScene.transport.emitterChoices == 0) directLight = shared::kDirectLightNone;
    std::vector<Specialization> constants = sceneSpecialization(inputs);
    constants.push_back({shared::kSpecDirectLight, directLight});
    constants.push_back({shared::kSpecEmittingTriangles, !deviceScene.emittingTriangles.empty()});
    constants.push_back({shared::kSpecFilmLayers, inputs.settings.layers});
    return constants;
}

PathTracerKernel::PathTracerKernel(const RenderInputs& inputs, std::span<const std::uint32_t> pixels,
                                   std::uint32_t maxPixels, bool closedForm)
    : laneSamples_(lanePaths(inputs.deviceScene)),
      maxPixels_(maxPixels),
      lookPixels_(
          static_cast<std::uint32_t>(gridPixels(inputs.settings.width, inputs.settings.height).size())),
      pixels_(pixels),
      layerChannels_(channelsOf(inputs.settings.layers)),
      teams_(inputs.device, inputs.deviceScene.tuning, maxPixels),
      params_(uploadParams(inputs)),
      pixelOrder_(
          uploadPixels(inputs.device, pixels, gridPixels(inputs.settings.width, inputs.settings.height))),
      results_(Buffer::readback(inputs.device, 2 * sizeof(shared::PixelResult) * std::uint64_t{maxPixels},
                                "results")),
      // Without layers, a few bytes that are bound but not used.
      layerResults_(Buffer::readback(
          inputs.device,
          std::max(2 * sizeof(std::int64_t) * maxPixels * layerChannels_, sizeof(std::int64_t)), "layers")),
      kernel_(inputs.device, "path", chooseVariant(inputs.deviceScene),
              pathBindings(sceneBindings(inputs.deviceScene, params_), pixelOrder_, results_, layerResults_,
                           teams_),
              pathTracerSpecialization(inputs, closedForm), sizeof(shared::PathTracerDispatch)),
      commands_{CommandSlot(inputs.device), CommandSlot(inputs.device)} {}

std::uint64_t PathTracerKernel::deviceBytes() const {
    return params_.allocated() + pixelOrder_.allocated() + results_.allocated() + layerResults_.allocated() +
           teams_.deviceBytes();
}

void PathTracerKernel::submit(unsigned slot, const WorkRange& range, float quantum) {
    assert(range.pixels <= maxPixels_ && range.samples <= std::min(kMaxSamples, laneSamples_));
    const std::uint32_t teamPixels = teams_.share(range.pixels, laneSamples_ / range.samples);
    submitted_[slot] = {range, teamPixels};
    const shared::PathTracerDispatch push{range.firstPixel,       range.pixels,  range.firstSample,
                                          range.samples,          teamPixels,    slot * maxPixels_,
                                          teams_.firstTeam(slot), 1.0f / quantum};
    commands_[slot].submit("tracing paths", [&](const Commands& commands) {
        teams_.record(commands, kernel_, push, slot, range.pixels, teamPixels);
    });
}

PathTracerKernel::Results PathTracerKernel::wait(unsigned slot) {
    const double seconds = commands_[slot].wait("tracing paths");
    const auto& [range, teamPixels] = submitted_[slot];
    return {range, teamPixels / teams_.lanes() * range.samples, teams_.complete(slot), seconds};
}

PathTracerKernel::Totals PathTracerKernel::read(unsigned slot) {
    results_.invalidate();
    const WorkRange& range = submitted_[slot].range;
    const auto* results =
        reinterpret_cast<const shared::PixelResult*>(results_.mapped()) + std::size_t{slot} * maxPixels_;
    Totals totals;
    sums_.resize(range.pixels);
    for (std::size_t i = 0; i < range.pixels; ++i) {
        const shared::PixelResult& r = results[i];
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
    return totals;
}

PathTracerKernel::Totals PathTracerKernel::addTo(Film& film, unsigned slot) {
    const Totals totals = read(slot);
    const WorkRange& range = submitted_[slot].range;
    layerResults_.invalidate();
    const std::size_t count = std::size_t{range.pixels} * layerChannels_;
    const auto* words = reinterpret_cast<const std::uint32_t*>(layerResults_.mapped()) +
                        2 * std::size_t{slot} * maxPixels_ * layerChannels_;
    layerSums_.resize(count);
    for (std::size_t i = 0; i < count; ++i)
        layerSums_[i] = signed64(words[2 * i], words[2 * i + 1]);
    film.add(pixels_.subspan(range.firstPixel, range.pixels), sums_, range.samples, layerSums_);
    return totals;
}

FirstLook PathTracerKernel::look(unsigned slot) {
    FirstLook look;
    look.clamped = read(slot).clamped;
    look.samples = submitted_[slot].range.size();
    for (const Film::PixelSum& sum : sums_) {
        for (int c = 0; c < 3; ++c) {
            look.invisible += static_cast<double>(sum.invisible[c]) / 3.0;
            look.visible += static_cast<double>(sum.visible[c]) / 3.0;
        }
    }
    return look;
}

}  // namespace duolux

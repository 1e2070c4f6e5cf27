#include "host/render/light_tracer_kernel.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>

#include "host/base/error.h"
#include "shaders/embedded.h"

namespace duolux {

namespace {

constexpr std::uint64_t kPixelBytes = sizeof(Film::PixelSum);
static_assert(kPixelBytes == shared::kFilmSums * 8);

constexpr std::uint32_t kReadPixels = 1u << 20;  // pixels of the film that are read at a time

std::uint32_t chooseBandPixels(const RenderInputs& inputs, std::uint32_t limit) {
    const DeviceInfo& device = inputs.device.info();
    const auto [width, height] = std::pair(inputs.settings.width, inputs.settings.height);
    const std::uint64_t pixels = std::uint64_t{width} * height;
    // The other storage buffers: results and teams' progress and, with Layout::kStorage, nodes and triangles.
    const std::uint32_t others = inputs.deviceScene.tuning.layout == Layout::kStorage ? 4 : 2;
    const std::uint32_t bindable = device.maxStorageBuffers;
    const std::uint64_t bands = std::min(shared::kMaxFilmBands, bindable - std::min(bindable, others));
    std::uint64_t most = device.maxStorageBufferRange / kPixelBytes;
    if (limit > 0) most = std::min<std::uint64_t>(most, limit);
    if (pixels > most * bands) {
        throw DeviceError(
            fmt::format("{} ({}): a film of {}x{} pixels for light paths is too large; {} pixels can be "
                        "bound; the path tracer has no such limit",
                        device.name, device.driver, width, height, most * bands));
    }
    return static_cast<std::uint32_t>(std::min(pixels, most));
}

std::vector<Buffer> makeFilm(const Device& device, std::uint32_t pixels, std::uint32_t bandPixels) {
    std::vector<Buffer> bands;
    for (std::uint32_t first = 0; first < pixels; first += bandPixels) {
        bands.push_back(Buffer::device(device, BufferUse::kStorage,
                                       std::min(bandPixels, pixels - first) * kPixelBytes, "film"));
    }
    return bands;
}

std::vector<Binding> lightBindings(std::vector<Binding> bindings, const Buffer& results, const Teams& teams,
                                   const std::vector<Buffer>& film) {
    bindings.push_back({shared::kBindingResults, &results});
    bindings.push_back({shared::kBindingTeams, &teams.progress()});
    for (const Buffer& band : film)
        bindings.push_back({shared::kBindingFilm, &band});
    return bindings;
}

std::span<const std::uint32_t> chooseVariant(const Device& device, const DeviceScene& deviceScene,
                                             bool noInt64Atomics) {
    const Layout layout = deviceScene.tuning.layout;
    if (device.info().int64Atomics && !noInt64Atomics) {
        return deviceScene.isPlain()
                   ? variantFor(layout, spirv::kLightTracerInt64PlainTexel,
                                spirv::kLightTracerInt64PlainStorage, spirv::kLightTracerInt64PlainRayQuery)
                   : variantFor(layout, spirv::kLightTracerInt64Texel, spirv::kLightTracerInt64Storage,
                                spirv::kLightTracerInt64RayQuery);
    }
    return deviceScene.isPlain()
               ? variantFor(layout, spirv::kLightTracerPlainTexel, spirv::kLightTracerPlainStorage,
                            spirv::kLightTracerPlainRayQuery)
               : variantFor(layout, spirv::kLightTracerTexel, spirv::kLightTracerStorage,
                            spirv::kLightTracerRayQuery);
}

}  // namespace

std::vector<Specialization> lightTracerSpecialization(const RenderInputs& inputs, std::size_t bands,
                                                      std::uint32_t bandPixels) {
    std::vector<Specialization> constants = sceneSpecialization(inputs);
    constants.push_back(
        {shared::kSpecCameraTransparency, inputs.deviceScene.transport.traits.cameraTransparency});
    constants.push_back({shared::kSpecFilmBands, static_cast<std::uint32_t>(bands)});
    constants.push_back({shared::kSpecBandPixels, bandPixels});
    return constants;
}

LightTracerKernel::LightTracerKernel(const RenderInputs& inputs, std::uint32_t maxPaths,
                                     const TestLimits& limits)
    : device_(&inputs.device),
      lanePaths_(duolux::lanePaths(inputs.deviceScene)),
      maxPaths_(maxPaths),
      pixels_(inputs.settings.width * inputs.settings.height),
      bandPixels_(chooseBandPixels(inputs, limits.filmBandPixels)),
      readPixels_(std::min(bandPixels_, kReadPixels)),
      teams_(inputs.device, inputs.deviceScene.tuning, maxPaths),
      maxLanes_((maxPaths + teams_.lanes() - 1) / teams_.lanes() * teams_.lanes()),
      params_(uploadParams(inputs)),
      results_(Buffer::readback(inputs.device, 2 * sizeof(shared::LaneResult) * std::uint64_t{maxLanes_},
                                "results")),
      filmRead_(Buffer::readback(inputs.device, readPixels_ * kPixelBytes, "film")),
      film_(makeFilm(inputs.device, pixels_, bandPixels_)),
      kernel_(inputs.device, "light", chooseVariant(inputs.device, inputs.deviceScene, limits.noInt64Atomics),
              lightBindings(sceneBindings(inputs.deviceScene, params_), results_, teams_, film_),
              lightTracerSpecialization(inputs, film_.size(), bandPixels_),
              sizeof(shared::LightTracerDispatch)),
      commands_{CommandSlot(inputs.device), CommandSlot(inputs.device)} {
    clearFilm();
}

std::uint64_t LightTracerKernel::deviceBytes() const {
    std::uint64_t bytes =
        params_.allocated() + results_.allocated() + filmRead_.allocated() + teams_.deviceBytes();
    for (const Buffer& band : film_)
        bytes += band.allocated();
    return bytes;
}

void LightTracerKernel::submit(unsigned slot, const PathRange& range, float quantum) {
    assert(range.count > 0 && range.count <= maxPaths_);
    const std::uint32_t teamPaths = teams_.share(range.count, lanePaths_);
    const std::uint32_t lanes = (range.count + teamPaths - 1) / teamPaths * teams_.lanes();
    submitted_[slot] = {range, teamPaths, lanes};
    const shared::LightTracerDispatch push{static_cast<std::uint32_t>(range.first),
                                           static_cast<std::uint32_t>(range.first >> 32),
                                           range.count,
                                           teamPaths,
                                           slot * maxLanes_,
                                           teams_.firstTeam(slot),
                                           1.0f / quantum};
    commands_[slot].submit("tracing light paths", [&](const Commands& commands) {
        teams_.record(commands, kernel_, push, slot, range.count, teamPaths);
    });
}

LightTracerKernel::Results LightTracerKernel::wait(unsigned slot) {
    const double seconds = commands_[slot].wait("tracing light paths");
    results_.invalidate();
    const auto& [range, teamPaths, lanes] = submitted_[slot];
    const auto* results =
        reinterpret_cast<const shared::LaneResult*>(results_.mapped()) + std::size_t{slot} * maxLanes_;
    return {range, teamPaths / teams_.lanes(), teams_.complete(slot), {results, lanes}, seconds};
}

void LightTracerKernel::takeFilm(Film& film, bool& partly) {
    std::uint32_t bandBegin = 0;
    for (const Buffer& band : film_) {
        const std::uint32_t bandEnd = std::min(bandBegin + bandPixels_, pixels_);
        for (std::uint32_t first = bandBegin; first < bandEnd; first += readPixels_) {
            const std::uint32_t count = std::min(readPixels_, bandEnd - first);
            runOnce(*device_, "reading the film", [&](const Commands& commands) {
                commands.barrier(Work::kAll, Work::kTransfers);
                commands.copy(band, (first - bandBegin) * kPixelBytes, filmRead_, 0, count * kPixelBytes);
            });
            filmRead_.invalidate();
            film.addLightPathSums(first,
                                  {reinterpret_cast<const Film::PixelSum*>(filmRead_.mapped()), count});
            partly = first + count < pixels_;
        }
        bandBegin = bandEnd;
    }
}

void LightTracerKernel::clearFilm() {
    runOnce(*device_, "clearing the film", [&](const Commands& commands) {
        commands.barrier(Work::kAll, Work::kTransfers);
        for (const Buffer& band : film_)
            commands.fill(band, 0);
    });
}

}  // namespace duolux

#include "host/app/render_warnings.h"

#include <fmt/format.h>

#include <cmath>

#include "host/app/film_images.h"
#include "host/base/printable.h"
#include "host/device_scene/transport.h"
#include "shaders/shared/material_layout.h"

namespace duolux {

namespace {

std::string percent(double part, double whole) {
    const double value = 100.0 * part / whole;
    return value < 10.0 ? fmt::format("{:.2g} %", value) : fmt::format("{:.0f} %", value);
}

}  // namespace

const char* samplesName(const RenderSettings& settings) {
    return settings.integrator == Integrator::kLightTracer ? "light paths" : "samples";
}

std::vector<std::string> resultWarnings(const RenderSettings& settings, SampleRange samples,
                                        const RenderOutput& output, bool failed, bool interrupted) {
    const RenderStatistics& statistics = output.statistics;
    std::vector<std::string> warnings;
    const std::uint64_t pixels = std::uint64_t{settings.width} * settings.height;
    if (statistics.gaps) {
        warnings.emplace_back(
            "the samples of some pixels have gaps: no checkpoint is written, and an earlier one is kept");
    }
    if (statistics.stopped && !failed && !interrupted) {
        const auto taken = static_cast<double>(output.film.totalSamples() + output.film.lightPaths());
        warnings.push_back(fmt::format("stopped at the time limit after {:.4g} of {} {} per pixel",
                                       taken / static_cast<double>(pixels), samples.size(),
                                       samplesName(settings)));
    }
    if (statistics.cutOffByBounces()) {
        warnings.push_back(fmt::format(
            "the limit of {} cuts light off: the last bounce added {} of the image's radiance, the bounce "
            "before it {}; the picture shows only light of up to this number of bounces",
            settings.bounces == 1 ? "1 bounce" : fmt::format("{} bounces", settings.bounces),
            percent(statistics.lastBounceRadiance, statistics.meanRadiance),
            percent(statistics.previousBounceRadiance, statistics.meanRadiance)));
    }
    if (!statistics.shrunkImages.empty()) warnings.push_back(statistics.shrunkImages);
    if (statistics.nonFiniteSamples > 0)
        warnings.push_back(
            fmt::format("{} samples were not finite and were dropped", statistics.nonFiniteSamples));
    if (statistics.filmOverflowed) warnings.push_back(describeOverflow(output.film));
    return warnings;
}

void warnOfSmoothSurfaces(LoadedScene& scene) {
    const std::vector<bool> used = usedMaterials(scene);
    for (std::size_t i = 0; i < scene.materials.size(); ++i) {
        if (!used[i] || !isSpecular(scene.materials[i])) continue;
        scene.warnings.emplace_back(fmt::format(
            "{}: material {}: light paths do not show what a smooth surface reflects or refracts; expected a "
            "roughness of at least {:.3f}, or --integrator path",
            scene.source.string(), inQuotes(scene.materials[i].name), std::sqrt(shared::kSmoothAlpha)));
        return;
    }
}

}  // namespace duolux

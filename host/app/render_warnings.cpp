#include "host/app/render_warnings.h"

#include <fmt/format.h>

#include <cmath>
#include <string_view>
#include <vector>

#include "host/app/film_images.h"
#include "host/base/printable.h"
#include "host/device_scene/emitter_table.h"
#include "host/device_scene/smoothness.h"
#include "host/scene/emitters.h"
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

std::string dimEmitterWarning(const Scene& scene, std::uint64_t lightPaths) {
    constexpr double kFewPaths = 100.0, kSmallShare = 1e-4;
    const std::vector<SceneEmitter> emitters = listEmitters(scene);
    const EmitterTable table = buildEmitterTable(scene, emitters, true);
    if (table.choices == 0) return {};
    std::vector<double> shares(scene.materials.size());  // of all light paths
    for (std::size_t i = 0; i < emitters.size(); ++i) {
        if (emitters[i].kind != EmitterKind::kTriangle) continue;
        shares[scene.geometry.materials[emitters[i].index]] +=
            static_cast<double>(table.records[i].density) * emitters[i].area;
    }
    for (std::size_t i = 0; i < shares.size(); ++i) {
        const double paths = shares[i] * static_cast<double>(lightPaths);
        if (!(shares[i] > 0.0) || shares[i] >= kSmallShare || paths >= kFewPaths) continue;
        return fmt::format(
            "{}: material {} emits {:.1e} of all light, so that of {} light paths about {:.2g} start there: "
            "its light is missing or noisy; expected --integrator path, more --spp, or no emitters that are "
            "so much brighter",
            scene.source.string(), inQuotes(scene.materials[i].name), shares[i], lightPaths, paths);
    }
    return {};
}

void warnOfSmoothSurfaces(LoadedScene& scene) {
    const std::vector<bool> used = usedMaterials(scene);
    std::vector<std::string> everywhere, somewhere;
    for (std::size_t i = 0; i < scene.materials.size(); ++i) {
        if (!used[i]) continue;
        const Smoothness smoothness = smoothnessOf(scene, scene.materials[i]);
        if (smoothness == Smoothness::kNowhere) continue;
        (smoothness == Smoothness::kEverywhere ? everywhere : somewhere)
            .push_back(inQuotes(scene.materials[i].name));
    }
    const auto warn = [&](const std::vector<std::string>& names, std::string_view which) {
        if (names.empty()) return;
        scene.warnings.emplace_back(
            fmt::format("{}: material{} {}: light paths do not show what a smooth surface reflects or "
                        "refracts{}; expected a "
                        "roughness of at least {:.3f}, or --integrator path",
                        scene.source.string(), names.size() > 1 ? "s" : "", fmt::join(names, ", "), which,
                        std::sqrt(shared::kSmoothAlpha)));
    };
    warn(everywhere, "");
    warn(somewhere, ", and some pixels of an image make it smooth");
}

}  // namespace duolux

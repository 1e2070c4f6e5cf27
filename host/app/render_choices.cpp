#include "host/app/render_choices.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "host/app/film_images.h"
#include "host/app/options.h"
#include "host/base/error.h"
#include "host/base/named.h"
#include "host/cli/console.h"
#include "host/cli/options.h"

namespace duolux {

namespace {

Reflectance parseBlend(const std::string& text) {
    const auto point = parsePoint(text);
    const auto inside = [](float x) { return x >= 0.0f && x <= 1.0f; };
    if (!point || !inside(point->x) || !inside(point->y)) {
        throw UsageError(
            fmt::format("--blend {}: expected two numbers from 0 to 1 as T,O, for example 0.5,1", text));
    }
    return blendReflectance(point->x, point->y);
}

}  // namespace

SceneChoices Overrides::choices(const RenderOptions& options) const {
    SceneChoices choices = options.view.choices();
    choices.size = size;
    choices.reflectance = reflectance;
    choices.bounces = options.bounces;
    if (options.strict) choices.reading = Reading::kStrict;
    return choices;
}

void Overrides::applyTo(RenderSettings& settings, const RenderOptions& options) const {
    settings.sampler = sampler.value_or(settings.sampler);
    settings.integrator = integrator.value_or(settings.integrator);
    settings.spp = options.spp.value_or(settings.spp);
    settings.seed = options.seed.value_or(settings.seed);
    settings.layers = layers;
}

Overrides parseOverrides(const RenderOptions& options) {
    Overrides overrides;
    if (!options.preset.empty()) overrides.reflectance = presetReflectance(options.preset);
    if (!options.blend.empty()) overrides.reflectance = parseBlend(options.blend);
    if (!options.size.empty()) overrides.size = parseSize(options.size);
    overrides.sampler = named<Sampler>(options.sampler);
    if (!options.sampleRange.empty()) overrides.range = parseSampleRange(options.sampleRange);
    if (!options.aov.empty()) overrides.layers = parseLayers(options.aov);
    overrides.integrator = named<Integrator>(options.integrator);
    return overrides;
}

DirectLight chooseDirectLight(const RenderOptions& options, const RenderSettings& settings) {
    if (options.directLight.empty()) return DirectLight::kAuto;
    if (settings.integrator == Integrator::kLightTracer) {
        throw UsageError(
            "--direct-light applies only to --integrator path; the light tracer does not sample direct "
            "light");
    }
    return named<DirectLight>(options.directLight).value_or(DirectLight::kAuto);
}

void requireUseOfLayers(const RenderOptions& options, const std::vector<std::string>& outputs,
                        const RenderSettings& settings) {
    if (options.aov.empty()) return;
    if (settings.integrator == Integrator::kLightTracer) {
        throw UsageError(fmt::format(
            "--aov {}: the light tracer traces no camera rays; expected --integrator path", options.aov));
    }
    if (options.checkpoint.empty() && std::none_of(outputs.begin(), outputs.end(), isExrPath)) {
        throw UsageError(fmt::format(
            "--aov {}: only EXR files and checkpoints hold layers; expected -o FILE.exr", options.aov));
    }
}

SampleRange chooseSamples(const RenderOptions& options, const std::optional<SampleRange>& range,
                          const std::optional<Checkpoint>& resumed, std::uint32_t spp) {
    SampleRange samples{0, spp};
    if (range) {
        samples = *range;
        if (samples.end > spp) {
            throw UsageError(
                fmt::format("--sample-range {}: there are {} samples per pixel; expected A:B with 0 <= A < B "
                            "<= {}, or more --spp",
                            options.sampleRange, spp, spp));
        }
    } else if (resumed) {
        samples = resumed->origin.samples;
        if (options.spp) samples.end = *options.spp;
        if (samples.end <= samples.begin) {
            throw UsageError(fmt::format("--spp {}: {} is a part that starts at sample {}; expected more",
                                         samples.end, options.resume, samples.begin));
        }
    }
    // Samples that have been traced are kept.
    if (resumed) {
        const std::uint32_t there = resumed->origin.samples.begin + samplesTaken(resumed->state.film);
        if (there > samples.end) {
            warn(fmt::format("{} already holds samples up to {}, more than requested; all are kept",
                             options.resume, there));
            samples.end = there;
        }
    }
    return samples;
}

void resumeFrom(const Checkpoint& resumed, const RenderOptions& options, const LoadedScene& scene,
                SampleRange samples, RenderControl& control) {
    if (resumed.origin.samples.begin != samples.begin) {
        throw InputError(
            options.resume, "first sample",
            fmt::format("is {}, but {} in this render", resumed.origin.samples.begin, samples.begin),
            "expected a --sample-range with the same first sample");
    }
    // By default, direct light is computed as in the checkpoint.
    FilmOrigin wanted =
        originOf(scene, scene.settings, samples, control.directLight == DirectLight::kClosedForm);
    if (control.directLight == DirectLight::kAuto) {
        wanted.directLight = control.directLight = resumed.origin.directLight;
    }
    requireSameOrigin(options.resume, resumed.origin, wanted, "this render");
    control.resume = &resumed.state;
}

void requireNoOtherFile(const std::string& checkpoint) {
    std::error_code ec;
    if (checkpoint.empty() || !std::filesystem::is_regular_file(checkpoint, ec)) return;
    if (std::filesystem::file_size(checkpoint, ec) == 0 || isCheckpoint(checkpoint)) return;
    throw UsageError(fmt::format(
        "--checkpoint {}: is another kind of file; expected a checkpoint to replace, or a new name",
        checkpoint));
}

}  // namespace duolux

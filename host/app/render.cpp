#include "host/render/render.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <memory>
#include <optional>

#include "host/app/commands.h"
#include "host/app/exposure_warning.h"
#include "host/app/film_images.h"
#include "host/app/machine_options.h"
#include "host/app/options.h"
#include "host/app/render_options.h"
#include "host/app/report.h"
#include "host/app/signals.h"
#include "host/base/error.h"
#include "host/base/file.h"
#include "host/base/printable.h"
#include "host/cli/console.h"
#include "host/cli/options.h"
#include "host/cli/outputs.h"
#include "host/cli/progress.h"
#include "host/device_scene/transport.h"
#include "host/loaders/scene_file.h"
#include "host/view/load.h"
#include "shaders/shared/material_layout.h"

namespace duolux {

namespace {

using Clock = std::chrono::steady_clock;

double secondsSince(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

Reflectance parseBlend(const std::string& text) {
    const auto point = parsePoint(text);
    const auto inside = [](float x) { return x >= 0.0f && x <= 1.0f; };
    if (!point || !inside(point->x) || !inside(point->y)) {
        throw UsageError(
            fmt::format("--blend {}: expected two numbers from 0 to 1 as T,O, for example 0.5,1", text));
    }
    return blendReflectance(point->x, point->y);
}

/// The scene's settings that the command line overrides.
struct Overrides {
    std::optional<Reflectance> reflectance;
    std::optional<glm::uvec2> size;
    std::optional<Sampler> sampler;
    std::optional<Integrator> integrator;
    std::optional<SampleRange> range;
    FilmLayerSet layers = 0;

    /// The choices on which loading the scene depends.
    SceneChoices choices(const RenderOptions& options) const {
        SceneChoices choices = options.view.choices();
        choices.size = size;
        choices.reflectance = reflectance;
        choices.bounces = options.bounces;
        return choices;
    }

    void applyTo(RenderSettings& settings, const RenderOptions& options) const {
        settings.sampler = sampler.value_or(settings.sampler);
        settings.integrator = integrator.value_or(settings.integrator);
        settings.spp = options.spp.value_or(settings.spp);
        settings.seed = options.seed.value_or(settings.seed);
        settings.layers = layers;
    }
};

/// Throws UsageError for errors that the options' own checks cannot detect.
Overrides parseOverrides(const RenderOptions& options) {
    Overrides overrides;
    if (!options.preset.empty()) overrides.reflectance = presetReflectance(options.preset);
    if (!options.blend.empty()) overrides.reflectance = parseBlend(options.blend);
    if (!options.size.empty()) overrides.size = parseSize(options.size);
    if (!options.sampler.empty()) {
        overrides.sampler = options.sampler == "sobol" ? Sampler::kSobol : Sampler::kIndependent;
    }
    if (!options.sampleRange.empty()) overrides.range = parseSampleRange(options.sampleRange);
    if (!options.aov.empty()) overrides.layers = parseLayers(options.aov);
    if (!options.integrator.empty()) {
        overrides.integrator =
            options.integrator == "light" ? Integrator::kLightTracer : Integrator::kPathTracer;
    }
    return overrides;
}

std::string percent(double part, double whole) {
    const double value = 100.0 * part / whole;
    return value < 10.0 ? fmt::format("{:.2g} %", value) : fmt::format("{:.0f} %", value);
}

const char* samplesName(const RenderSettings& settings) {
    return settings.integrator == Integrator::kLightTracer ? "light paths" : "samples";
}

std::uint64_t samplesInAll(const RenderSettings& settings, SampleRange samples) {
    return std::uint64_t{settings.width} * settings.height * samples.size();
}

/// Warnings about a finished render.
std::vector<std::string> resultWarnings(const RenderSettings& settings, SampleRange samples,
                                        const RenderOutput& output, bool failed) {
    const RenderStatistics& statistics = output.statistics;
    std::vector<std::string> warnings;
    const std::uint64_t pixels = std::uint64_t{settings.width} * settings.height;
    if (statistics.gaps) {
        warnings.emplace_back(
            "the samples of some pixels have gaps: no checkpoint is written, and an earlier one is kept");
    }
    if (statistics.stopped && !failed && !stopStatus()) {
        const auto taken = static_cast<double>(output.film.totalSamples() + output.film.lightPaths());
        warnings.push_back(fmt::format("stopped at the time limit after {:.4g} of {} {} per pixel",
                                       taken / static_cast<double>(pixels), samples.size(),
                                       samplesName(settings)));
    }
    if (statistics.cutOffByBounces()) {
        warnings.push_back(fmt::format(
            "the limit of {} cuts light off: the last bounce added {} of the image's radiance, the bounce "
            "before "
            "it {}; the picture shows only light of up to this number of bounces",
            settings.bounces == 1 ? "1 bounce" : fmt::format("{} bounces", settings.bounces),
            percent(statistics.lastBounceRadiance, statistics.meanRadiance),
            percent(statistics.previousBounceRadiance, statistics.meanRadiance)));
    }
    if (statistics.nonFiniteSamples > 0)
        warnings.push_back(
            fmt::format("{} samples were not finite and were dropped", statistics.nonFiniteSamples));
    if (statistics.filmOverflowed) warnings.push_back(describeOverflow(output.film));
    return warnings;
}

DirectLight chooseDirectLight(const RenderOptions& options, const RenderSettings& settings) {
    if (options.directLight.empty()) return DirectLight::kAuto;
    if (settings.integrator == Integrator::kLightTracer) {
        throw UsageError(
            "--direct-light applies only to --integrator path; the light tracer does not sample direct "
            "light");
    }
    if (options.directLight == "auto") return DirectLight::kAuto;
    return options.directLight == "sampled" ? DirectLight::kSampled : DirectLight::kClosedForm;
}

/// Throws UsageError if layers are asked for that would not be filled or not be kept.
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

/// Chooses the samples to trace: those of --sample-range, or of the checkpoint, or all.
SampleRange chooseSamples(const RenderOptions& options, const Overrides& overrides,
                          const std::optional<Checkpoint>& resumed, std::uint32_t spp) {
    SampleRange samples{0, spp};
    if (overrides.range) {
        samples = *overrides.range;
        if (samples.end > spp) {
            throw UsageError(
                fmt::format("--sample-range {}: there are {} samples per pixel; expected A:B with "
                            "0 <= A < B <= {}, or more --spp",
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
            warn(fmt::format("{} holds samples up to {} of every pixel; they are kept", options.resume,
                             there));
            samples.end = there;
        }
    }
    return samples;
}

void prepareResume(const RenderOptions& options, const Checkpoint& resumed, const LoadedScene& scene,
                   SampleRange samples, RenderControl& control) {
    if (resumed.origin.samples.begin != samples.begin) {
        throw InputError(
            options.resume, "first sample",
            fmt::format("is {}, but {} of this render", resumed.origin.samples.begin, samples.begin),
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

/// Renders. If the device fails before the end, returns the output so far and sets `failure`.
RenderOutput renderWhatCanBe(Device& device, const LoadedScene& scene, const RenderControl& control,
                             std::optional<RenderFailure>& failure) {
    try {
        return render(device, scene, control);
    } catch (const RenderFailure& e) {
        failure = e;
        return std::move(e.output());
    }
}

/// Prevents a mistyped name from replacing an image.
void requireNoOtherFile(const std::string& checkpoint) {
    std::error_code ec;
    if (checkpoint.empty() || !std::filesystem::is_regular_file(checkpoint, ec)) return;
    if (std::filesystem::file_size(checkpoint, ec) == 0 || isCheckpoint(checkpoint)) return;
    throw UsageError(
        fmt::format("--checkpoint {}: is another kind of file; expected a checkpoint to "
                    "replace, or a new name",
                    checkpoint));
}

void warnOfMirrors(LoadedScene& scene) {
    const std::vector<bool> used = usedMaterials(scene);
    for (std::size_t i = 0; i < scene.materials.size(); ++i) {
        if (!used[i] || !isMirror(scene.materials[i])) continue;
        scene.warnings.emplace_back(fmt::format(
            "{}: material {}: light paths do not show what a mirror reflects; expected a roughness of at "
            "least {:.3f}, "
            "or --integrator path",
            scene.source.string(), inQuotes(scene.materials[i].name), std::sqrt(shared::kSmoothAlpha)));
        return;
    }
}

void runRender(const RenderOptions& options) {
    const Clock::time_point start = Clock::now();
    requireScenePath(options.scene);
    std::vector<std::string> outputs = options.outputs;
    if (outputs.empty()) outputs.push_back(std::filesystem::path(options.scene).stem().string() + ".png");
    std::vector<OutputFile> files;
    for (const std::string& output : outputs)
        files.push_back({"-o", output});
    if (!options.report.empty() && options.report != "-")
        files.push_back({"--report", options.report, false});
    if (!options.checkpoint.empty()) files.push_back({"--checkpoint", options.checkpoint, false});
    // A checkpoint may replace the one from which the render resumes.
    checkOutputs(files,
                 {options.scene, isSameFile(options.resume, options.checkpoint) ? "" : options.resume});
    const Overrides overrides = parseOverrides(options);
    SceneChoices choices = overrides.choices(options);
    if (options.strict) choices.reading = Reading::kStrict;

    StageSeconds seconds;
    LoadedScene scene = loadScene(options.scene, choices);
    checkNotRead(files, scene.files);
    requireNoOtherFile(options.checkpoint);
    overrides.applyTo(scene.settings, options);
    requireUseOfLayers(options, outputs, scene.settings);
    if (scene.settings.integrator == Integrator::kLightTracer) warnOfMirrors(scene);
    for (const Warning& warning : scene.warnings)
        warn(warning.text);
    RenderControl control;
    control.timeLimit = options.timeLimit;
    control.tuning = options.tuning.choice();
    control.directLight = chooseDirectLight(options, scene.settings);
    std::optional<Checkpoint> resumed;
    if (!options.resume.empty()) resumed = readCheckpoint(options.resume);
    const SampleRange samples = chooseSamples(options, overrides, resumed, scene.settings.spp);
    control.samples = samples;
    if (resumed) prepareResume(options, *resumed, scene, samples, control);
    seconds.load = secondsSince(start);

    Device device = openDevice(options.device);
    const Progress::Style style = Progress::styleForStderr(options.quiet);
    Progress progress(style);
    // A large film takes seconds to prepare.
    constexpr std::uint64_t kManyPixels = 1u << 24;
    const std::uint64_t pixels = std::uint64_t{scene.settings.width} * scene.settings.height;
    if (!resumed && (style == Progress::Style::kBar || pixels >= kManyPixels)) {
        progress.begin(static_cast<double>(samplesInAll(scene.settings, samples)));
    }
    control.onStart = deferSignals;
    control.onProgress = [&](const RenderProgress& p) {
        if (p.samplesTotal == 0) return true;  // all samples were resumed
        progress.update({static_cast<double>(p.samplesDone), static_cast<double>(p.samplesTotal), p.seconds,
                         options.timeLimit});
        return !stopStatus();
    };
    const auto origin = [&](const RenderStatistics& statistics) {
        return originOf(scene, scene.settings, samples, statistics.directLightInClosedForm);
    };
    if (!options.checkpoint.empty()) {
        control.onCheckpoint = [&](const Film& film, const RenderStatistics& statistics) {
            try {
                writeCheckpoint(options.checkpoint, origin(statistics), film, statistics);
            } catch (const std::exception& e) {  // the next checkpoint may succeed
                progress.leaveLine();
                warn(e.what());
            }
        };
    }
    std::optional<RenderFailure> failure;
    const RenderOutput output = renderWhatCanBe(device, scene, control, failure);
    deferSignals();  // even if all samples were resumed
    progress.finish();

    std::vector<std::string> warnings = resultWarnings(scene.settings, samples, output, failure.has_value());
    // The warning requires at least one sample of every pixel.
    if (!failure && output.film.totalSamples() + output.film.lightPaths() >= output.film.samples().size()) {
        const bool clips = std::any_of(outputs.begin(), outputs.end(), isPngPath);
        const std::string exposure = exposureWarning(scene, output.film.rows(), options.exposure, clips);
        if (!exposure.empty()) warnings.push_back(exposure);
    }
    for (const std::string& warning : warnings) {
        warn(warning);
        scene.warnings.emplace_back(warning);
    }
    if (failure) scene.warnings.emplace_back(failure->what());
    const Clock::time_point writeStart = Clock::now();
    WriteAll write;
    if (!options.checkpoint.empty() && !output.statistics.gaps) {
        write(options.checkpoint, [&](const std::filesystem::path& path) {
            writeCheckpoint(path, origin(output.statistics), output.film, output.statistics);
        });
    }
    writeImages(write, outputs, output.film.rows(),
                filmImageOptions(origin(output.statistics), output.film, options.exposure));
    seconds.write = secondsSince(writeStart);
    seconds.total = secondsSince(start);
    if (!options.report.empty()) {
        write(options.report, [&](const std::filesystem::path& path) {
            writeReport(path, renderReport(scene, samples, device.info(), output.statistics, seconds));
        });
    }
    const std::string there =
        fmt::format("{} of {} {}", output.film.totalSamples() + output.film.lightPaths(),
                    samplesInAll(scene.settings, samples), samplesName(scene.settings));
    if (failure) {
        write.sayFailures();
        throw MachineError(fmt::format("{}; {} {}", failure->what(),
                                       write.failed() ? "there are" : "wrote the result so far,", there));
    }
    if (const auto status = stopStatus(); status && (output.statistics.stopped || write.failed())) {
        write.sayFailures();
        throw Stopped(*status,
                      fmt::format("{}: wrote the result so far, {}",
                                  *status == ExitStatus::kTerminated ? "terminated" : "interrupted", there));
    }
    write.finish();
}

}  // namespace

void addRenderCommand(CLI::App& app) {
    const auto options = std::make_shared<RenderOptions>();
    CLI::App* command = app.add_subcommand("render", "Render a scene to images");
    addRenderOptions(*command, *options);
    command->callback([options, command] {
        sortWords(*command, *options);
        runRender(*options);
    });
}

}  // namespace duolux

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
#include "host/app/console.h"
#include "host/app/dark_picture.h"
#include "host/app/film_images.h"
#include "host/app/machine_options.h"
#include "host/app/options.h"
#include "host/app/outputs.h"
#include "host/app/report.h"
#include "host/app/signals.h"
#include "host/app/tuning_options.h"
#include "host/app/view_options.h"
#include "host/base/error.h"
#include "host/base/file.h"
#include "host/base/progress.h"
#include "host/view/load.h"

namespace duolux {

namespace {

using Clock = std::chrono::steady_clock;

double secondsSince(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

struct RenderOptions {
    std::string scene;
    std::vector<std::string> outputs;
    std::string preset, blend, size, sampler, integrator, directLight, device, report, sampleRange,
        checkpoint, resume;
    std::optional<std::uint32_t> spp, bounces, seed;
    std::optional<double> timeLimit;
    TuningOptions tuning;
    ViewOptions view;
    float exposure = 0.0f;
    bool quiet = false;
    bool strict = false;
};

Reflectance parseBlend(const std::string& text) {
    const auto point = parsePoint(text);
    const auto inside = [](float x) { return x >= 0.0f && x <= 1.0f; };
    if (!point || !inside(point->x) || !inside(point->y)) {
        throw UsageError(
            fmt::format("--blend {}: expected two numbers from 0 to 1 as T,O, for example 0.5,1", text));
    }
    return blendReflectance(point->x, point->y);
}

/// What the command line changes of a scene.
struct Overrides {
    std::optional<Reflectance> reflectance;
    std::optional<glm::uvec2> size;
    std::optional<Sampler> sampler;
    std::optional<Integrator> integrator;
    std::optional<SampleRange> range;

    /// What the rest of the scene depends on.
    SceneChoices choices(const RenderOptions& options) const {
        SceneChoices choices = options.view.choices();
        choices.size = size;
        choices.reflectance = reflectance;
        choices.bounces = options.bounces;
        return choices;
    }

    void applyTo(Scene& scene, const RenderOptions& options) const {
        RenderSettings& settings = scene.render;
        settings.sampler = sampler.value_or(settings.sampler);
        settings.integrator = integrator.value_or(settings.integrator);
        settings.spp = options.spp.value_or(settings.spp);
        settings.seed = options.seed.value_or(settings.seed);
    }
};

/// Throws UsageError for what the options' own checks cannot tell.
Overrides parseOverrides(const RenderOptions& options) {
    Overrides overrides;
    if (!options.preset.empty()) overrides.reflectance = presetReflectance(options.preset);
    if (!options.blend.empty()) overrides.reflectance = parseBlend(options.blend);
    if (!options.size.empty()) overrides.size = parseSize(options.size);
    if (!options.sampler.empty()) {
        overrides.sampler = options.sampler == "sobol" ? Sampler::kSobol : Sampler::kIndependent;
    }
    if (!options.sampleRange.empty()) overrides.range = parseSampleRange(options.sampleRange);
    if (!options.integrator.empty()) {
        overrides.integrator = options.integrator == "light" ? Integrator::kLight : Integrator::kPath;
    }
    return overrides;
}

std::string percent(double part, double whole) {
    const double value = 100.0 * part / whole;
    return value < 10.0 ? fmt::format("{:.2g} %", value) : fmt::format("{:.0f} %", value);
}

const char* samplesName(const Scene& scene) {
    return scene.render.integrator == Integrator::kLight ? "light paths" : "samples";
}

std::uint64_t samplesInAll(const Scene& scene, const RenderControl& control) {
    return std::uint64_t{scene.render.width} * scene.render.height * (scene.render.spp - control.firstSample);
}

/// What the user should know of a finished render.
std::vector<std::string> resultWarnings(const Scene& scene, const RenderControl& control,
                                        const RenderOutput& output, bool failed) {
    const RenderStatistics& statistics = output.statistics;
    std::vector<std::string> warnings;
    const std::uint64_t pixels = std::uint64_t{scene.render.width} * scene.render.height;
    if (statistics.gaps) {
        warnings.emplace_back(
            "some pixels have light of samples that others do not: no checkpoint is written, an earlier one "
            "stays");
    }
    if (statistics.stopped && !failed && !stopStatus()) {
        const auto taken = static_cast<double>(output.film.totalSamples() + output.film.lightPaths());
        warnings.push_back(fmt::format("stopped at the time limit after {:.4g} of {} {} per pixel",
                                       taken / static_cast<double>(pixels),
                                       scene.render.spp - control.firstSample, samplesName(scene)));
    }
    if (statistics.cutOffByBounces()) {
        warnings.push_back(fmt::format(
            "the limit of {} cuts light off: the last of them added {} of the image's "
            "radiance, the one "
            "before it {}; so this is the picture of that many",
            scene.render.bounces == 1 ? "1 bounce" : fmt::format("{} bounces", scene.render.bounces),
            percent(statistics.lastBounceRadiance, statistics.meanRadiance),
            percent(statistics.previousBounceRadiance, statistics.meanRadiance)));
    }
    if (statistics.nonFiniteSamples > 0)
        warnings.push_back(
            fmt::format("{} samples were not finite and were dropped", statistics.nonFiniteSamples));
    if (statistics.filmOverflowed) warnings.push_back(describeOverflow(output.film));
    return warnings;
}

DirectLight chooseDirectLight(const RenderOptions& options, const Scene& scene) {
    if (options.directLight.empty()) return DirectLight::kAuto;
    if (scene.render.integrator == Integrator::kLight) {
        throw UsageError(
            "--direct-light is for --integrator path; light paths bring direct light like any other");
    }
    if (options.directLight == "auto") return DirectLight::kAuto;
    return options.directLight == "sampled" ? DirectLight::kSampled : DirectLight::kClosedForm;
}

/// The samples to take: those of --sample-range, or of the checkpoint, or all.
void chooseRange(const RenderOptions& options, const Overrides& overrides,
                 const std::optional<Checkpoint>& resumed, Scene& scene, RenderControl& control) {
    if (overrides.range) {
        const auto [first, end] = *overrides.range;
        if (end > scene.render.spp) {
            throw UsageError(
                fmt::format("--sample-range {}: there are {} samples per pixel; expected A:B with "
                            "0 <= A < B <= {}, or more --spp",
                            options.sampleRange, scene.render.spp, scene.render.spp));
        }
        control.firstSample = first;
        scene.render.spp = end;
    } else if (resumed) {
        control.firstSample = resumed->origin.firstSample;
        if (!options.spp) scene.render.spp = resumed->origin.settings.spp;
        if (scene.render.spp <= control.firstSample) {
            throw UsageError(fmt::format("--spp {}: {} is a part that begins with sample {}; expected more",
                                         scene.render.spp, options.resume, control.firstSample));
        }
    }
    // What has been taken stays.
    if (resumed) {
        const std::uint32_t there = resumed->origin.firstSample + samplesTaken(resumed->state.film);
        if (there > scene.render.spp) {
            warn(fmt::format("{} holds samples up to {} of every pixel; they are kept", options.resume,
                             there));
            scene.render.spp = there;
        }
    }
}

void prepareResume(const RenderOptions& options, const Checkpoint& resumed, const Scene& scene,
                   RenderControl& control) {
    if (resumed.origin.firstSample != control.firstSample) {
        throw InputError(
            options.resume, "first sample",
            fmt::format("is {}, but {} of this render", resumed.origin.firstSample, control.firstSample),
            "expected a range that begins alike");
    }
    // Unless asked for otherwise, direct light is found as before.
    FilmOrigin wanted = originOf(scene, control.firstSample, control.directLight == DirectLight::kClosedForm);
    if (control.directLight == DirectLight::kAuto) {
        wanted.directLight = control.directLight = resumed.origin.directLight;
    }
    requireSameOrigin(options.resume, resumed.origin, wanted, "this render");
    control.resume = &resumed.state;
}

/// What there is, though the device may have failed on the way.
RenderOutput renderWhatCanBe(Device& device, const Scene& scene, const RenderControl& control,
                             std::optional<RenderFailure>& failure) {
    try {
        return render(device, scene, control);
    } catch (const RenderFailure& e) {
        failure = e;
        return std::move(e.output());
    }
}

void runRender(const RenderOptions& options) {
    const Clock::time_point start = Clock::now();
    std::vector<std::string> outputs = options.outputs;
    if (outputs.empty()) outputs.push_back(std::filesystem::path(options.scene).stem().string() + ".png");
    std::vector<OutputFile> files;
    for (const std::string& output : outputs)
        files.push_back({"-o", output});
    if (!options.report.empty() && options.report != "-")
        files.push_back({"--report", options.report, false});
    if (!options.checkpoint.empty()) files.push_back({"--checkpoint", options.checkpoint, false});
    // A checkpoint may take the place of the one that the render goes on from.
    checkOutputs(files,
                 {options.scene, isSameFile(options.resume, options.checkpoint) ? "" : options.resume});
    const Overrides overrides = parseOverrides(options);
    SceneChoices choices = overrides.choices(options);
    if (options.strict) choices.reading = Reading::kStrict;

    StageSeconds seconds;
    Scene scene = loadScene(options.scene, choices);
    checkNotRead(files, scene.files);
    overrides.applyTo(scene, options);
    for (const std::string& warning : scene.warnings)
        warn(warning);
    RenderControl control;
    control.timeLimit = options.timeLimit;
    control.tuning = options.tuning.choice();
    control.directLight = chooseDirectLight(options, scene);
    std::optional<Checkpoint> resumed;
    if (!options.resume.empty()) resumed = readCheckpoint(options.resume);
    chooseRange(options, overrides, resumed, scene, control);
    if (resumed) prepareResume(options, *resumed, scene, control);
    seconds.load = secondsSince(start);

    Device device = openDevice(options.device);
    Progress progress(Progress::styleForStderr(options.quiet));
    control.onStart = deferSignals;
    control.onProgress = [&](const RenderProgress& p) {
        if (p.samplesTotal == 0) return true;  // all has been resumed
        progress.update({static_cast<double>(p.samplesDone), static_cast<double>(p.samplesTotal), p.seconds,
                         options.timeLimit});
        return !stopStatus();
    };
    const auto origin = [&](const RenderStatistics& statistics) {
        return originOf(scene, control.firstSample, statistics.directLightInClosedForm);
    };
    if (!options.checkpoint.empty()) {
        control.onCheckpoint = [&](const Film& film, const RenderStatistics& statistics) {
            try {
                writeCheckpoint(options.checkpoint, origin(statistics), film, statistics);
            } catch (const std::exception& e) {  // the next one may fit again
                progress.leaveLine();
                warn(e.what());
            }
        };
    }
    std::optional<RenderFailure> failure;
    const RenderOutput output = renderWhatCanBe(device, scene, control, failure);
    deferSignals();  // even if all has been resumed
    progress.finish();

    std::vector<std::string> warnings = resultWarnings(scene, control, output, failure.has_value());
    // Of less than a sample of every pixel there is nothing to say.
    if (!failure && output.film.totalSamples() + output.film.lightPaths() >= output.film.samples().size()) {
        const std::string dark = darkPictureWarning(scene, output.film.rows(), options.exposure);
        if (!dark.empty()) warnings.push_back(dark);
    }
    for (const std::string& warning : warnings) {
        warn(warning);
        scene.warnings.push_back(warning);
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
            writeReport(path,
                        renderReport(scene, control.firstSample, device.info(), output.statistics, seconds));
        });
    }
    const std::string there =
        fmt::format("{} of {} {}", output.film.totalSamples() + output.film.lightPaths(),
                    samplesInAll(scene, control), samplesName(scene));
    if (failure) {
        write.sayFailures();
        throw MachineError(fmt::format("{}; {} {}", failure->what(),
                                       write.failed() ? "there are" : "wrote what there is,", there));
    }
    if (const auto status = stopStatus(); status && (output.statistics.stopped || write.failed())) {
        write.sayFailures();
        throw Error(*status,
                    fmt::format("{}: wrote what there is, {}",
                                *status == ExitStatus::kTerminated ? "terminated" : "interrupted", there));
    }
    write.finish();
}

/// `-o a.png a.exr`: words that are neither options nor the scene are further images after -o.
void sortWords(const CLI::App& command, RenderOptions& options) {
    std::vector<std::string> words = command.remaining(), others;
    words.insert(words.begin(), options.scene);
    for (std::string& word : words) {
        const bool isOutput = !options.outputs.empty() && isImagePath(word);
        (isOutput ? options.outputs : others).push_back(std::move(word));
    }
    if (others.empty()) throw UsageError("render: expected a SCENE: an .obj or .json file");
    options.scene = others.front();
    others.erase(others.begin());
    if (!others.empty()) throw CLI::ExtrasError(command.get_name(), others);
}

}  // namespace

void addRenderCommand(CLI::App& app) {
    const auto options = std::make_shared<RenderOptions>();
    CLI::App* command = app.add_subcommand("render", "Render a scene to images");
    command->add_option("SCENE", options->scene, "The scene: .obj (with its .mtl) or .json")->required();
    command
        ->add_option("-o,--output", options->outputs,
                     "Images to write: .exr, .png or .pfm; may be given several times (default: SCENE's name "
                     "+ .png in the current folder)")
        ->type_name("FILE")
        ->allow_extra_args(false)
        ->take_all();
    std::vector<std::string> names;
    for (const Preset& preset : presets())
        names.emplace_back(preset.name);
    CLI::Option* preset =
        command
            ->add_option("--preset", options->preset,
                         "Scene-wide reflectance of the paper (default: the scene's, or global)")
            ->type_name("NAME")
            ->check(CLI::IsMember(names));
    command
        ->add_option("--blend", options->blend,
                     "Scene-wide reflectance: any point T,O of the square between the presets "
                     "(local 1,0; global 0,1; shadowless 1,1; one-bounce 0,0)")
        ->type_name("T,O")
        ->excludes(preset);
    command->add_option("--spp", options->spp, "Samples per pixel (default: the scene's, or 64)")
        ->type_name("N")
        ->check(wholeNumber(1, 1 << 24));
    command->add_option("--size", options->size, "Image size (default: the scene's, or 512x512)")
        ->type_name("WIDTHxHEIGHT");
    command
        ->add_option("--bounces", options->bounces,
                     "Largest number of scattering events on a path (default: the scene's, or 16; 4 "
                     "where light may grow with every bounce, as in shadowless)")
        ->type_name("N")
        ->check(wholeNumber(0, 65535));
    addViewOptions(*command, options->view);
    command->add_option("--seed", options->seed, "Seed of the random numbers (default: the scene's, or 1)")
        ->type_name("N")
        ->check(wholeNumber(0, 0xffffffff));
    command
        ->add_option("--integrator", options->integrator,
                     "Paths from the camera (path: the default, if the scene does not choose), or from the "
                     "emitters, each connected to the "
                     "camera wherever it scatters (light); then --spp is the number of light paths per pixel")
        ->type_name("NAME")
        ->check(CLI::IsMember({"path", "light"}));
    command
        ->add_option("--sampler", options->sampler,
                     "Samples: Owen-scrambled Sobol points (the default), or independent ones")
        ->type_name("NAME")
        ->check(CLI::IsMember({"sobol", "independent"}));
    command
        ->add_option(
            "--direct-light", options->directLight,
            "Light from emitters to the surfaces on paths from the camera: sampled; in closed form, without "
            "noise, where nothing can be in between (local, shadowless); or auto (the default): in closed "
            "form for local")
        ->type_name("NAME")
        ->check(CLI::IsMember({"auto", "sampled", "closed-form"}));
    addDeviceOption(*command, options->device);
    addThreadsOption(*command);
    addTuningOptions(*command, options->tuning);
    command
        ->add_option("--time-limit", options->timeLimit,
                     "Stop before this many seconds of rendering with what has been accumulated, but not "
                     "before every pixel has one sample (or there are as many light paths as pixels)")
        ->type_name("SECONDS")
        ->check(between(1e-3, 1e9));
    command
        ->add_option("--sample-range", options->sampleRange,
                     "Only samples A to B-1 of every pixel (or as many light paths), a part for 'duolux "
                     "merge', with --checkpoint")
        ->type_name("A:B")
        ->check(notEmpty());
    command
        ->add_option("--checkpoint", options->checkpoint,
                     "Keep what there is, exactly, in this file: every minute, and at the end")
        ->type_name("FILE")
        ->check(notEmpty());
    command
        ->add_option(
            "--resume", options->resume,
            "Go on from a checkpoint of the same scene and settings, to the end of its range of samples "
            "or to --spp")
        ->type_name("FILE")
        ->check(notEmpty());
    command->add_option("--exposure", options->exposure, "Stops by which a PNG is brightened (default: 0)")
        ->type_name("STOPS")
        ->check(between(-64.0, 64.0));
    command
        ->add_option("--report", options->report,
                     "Write statistics as JSON to this file (-: standard output)")
        ->type_name("FILE");
    addStrictOption(*command, options->strict);
    command->add_flag("--quiet", options->quiet, "No progress on standard error");
    command->allow_extras();
    command->callback([options, command] {
        sortWords(*command, *options);
        runRender(*options);
    });
}

}  // namespace duolux

#include "host/app/render_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "host/app/machine_options.h"
#include "host/app/options.h"
#include "host/base/error.h"
#include "host/base/named.h"
#include "host/cli/options.h"
#include "host/film/image.h"
#include "host/loaders/scene_file.h"
#include "host/render/render.h"
#include "host/scene/reflectance.h"
#include "host/scene/scene.h"

namespace duolux {

void addRenderOptions(CLI::App& command, RenderOptions& options) {
    command.add_option("SCENE", options.scene, fmt::format("The scene: {}", sceneExtensions()))->required();
    command
        .add_option(
            "-o,--output", options.outputs,
            fmt::format("Images to write: {}; may be given several times (default: SCENE's name + .png in "
                        "the current folder)",
                        imageExtensions()))
        ->type_name("FILE")
        ->allow_extra_args(false)
        ->take_all();
    std::vector<std::string> names;
    for (const Preset& preset : presets())
        names.emplace_back(preset.name);
    CLI::Option* preset =
        command
            .add_option("--preset", options.preset,
                        "Scene-wide reflectance of the paper (default: the scene's, or global)")
            ->type_name("NAME")
            ->check(oneOf(names));
    command
        .add_option("--blend", options.blend,
                    "Scene-wide reflectance: any point T,O of the square between the presets (local 1,0; "
                    "global 0,1; shadowless 1,1; one-bounce 0,0)")
        ->type_name("T,O")
        ->excludes(preset);
    command.add_option("--spp", options.spp, "Samples per pixel (default: the scene's, or 64)")
        ->type_name("N")
        ->check(wholeNumber(1, 1 << 24));
    command.add_option("--size", options.size, "Image size (default: the scene's, or 512x512)")
        ->type_name("WIDTHxHEIGHT");
    command
        .add_option("--bounces", options.bounces,
                    "Largest number of scattering events on a path (default: the scene's, or 16; 4 where "
                    "light may grow with every bounce, as in shadowless)")
        ->type_name("N")
        ->check(wholeNumber(0, RenderSettings::kMostBounces));
    addViewOptions(command, options.view);
    command.add_option("--seed", options.seed, "Seed of the random numbers (default: the scene's, or 1)")
        ->type_name("N")
        ->check(wholeNumber(0, 0xffffffff));
    command
        .add_option(
            "--integrator", options.integrator,
            "path: path tracer (default, unless the scene chooses); light: light tracer, which connects "
            "paths from the emitters to the camera; --spp is then the number of light paths per pixel")
        ->type_name("NAME")
        ->check(oneOf(namesOfAll<Integrator>()));
    command
        .add_option("--sampler", options.sampler,
                    "Owen-scrambled Sobol points (default), or independent random numbers")
        ->type_name("NAME")
        ->check(oneOf(namesOfAll<Sampler>()));
    command
        .add_option("--direct-light", options.directLight,
                    "Direct light in the path tracer: sampled; closed-form: without noise, only for diffuse, "
                    "flat surfaces where nothing blocks emitters (local, shadowless); auto (default): "
                    "closed-form for local, otherwise sampled")
        ->type_name("NAME")
        ->check(oneOf(namesOfAll<DirectLight>()));
    addDeviceOption(command, options.device);
    addThreadsOption(command);
    addTuningOptions(command, options.tuning);
    command
        .add_option("--time-limit", options.timeLimit,
                    "Stop before this many seconds of rendering, but not before every pixel has one sample "
                    "(light tracer: as many light paths as pixels)")
        ->type_name("SECONDS")
        ->check(between(1e-3, 1e9));
    command
        .add_option("--sample-range", options.sampleRange,
                    "Trace only samples A to B-1 of every pixel (or the corresponding light paths): a part "
                    "for 'duolux merge', with --checkpoint")
        ->type_name("A:B")
        ->check(notEmpty());
    command
        .add_option("--checkpoint", options.checkpoint,
                    "Save the exact state of the render in this file, every minute and at the end")
        ->type_name("FILE")
        ->check(notEmpty());
    command
        .add_option("--resume", options.resume,
                    "Resume from a checkpoint of the same scene and settings, up to the end of its range of "
                    "samples or to --spp")
        ->type_name("FILE")
        ->check(notEmpty());
    command
        .add_option("--aov", options.aov,
                    fmt::format("Further layers for EXR files and the checkpoint, separated by commas; only "
                                "with --integrator path: {}",
                                fmt::join(namesOf(~FilmLayerSet{0}), ", ")))
        ->type_name("NAME,...")
        ->check(notEmpty());
    command.add_option("--exposure", options.exposure, "Stops by which a PNG is brightened (default: 0)")
        ->type_name("STOPS")
        ->check(between(-64.0, 64.0));
    command
        .add_option("--report", options.report, "Write statistics as JSON to this file (-: standard output)")
        ->type_name("FILE");
    addStrictOption(command, options.strict);
    command.add_flag("--quiet", options.quiet, "No progress on standard error");
    command.allow_extras();
}

void sortWords(const CLI::App& command, RenderOptions& options) {
    std::vector<std::string> words = command.remaining(), others;
    const auto end = std::find(words.begin(), words.end(), "--");  // of the options; only words follow
    if (end != words.end()) words.erase(end);
    words.insert(words.begin(), options.scene);
    for (std::string& word : words) {
        const bool isOutput = !options.outputs.empty() && isImagePath(word);
        (isOutput ? options.outputs : others).push_back(std::move(word));
    }
    if (others.empty()) {
        throw UsageError(fmt::format("render: {} is an image; expected a SCENE: an {} file", options.scene,
                                     sceneExtensions()));
    }
    options.scene = others.front();
    others.erase(others.begin());
    if (others.empty()) return;
    options.view.choices();                      // a vector of several words is the likelier mistake
    std::reverse(others.begin(), others.end());  // as the error lists them
    throw CLI::ExtrasError(command.get_name(), others);
}

}  // namespace duolux

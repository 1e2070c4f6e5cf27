#include "host/render/render.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <charconv>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <memory>
#include <optional>

#include "host/app/commands.h"
#include "host/app/interrupt.h"
#include "host/app/report.h"
#include "host/base/error.h"
#include "host/base/file.h"
#include "host/base/progress.h"
#include "host/base/version.h"
#include "host/film/image.h"
#include "host/scene/hash.h"
#include "host/scene/load.h"

namespace duolux {

namespace {

using Clock = std::chrono::steady_clock;

double secondsSince(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

struct RenderOptions {
    std::string scene;
    std::vector<std::string> outputs;
    std::string preset, blend, size, sampler, device, report;
    std::optional<std::uint32_t> spp, bounces, seed;
    std::optional<double> timeLimit;
    float exposure = 0.0f;
    bool quiet = false;
};

/// "A<separator>B" as two numbers.
template <typename T>
std::optional<std::pair<T, T>> parsePair(const std::string& text, char separator) {
    const std::size_t at = text.find(separator);
    if (at == std::string::npos) return std::nullopt;
    std::pair<T, T> values{};
    const char* middle = text.data() + at;
    const char* end = text.data() + text.size();
    const auto first = std::from_chars(text.data(), middle, values.first);
    const auto second = std::from_chars(middle + 1, end, values.second);
    if (first.ec != std::errc() || first.ptr != middle || second.ec != std::errc() || second.ptr != end) {
        return std::nullopt;
    }
    return values;
}

Reflectance parseBlend(const std::string& text) {
    const auto values = parsePair<float>(text, ',');
    if (!values || !(values->first >= 0.0f) || !(values->second >= 0.0f) || !std::isfinite(values->first) ||
        !std::isfinite(values->second)) {
        throw UsageError(
            fmt::format("--blend {}: expected two numbers >= 0 as T,O, for example 0.5,1", text));
    }
    return blendReflectance(values->first, values->second);
}

glm::uvec2 parseSize(const std::string& text) {
    const auto values = parsePair<std::uint32_t>(text, 'x');
    if (!values || values->first < 1 || values->second < 1 || values->first > 16384 ||
        values->second > 16384) {
        throw UsageError(
            fmt::format("--size {}: expected WIDTHxHEIGHT, each from 1 to 16384, for example 640x480", text));
    }
    return {values->first, values->second};
}

/// What the command line changes of a scene.
struct Overrides {
    std::optional<Reflectance> reflectance;
    std::optional<glm::uvec2> size;
    std::optional<Sampler> sampler;

    void applyTo(Scene& scene, const RenderOptions& options) const {
        RenderSettings& settings = scene.render;
        scene.reflectance = reflectance.value_or(scene.reflectance);
        if (size) {
            settings.width = size->x;
            settings.height = size->y;
        }
        settings.sampler = sampler.value_or(settings.sampler);
        settings.spp = options.spp.value_or(settings.spp);
        settings.bounces = options.bounces.value_or(settings.bounces);
        settings.seed = options.seed.value_or(settings.seed);
        if (reflectance) scene.hash = hashScene(scene);
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
    return overrides;
}

void checkFolderOf(std::string_view option, const std::string& file) {
    const std::filesystem::path folder = std::filesystem::path(file).parent_path();
    if (!folder.empty() && !std::filesystem::is_directory(folder)) {
        throw UsageError(fmt::format("{} {}: there is no folder {}", option, file, folder.string()));
    }
}

/// What is wrong with an output file is said before the rendering, not after.
void checkOutputs(const std::vector<std::string>& outputs, const std::string& report) {
    for (const std::string& output : outputs) {
        if (!isImagePath(output)) {
            throw UsageError(fmt::format("-o {}: unknown image format; expected .exr, .png or .pfm", output));
        }
        checkFolderOf("-o", output);
    }
    if (report != "-") checkFolderOf("--report", report);
}

/// A check that a number is in [lower, upper], which NaN is not.
CLI::Validator between(double lower, double upper) {
    const std::string range = fmt::format("from {:g} to {:g}", lower, upper);
    return CLI::Validator(
        [=](std::string& text) {
            double value = 0.0;
            const bool fine = CLI::detail::lexical_cast(text, value) && value >= lower && value <= upper;
            return fine ? std::string() : fmt::format("expected a number {}, not {}", range, text);
        },
        range);
}

void writeReport(const std::string& file, const std::string& text) {
    if (file == "-") {
        std::fputs(text.c_str(), stdout);
        return;
    }
    writeTextFile(file, text);
}

ImageOptions imageOptions(const RenderOptions& options, const Scene& scene,
                          const RenderStatistics& statistics) {
    const double pixels = static_cast<double>(scene.render.width) * scene.render.height;
    ImageOptions out;
    out.display = scene.display;
    out.exposure = options.exposure;
    out.metadata = {{"reflectance", describeReflectance(scene.reflectance)},
                    {"spp", fmt::format("{:g}", static_cast<double>(statistics.samples) / pixels)},
                    {"seed", fmt::format("{}", scene.render.seed)},
                    {"bounces", fmt::format("{}", scene.render.bounces)},
                    {"scene hash", scene.hash},
                    {"version", fmt::format("duolux {} ({})", versionString(), commitString())}};
    return out;
}

void warn(const std::string& text) {
    fmt::print(stderr, "duolux: warning: {}\n", text);
}

void warnAboutResult(const Scene& scene, const RenderStatistics& statistics) {
    if (statistics.stillGrowing()) {
        warn(fmt::format(
            "the {} bounces allowed were not enough: the last one still added {:.2g} % of the image's "
            "radiance (the one before it {:.2g} %), so this is the picture of that many bounces",
            scene.render.bounces, 100.0 * statistics.lastBounceRadiance / statistics.meanRadiance,
            100.0 * statistics.previousBounceRadiance / statistics.meanRadiance));
    }
    if (statistics.nonFiniteSamples > 0) {
        warn(fmt::format("{} samples were not finite and were dropped", statistics.nonFiniteSamples));
    }
    if (statistics.filmOverflowed) warn("some pixels are brighter than the film can hold and were clamped");
}

void runRender(const RenderOptions& options) {
    const Clock::time_point start = Clock::now();
    std::vector<std::string> outputs = options.outputs;
    if (outputs.empty()) outputs.push_back(std::filesystem::path(options.scene).stem().string() + ".png");
    checkOutputs(outputs, options.report);
    const Overrides overrides = parseOverrides(options);
    catchInterrupts();

    StageSeconds seconds;
    Scene scene = loadScene(options.scene);
    overrides.applyTo(scene, options);
    for (const std::string& warning : scene.warnings)
        warn(warning);
    seconds.load = secondsSince(start);

    Device device(options.device);
    RenderControl control;
    control.timeLimit = options.timeLimit;
    Progress progress(Progress::styleForStderr(options.quiet));
    control.onProgress = [&](const RenderProgress& p) {
        progress.update({static_cast<double>(p.samplesDone), static_cast<double>(p.samplesTotal), p.seconds,
                         options.timeLimit});
        return !interrupted();
    };
    const RenderOutput output = render(device, scene, control);
    progress.finish();

    const Clock::time_point writeStart = Clock::now();
    const RadianceImage image = output.film.resolve();
    const ImageOptions imageSettings = imageOptions(options, scene, output.statistics);
    for (const std::string& file : outputs)
        writeImage(file, image, imageSettings);
    seconds.write = secondsSince(writeStart);
    seconds.total = secondsSince(start);

    warnAboutResult(scene, output.statistics);
    if (!options.report.empty()) {
        writeReport(options.report, renderReport(scene, device.info(), output.statistics, seconds));
    }
    if (output.statistics.stopped && interrupted()) {
        throw Error(
            ExitStatus::kInterrupted,
            fmt::format("interrupted: wrote what there is, {} of {} samples", output.statistics.samples,
                        std::uint64_t{scene.render.width} * scene.render.height * scene.render.spp));
    }
}

}  // namespace

void addRenderCommand(CLI::App& app) {
    const auto options = std::make_shared<RenderOptions>();
    CLI::App* command = app.add_subcommand("render", "Render a scene to images");
    command->add_option("SCENE", options->scene, "The scene: .obj (with its .mtl) or .json")->required();
    command
        ->add_option(
            "-o,--output", options->outputs,
            "Image to write: .exr, .png or .pfm; may be given several times (default: SCENE's name + .png)")
        ->type_name("FILE")
        ->expected(1)
        ->take_all();
    std::vector<std::string> names;
    for (const Preset& preset : presets())
        names.emplace_back(preset.name);
    CLI::Option* preset =
        command->add_option("--preset", options->preset, "Scene-wide reflectance of the paper")
            ->type_name("NAME")
            ->check(CLI::IsMember(names));
    command
        ->add_option("--blend", options->blend,
                     "Scene-wide reflectance: any point T,O of the square between the presets "
                     "(local 1,0; global 0,1; shadowless 1,1; one-bounce 0,0)")
        ->type_name("T,O")
        ->excludes(preset);
    command->add_option("--spp", options->spp, "Samples per pixel")
        ->type_name("N")
        ->check(CLI::Range(1, 1 << 24));
    command->add_option("--size", options->size, "Image size as WIDTHxHEIGHT")->type_name("WIDTHxHEIGHT");
    command->add_option("--bounces", options->bounces, "Largest number of scattering events on a path")
        ->type_name("N")
        ->check(CLI::Range(0, 65535));
    command->add_option("--seed", options->seed, "Seed of the random numbers")->type_name("N");
    command
        ->add_option("--sampler", options->sampler,
                     "Samples: Owen-scrambled Sobol points, or independent ones")
        ->type_name("NAME")
        ->check(CLI::IsMember({"sobol", "independent"}));
    command
        ->add_option(
            "--device", options->device,
            "cpu, gpu, an index or a part of a name, see 'duolux devices' (default: a GPU if there is one)")
        ->type_name("DEVICE");
    command
        ->add_option("--time-limit", options->timeLimit,
                     "Stop after this many seconds of rendering with what has been accumulated")
        ->type_name("SECONDS")
        ->check(between(1e-3, 1e9));
    command->add_option("--exposure", options->exposure, "Stops by which a PNG is brightened")
        ->type_name("STOPS")
        ->check(between(-64.0, 64.0));
    command
        ->add_option("--report", options->report,
                     "Write statistics as JSON to this file (-: standard output)")
        ->type_name("FILE");
    command->add_flag("--quiet", options->quiet, "No progress on standard error");
    command->callback([options] { runRender(*options); });
}

}  // namespace duolux

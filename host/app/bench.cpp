#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include "host/app/commands.h"
#include "host/app/machine_options.h"
#include "host/app/tuning_options.h"
#include "host/base/error.h"
#include "host/cli/console.h"
#include "host/cli/options.h"
#include "host/cli/outputs.h"
#include "host/cli/temporary_folder.h"
#include "host/loaders/scene_file.h"
#include "host/scene/scene.h"
#include "host/tools/bench/bench_report.h"
#include "host/tools/bench/builtin_scenes.h"
#include "host/tools/bench/suite.h"

namespace duolux {

namespace {

struct BenchOptions {
    std::vector<std::string> scenes{"cornell", "spot", "two-spheres-1000", "two-spheres-500000"};
    std::vector<std::string> only;
    std::string device, size = "512x512", json, baseline;
    std::uint32_t repeat = 5, spp = 16, bounces = 16;
    double threshold = 0.1;
    TuningOptions tuning;
    bool quiet = false;
};

/// Throws UsageError unless the baseline was measured with identical settings.
void checkSettings(const std::map<std::string, double>& settings, const Baseline& baseline,
                   const std::string& file) {
    for (const auto& [name, value] : settings) {
        const auto then = baseline.settings.find(name);
        if (name == "repeat" || then == baseline.settings.end() || then->second == value) continue;
        throw UsageError(
            fmt::format("--baseline {}: was measured with {} {:g}, not {:g}; expected equal settings", file,
                        name, then->second, value));
    }
}

void bench(const BenchOptions& options) {
    const glm::uvec2 size = parseSize(options.size);
    checkBenchScenes(options.scenes);
    std::vector<std::string> inputs = options.scenes;
    inputs.push_back(options.baseline);
    std::vector<OutputFile> outputs;
    if (!options.json.empty() && options.json != "-") outputs.push_back({"--json", options.json, false});
    checkOutputs(outputs, inputs);
    Baseline baseline;
    const std::map<std::string, double> settings{{"width", size.x},
                                                 {"height", size.y},
                                                 {"spp", options.spp},
                                                 {"bounces", options.bounces},
                                                 {"repeat", options.repeat}};
    if (!options.baseline.empty()) {
        baseline = readBaseline(options.baseline);
        checkSettings(settings, baseline, options.baseline);
    }
    Device device = openDevice(options.device);
    const bool table = options.json != "-";
    if (table) fmt::print("{}, {}\n", device.info().name, device.info().driver);
    const TemporaryFolder scratch;
    std::vector<BenchResult> results;
    std::map<std::string, Tuning> tunings;
    for (const std::string& scene : options.scenes) {
        const std::string name = benchName(scene);
        const std::filesystem::path folder = scratch.path() / std::to_string(results.size());
        std::filesystem::create_directories(folder);
        const SceneSuite suite(device, name, benchSceneFile(scene, folder),
                               {size.x, size.y, options.spp, options.bounces, options.tuning.choice(),
                                "/proc/self/exe", options.only},
                               folder);
        checkNotRead(outputs, suite.files());
        tunings[name] = suite.tuning();
        const auto onRun = [&](const std::string& what) {
            if (!options.quiet) say(what);
        };
        const std::vector<BenchResult> measured = runBenchmarks(suite.benchmarks(), options.repeat, onRun);
        results.insert(results.end(), measured.begin(), measured.end());
    }
    if (results.empty()) {
        throw UsageError(
            fmt::format("bench: no benchmark's name contains {}; expected a part of SCENE/ and one of {}",
                        fmt::join(options.only, " or "), kBenchmarkNames));
    }
    if (table) {
        for (const auto& [scene, tuning] : tunings)
            fmt::print("{}: {} layout, {} kernel\n", scene, nameOf(tuning.layout), nameOf(tuning.kernel));
        fmt::print("{}", benchTable(results));
    }
    WriteAll write;
    if (!options.json.empty()) {
        const std::string json = benchJson(results, device.info(), settings, tunings);
        write(options.json, [&](const std::filesystem::path& path) { writeReport(path, json); });
    }
    if (options.baseline.empty()) return write.finish();
    const BaselineComparison comparison = compareWithBaseline(results, baseline, options.threshold);
    if (table) {
        fmt::print("\n{}", comparison.table);
    } else {
        std::istringstream lines(comparison.table);
        for (std::string line; std::getline(lines, line);)
            say(line);
    }
    if (baseline.device != device.info().name || baseline.driver != device.info().driver ||
        baseline.host != hostProcessor()) {
        warn(fmt::format("{} was measured on {}, {}, {}; this is {}, {}, {}", options.baseline,
                         baseline.device, baseline.driver, baseline.host, device.info().name,
                         device.info().driver, hostProcessor()));
    }
    write.finish();
    if (comparison.compared == 0)
        throw UsageError(fmt::format("{}: has none of these benchmarks", options.baseline));
    if (!comparison.regressions.empty()) {
        throw MachineError(fmt::format("{} of {} benchmarks are more than {:g} % slower than in {}: {}",
                                       comparison.regressions.size(), comparison.compared,
                                       100.0 * options.threshold, options.baseline,
                                       fmt::join(comparison.regressions, ", ")));
    }
}

}  // namespace

void addBenchCommand(CLI::App& app) {
    CLI::App* command = app.add_subcommand("bench", "Measure kernels, whole renders and host code");
    auto options = std::make_shared<BenchOptions>();
    command
        ->add_option("SCENE", options->scenes,
                     fmt::format("Scene files ({}), or built-in: {}", sceneExtensions(),
                                 fmt::join(builtinSceneNames(), ", ")))
        ->capture_default_str();
    addRepeatable(
        *command, "--only", options->only,
        fmt::format(
            "Only benchmarks whose names contain this text; may be repeated. Names are SCENE/ and one of {}",
            kBenchmarkNames));
    addDeviceOption(*command, options->device);
    addThreadsOption(*command);
    addTuningOptions(*command, options->tuning);
    command
        ->add_option("--repeat", options->repeat,
                     "Measured runs of each benchmark, interleaved, after one warm-up run")
        ->type_name("N")
        ->capture_default_str()
        ->check(wholeNumber(1, 1000));
    command->add_option("--size", options->size, "Image size; also the number of rays in a ray set")
        ->type_name("WIDTHxHEIGHT")
        ->capture_default_str();
    command->add_option("--spp", options->spp, "Samples per pixel of images")
        ->type_name("N")
        ->capture_default_str()
        ->check(wholeNumber(1, 65536));
    command->add_option("--bounces", options->bounces, "Bounces of images; shadowless: at most 4")
        ->type_name("N")
        ->capture_default_str()
        ->check(wholeNumber(0, RenderSettings::kMostBounces));
    command
        ->add_option("--json", options->json,
                     "Write all results as JSON to this file (-: standard output instead of the table)")
        ->type_name("FILE")
        ->check(notEmpty());
    command
        ->add_option("--baseline", options->baseline,
                     "Earlier --json file with the same settings: print ratios; exit status 1 if slower")
        ->type_name("FILE")
        ->check(notEmpty());
    command
        ->add_option("--threshold", options->threshold,
                     "Fraction by which a median may be slower than the baseline's")
        ->type_name("PART")
        ->capture_default_str()
        ->check(between(0, 1));
    command->add_flag("--quiet", options->quiet,
                      "Do not print the names of running benchmarks on standard error");
    command->callback([options] { bench(*options); });
}

}  // namespace duolux

// duolux-peers: traces the same rays, and runs the same path tracer, with Embree and with Duolux in turns on
// the same cores.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "host/base/error.h"
#include "host/bvh/wide_bvh.h"
#include "host/cli/options.h"
#include "host/cli/outputs.h"
#include "host/cli/program.h"
#include "host/cli/temporary_folder.h"
#include "host/render/render.h"
#include "host/scene/emitters.h"
#include "host/tools/bench/bench_report.h"
#include "host/tools/bench/builtin_scenes.h"
#include "host/tools/bench/ray_sets.h"
#include "host/tools/bench/trace_kernel.h"
#include "host/tools/peers/embree_path_tracer.h"
#include "host/tools/peers/embree_scene.h"
#include "host/view/load.h"

namespace {

using namespace duolux;

struct PeerOptions {
    std::vector<std::string> scenes{"cornell", "two-spheres-500000"};
    std::vector<std::string> only;
    std::string device = "cpu", json;
    std::uint32_t repeat = 5, spp = 16, size = 512, bounces = 16;
};

BenchTimes timed(const std::function<void()>& work) {
    return {secondsOf(work), 0.0};
}

/// One scene with both renderers: for each benchmark Duolux first, then Embree.
class Pair {
  public:
    Pair(Device& device, const std::string& name, const std::filesystem::path& file,
         const PeerOptions& options)
        : device_(device), scene_(loadScene(file)), options_(options) {
        scene_.reflectance = *presetReflectance("global");
        scene_.settings.width = scene_.settings.height = options.size;
        scene_.settings.spp = options.spp;
        scene_.settings.bounces = options.bounces;
        deviceScene_ = std::make_unique<DeviceScene>(uploadScene(device, scene_));
        embree_ = std::make_unique<EmbreeScene>(scene_.geometry);
        emitters_ = buildEmitterTable(scene_, listEmitters(scene_), false);
        addRays(name);
        addRender(name);
        addBuild(name);
    }

    const std::vector<Benchmark>& benchmarks() const { return benchmarks_; }
    const Tuning& tuning() const { return deviceScene_->tuning; }

    /// Mean radiance of the picture by Duolux and by Embree.
    void compareImages() const {
        const std::vector<glm::vec3> ours = render(device_, scene_).film.resolve().visible;
        const std::vector<glm::vec3> theirs =
            renderByEmbree(*embree_, scene_, scene_.settings, emitters_).visible;
        glm::dvec3 a(0.0), b(0.0);
        for (std::size_t i = 0; i < ours.size(); ++i)
            a += glm::dvec3(ours[i]), b += glm::dvec3(theirs[i]);
        const auto n = static_cast<double>(ours.size());
        fmt::print("{}: mean radiance by Duolux {:.5f} {:.5f} {:.5f}, by Embree {:.5f} {:.5f} {:.5f}\n",
                   scene_.source.filename().string(), a.x / n, a.y / n, a.z / n, b.x / n, b.y / n, b.z / n);
    }

  private:
    void add(const std::string& name, const std::string& unit, double work, std::function<BenchTimes()> ours,
             std::function<BenchTimes()> theirs) {
        if (!isChosen(name, options_.only)) return;
        benchmarks_.push_back({name + "/duolux", unit, work, std::move(ours), {}});
        benchmarks_.push_back({name + "/embree", unit, work, std::move(theirs), {}});
    }

    void addRays(const std::string& name) {
        sets_ = makeRaySets(device_, scene_, *deviceScene_, options_.size, options_.size);
        for (const RaySet& set : sets_) {
            if (set.mode == shared::kTraceAllCrossings) continue;  // Embree would need a filter function
            kernels_.push_back(std::make_unique<TraceKernel>(device_, *deviceScene_, set.mode, set.rays));
            TraceKernel& kernel = *kernels_.back();
            add(
                name + "/rays/" + set.name, "Mrays/s", static_cast<double>(set.rays.size()) * 4e-6,
                [&kernel] { return kernel.run(4); },
                [this, &set] {
                    return timed([&] {
                        for (int pass = 0; pass < 4; ++pass)
                            embree_->trace(set.rays, set.mode, distances_);
                    });
                });
        }
    }

    void addRender(const std::string& name) {
        const double samples =
            static_cast<double>(scene_.settings.width) * scene_.settings.height * scene_.settings.spp;
        add(
            name + "/render/global", "Msamples/s", samples * 1e-6,
            [this] {
                const RenderStatistics s = render(device_, scene_).statistics;
                return BenchTimes{s.renderSeconds, s.deviceSeconds};
            },
            [this] { return timed([&] { renderByEmbree(*embree_, scene_, scene_.settings, emitters_); }); });
    }

    void addBuild(const std::string& name) {
        add(
            name + "/build", "Mtriangles/s", static_cast<double>(scene_.geometry.triangles.size()) * 1e-6,
            [this] { return timed([&] { buildWideBvh(scene_.geometry); }); },
            [this] {
                return BenchTimes{EmbreeScene(scene_.geometry).buildSeconds(), 0.0};
            });
    }

    Device& device_;
    LoadedScene scene_;
    const PeerOptions& options_;
    std::unique_ptr<DeviceScene> deviceScene_;
    std::unique_ptr<EmbreeScene> embree_;
    EmitterTable emitters_;
    std::vector<RaySet> sets_;
    std::vector<std::unique_ptr<TraceKernel>> kernels_;
    std::vector<float> distances_;
    std::vector<Benchmark> benchmarks_;
};

void printRatios(const std::vector<BenchResult>& results) {
    fmt::print("\n{:<44} {:>8}\n", "Duolux / Embree, medians", "ratio");
    for (std::size_t i = 0; i + 1 < results.size(); i += 2) {
        const std::string& name = results[i].name;
        fmt::print("{:<44} {:>8.2f}\n", name.substr(0, name.rfind('/')),
                   results[i].wall().median / results[i + 1].wall().median);
    }
}

void run(const PeerOptions& options) {
    checkBenchScenes(options.scenes);
    if (!options.json.empty()) checkOutputs({{"--json", options.json, false}}, options.scenes);
    Device device(options.device);
    fmt::print("{}, {}\n", device.info().name, device.info().driver);
    const TemporaryFolder scratch;
    std::vector<BenchResult> results;
    std::map<std::string, Tuning> tunings;
    for (const std::string& scene : options.scenes) {
        const std::string name = benchName(scene);
        const Pair pair(device, name, benchSceneFile(scene, scratch.path() / name), options);
        pair.compareImages();
        tunings[name] = pair.tuning();
        const std::vector<BenchResult> measured =
            runBenchmarks(pair.benchmarks(), options.repeat, [](const std::string&) {});
        results.insert(results.end(), measured.begin(), measured.end());
    }
    if (results.empty()) {
        throw UsageError(fmt::format("no benchmark's name contains {}", fmt::join(options.only, " or ")));
    }
    fmt::print("{}", benchTable(results));
    printRatios(results);
    if (!options.json.empty()) {
        const std::string json = benchJson(results, device.info(),
                                           {{"width", options.size},
                                            {"height", options.size},
                                            {"spp", options.spp},
                                            {"bounces", options.bounces},
                                            {"repeat", options.repeat}},
                                           tunings);
        WriteAll write;
        write(options.json, [&](const std::filesystem::path& path) { writeReport(path, json); });
        write.finish();
    }
}

void parseAndRun(int argc, char** argv) {
    CLI::App app(
        "Compares Duolux with Embree (single rays) on the same rays, with the same path tracer, on the same\n"
        "cores, in alternating runs.",
        "duolux-peers");
    setUpProgram(app);
    PeerOptions options;
    app.add_option("SCENE", options.scenes,
                   fmt::format("Scene files, or {}", fmt::join(builtinSceneNames(), ", ")))
        ->capture_default_str();
    addRepeatable(app, "--only", options.only,
                  "Only benchmarks whose names contain this text; may be repeated");
    app.add_option("--device", options.device, "Duolux's device")->capture_default_str();
    app.add_option("--repeat", options.repeat, "Measured runs")
        ->capture_default_str()
        ->check(wholeNumber(1, 1000));
    app.add_option("--size", options.size, "Width and height in pixels")
        ->capture_default_str()
        ->check(wholeNumber(1, 16384));
    app.add_option("--spp", options.spp, "Samples per pixel")
        ->capture_default_str()
        ->check(wholeNumber(1, 65536));
    app.add_option("--bounces", options.bounces, "Bounces")
        ->capture_default_str()
        ->check(wholeNumber(0, 65535));
    app.add_option("--json", options.json, "Write all results as JSON to this file");
    if (parseArguments(app, {argv + 1, argv + argc})) run(options);
}

}  // namespace

int main(int argc, char** argv) {
    return runMain("duolux-peers", [&] { parseAndRun(argc, argv); });
}

#include "host/tools/bench/suite.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "host/base/error.h"
#include "host/base/parallel.h"
#include "host/bvh/wide_bvh.h"
#include "host/cli/process.h"
#include "host/render/light_tracer_kernel.h"
#include "host/render/path_tracer_kernel.h"
#include "host/render/pixel_order.h"
#include "host/render/render.h"
#include "host/tools/bench/ray_sets.h"
#include "host/tools/bench/trace_kernel.h"
#include "host/view/load.h"

namespace duolux {

namespace {

double secondsOfProgram(const std::string& program, const std::vector<std::string>& arguments,
                        const std::vector<std::string>& environment) {
    int status = 0;
    const double seconds = secondsOf([&] { status = runProcess(program, arguments, environment); });
    if (status != 0) throw MachineError(fmt::format("{}: failed as a benchmark of starting up", program));
    return seconds;
}

struct NamedReflectance {
    const char* name;
    std::uint32_t bounces;  ///< at most; shadowless light in closed rooms grows with every bounce
};
constexpr NamedReflectance kPresets[] = {
    {"global", UINT32_MAX}, {"shadowless", 4}, {"one-bounce", UINT32_MAX}, {"local", UINT32_MAX}};

std::string rayBenchmark(const std::string& set) {
    return "rays/" + set;
}

/// The number of repetitions of a task with this duration, so that the overhead of a run is negligible.
std::uint32_t passesOf(double seconds) {
    constexpr double kSecondsPerRun = 0.05;
    return static_cast<std::uint32_t>(std::clamp(std::ceil(kSecondsPerRun / seconds), 1.0, 1000.0));
}

}  // namespace

struct SceneSuite::State {
    Device& device;
    std::string name;
    std::filesystem::path path, folder;
    SuiteOptions options;
    LoadedScene scene;
    DeviceScene deviceScene;
    std::vector<RaySet> raySets;
    std::vector<std::unique_ptr<TraceKernel>> kernels;
    std::vector<Benchmark> benchmarks;

    State(Device& device_, std::string name_, std::filesystem::path path_, std::filesystem::path folder_,
          SuiteOptions options_)
        : device(device_),
          name(std::move(name_)),
          path(std::move(path_)),
          folder(std::move(folder_)),
          options(std::move(options_)),
          scene(loadScene(path)),
          deviceScene(uploadScene(device, scene, Integrator::kPathTracer, options.tuning)) {}

    bool wanted(const std::string& what) const { return isChosen(name + "/" + what, options.only); }

    void add(const std::string& what, std::string unit, double work, std::function<BenchTimes()> run,
             std::map<std::string, double> notes = {}) {
        if (!wanted(what)) return;
        benchmarks.push_back({name + "/" + what, std::move(unit), work, std::move(run), std::move(notes)});
    }

    std::map<std::string, double> countTraversal(const RaySet& set) const;
    void addRays();
    void addRenders();
    void addFilm(const std::string& integrator, std::size_t pixels, std::size_t bytesPerPixel,
                 const std::function<void()>& readBack);
    void addFilms();
    void addHost();
    void addStart();
};

/// Counts the traversal's steps for the rays of a set, in parts, because sums have 32 bits.
std::map<std::string, double> SceneSuite::State::countTraversal(const RaySet& set) const {
    if (deviceScene.tuning.layout == Layout::kRayQuery) return {};
    constexpr std::size_t kPart = std::size_t{1} << 20;
    double nodes = 0.0, pairs = 0.0, nodeSteps = 0.0, pairSteps = 0.0;
    for (std::size_t first = 0; first < set.rays.size(); first += kPart) {
        const std::span<const shared::TraceRay> rays(set.rays);
        TraceKernel counting(device, deviceScene, set.mode,
                             rays.subspan(first, std::min(kPart, rays.size() - first)), true);
        counting.run();
        const shared::TraceCounts counts = counting.counts();
        nodes += counts.nodes;
        pairs += counts.pairs;
        nodeSteps += counts.nodeSteps;
        pairSteps += counts.pairSteps;
    }
    const auto rays = static_cast<double>(set.rays.size());
    const double lanes = deviceScene.tuning.lanes;
    return {{"nodes_per_ray", nodes / rays},
            {"pairs_per_ray", pairs / rays},
            {"node_bytes_per_ray", nodes * 16.0 * shared::kNodeTexels / rays},
            {"pair_bytes_per_ray", pairs * 16.0 * shared::kPairTexels / rays},
            {"lanes_in_nodes", nodes / (lanes * std::max(nodeSteps, 1.0))},
            {"lanes_in_pairs", pairs / (lanes * std::max(pairSteps, 1.0))}};
}

void SceneSuite::State::addRays() {
    if (std::ranges::none_of(kRaySetNames, [&](const char* set) { return wanted(rayBenchmark(set)); }))
        return;
    raySets = makeRaySets(device, scene, deviceScene, options.width, options.height);
    for (const RaySet& set : raySets) {
        if (!wanted(rayBenchmark(set.name))) continue;
        kernels.push_back(std::make_unique<TraceKernel>(device, deviceScene, set.mode, set.rays));
        TraceKernel& kernel = *kernels.back();
        kernel.run();
        kernel.hits();  // throws if the driver has ended loops early
        const std::uint32_t passes = passesOf(kernel.run().wall);
        add(
            rayBenchmark(set.name), "Mrays/s", static_cast<double>(set.rays.size()) * passes * 1e-6,
            [&kernel, passes] { return kernel.run(passes); }, countTraversal(set));
    }
}

void SceneSuite::State::addRenders() {
    for (const NamedReflectance& preset : kPresets) {
        for (const Integrator integrator : {Integrator::kPathTracer, Integrator::kLightTracer}) {
            const double samples = static_cast<double>(options.width) * options.height * options.spp;
            add(fmt::format("render/{}/{}", preset.name, nameOf(integrator)), "Msamples/s", samples * 1e-6,
                [this, &preset, integrator] {
                    scene.reflectance = *presetReflectance(preset.name);
                    scene.settings.width = options.width;
                    scene.settings.height = options.height;
                    scene.settings.spp = options.spp;
                    scene.settings.bounces = std::min(options.bounces, preset.bounces);
                    scene.settings.integrator = integrator;
                    RenderControl control;
                    control.tuning = options.tuning;
                    const RenderStatistics statistics = render(device, scene, control).statistics;
                    return BenchTimes{statistics.renderSeconds, statistics.deviceSeconds};
                });
        }
    }
}

void SceneSuite::State::addFilm(const std::string& integrator, std::size_t pixels, std::size_t bytesPerPixel,
                                const std::function<void()>& readBack) {
    readBack();
    const std::uint32_t passes = passesOf(secondsOf(readBack));
    add("film/" + integrator, "Mpixels/s", static_cast<double>(pixels) * passes * 1e-6,
        [readBack, passes] {
            return BenchTimes{secondsOf([&] {
                                  for (std::uint32_t pass = 0; pass < passes; ++pass)
                                      readBack();
                              }),
                              0.0};
        },
        {{"bytes_per_pixel", static_cast<double>(bytesPerPixel)}});
}

/// Adds the results of a finished dispatch to the film of the render.
void SceneSuite::State::addFilms() {
    scene.settings.width = options.width;
    scene.settings.height = options.height;
    scene.settings.bounces = 1;
    const auto film = std::make_shared<Film>(options.width, options.height, 0x1p-30f);

    const auto pixels =
        std::make_shared<std::vector<std::uint32_t>>(pixelOrder(options.width, options.height));
    if (wanted("film/path")) {
        const auto count =
            static_cast<std::uint32_t>(std::min<std::size_t>(pixels->size(), PathTracerKernel::kMaxPixels));
        const auto pathTracer = std::make_shared<PathTracerKernel>(
            RenderInputs{device, deviceScene, scene, scene.settings}, *pixels, count, false);
        pathTracer->submit(0, {0, count, 0, 1}, film->quantum());
        pathTracer->wait(0);
        addFilm("path", count, sizeof(shared::PixelResult),
                [pixels, pathTracer, film] { pathTracer->addTo(*film, 0); });
    }
    if (wanted("film/light")) {
        const auto lightTracer = std::make_shared<LightTracerKernel>(
            RenderInputs{device, deviceScene, scene, scene.settings}, 1, TestLimits{});
        addFilm("light", pixels->size(), sizeof(Film::PixelSum), [lightTracer, film] {
            bool partly = false;
            lightTracer->takeFilm(*film, partly);
            lightTracer->clearFilm();
        });
    }
}

void SceneSuite::State::addHost() {
    const auto triangles = static_cast<double>(scene.geometry.triangles.size());
    add("load", "MB/s", static_cast<double>(scene.meshBytes) * 1e-6, [this] {
        return BenchTimes{secondsOf([this] { loadScene(path); }), 0.0};
    });
    add("build", "Mtriangles/s", triangles * 1e-6, [this] {
        // The driver builds its tree from uploaded buffers.
        if (deviceScene.tuning.layout == Layout::kRayQuery) {
            return BenchTimes{
                uploadScene(device, scene, Integrator::kPathTracer, options.tuning).buildSeconds, 0.0};
        }
        return BenchTimes{secondsOf([this] { buildWideBvh(scene.geometry); }), 0.0};
    });
    const auto bytes = static_cast<double>(deviceScene.deviceBytes());
    add("upload", "MB/s", bytes * 1e-6,
        [this] {
            return BenchTimes{
                uploadScene(device, scene, Integrator::kPathTracer, options.tuning).uploadSeconds, 0.0};
        },
        {{"bytes_per_triangle", bytes / triangles}});
}

void SceneSuite::State::addStart() {
    if (options.program.empty()) return;
    const std::vector<std::string> arguments{"render",
                                             path.string(),
                                             "--size",
                                             "64x64",
                                             "--spp",
                                             "1",
                                             "--quiet",
                                             "--device",
                                             std::to_string(device.info().index),
                                             "--layout",
                                             nameOf(deviceScene.tuning.layout),
                                             "--kernel",
                                             nameOf(deviceScene.tuning.kernel),
                                             "--threads",
                                             std::to_string(workerCount()),
                                             "-o",
                                             (folder / "start.pfm").string()};
    add("start/warm", "s", 1.0, [=, this] {
        return BenchTimes{secondsOfProgram(options.program, arguments, {}), 0.0};
    });
    add("start/cold", "s", 1.0, [=, this] {
        const std::filesystem::path cache = folder / "cache";
        std::filesystem::remove_all(cache);
        std::filesystem::create_directories(cache);
        return BenchTimes{
            secondsOfProgram(options.program, arguments, {"MESA_SHADER_CACHE_DIR=" + cache.string()}), 0.0};
    });
}

SceneSuite::SceneSuite(Device& device, std::string name, const std::filesystem::path& scene,
                       SuiteOptions options, std::filesystem::path folder)
    : state_(std::make_unique<State>(device, std::move(name), scene, std::move(folder), std::move(options))) {
    state_->addRays();
    state_->addRenders();
    state_->addFilms();
    state_->addHost();
    state_->addStart();
}

SceneSuite::~SceneSuite() = default;

const std::vector<std::filesystem::path>& SceneSuite::files() const {
    return state_->scene.files;
}

const Tuning& SceneSuite::tuning() const {
    return state_->deviceScene.tuning;
}

const std::vector<Benchmark>& SceneSuite::benchmarks() const {
    return state_->benchmarks;
}

}  // namespace duolux

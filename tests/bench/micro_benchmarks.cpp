// Benchmarks of the host's own code, by Google Benchmark: build/release/tests/bench/micro_benchmarks --help.
#include <benchmark/benchmark.h>

#include <filesystem>
#include <map>
#include <numeric>

#include "host/bvh/binary_bvh.h"
#include "host/bvh/collapse.h"
#include "host/bvh/wide_bvh.h"
#include "host/cli/temporary_folder.h"
#include "host/film/film.h"
#include "host/tools/bench/builtin_scenes.h"
#include "host/view/load.h"

namespace {

using namespace duolux;

/// Two spheres with about this many triangles, as a file and as a scene; generated once.
struct TwoSpheres {
    std::filesystem::path file;
    LoadedScene scene;
    std::uintmax_t bytes = 0;
};

const TwoSpheres& twoSpheres(std::int64_t triangles) {
    static const TemporaryFolder folder;
    static std::map<std::int64_t, TwoSpheres> made;
    TwoSpheres& entry = made[triangles];
    if (entry.file.empty()) {
        const std::string name = "two-spheres-" + std::to_string(triangles);
        entry.file = writeBuiltinScene(name, folder.path() / name);
        entry.scene = loadScene(entry.file);
        entry.bytes = std::filesystem::file_size(folder.path() / name / "two_spheres.obj");
    }
    return entry;
}

std::vector<TrianglePair> pairsOf(const Geometry& geometry) {
    return pairTriangles(geometry, allTriangles(geometry));
}

void countTriangles(benchmark::State& state, const Geometry& geometry) {
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(geometry.triangles.size()));
}

void LoadObj(benchmark::State& state) {
    const TwoSpheres& scene = twoSpheres(state.range(0));
    for (auto _ : state)
        benchmark::DoNotOptimize(loadScene(scene.file));
    state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(scene.bytes));
}

void PairTriangles(benchmark::State& state) {
    const Geometry& geometry = twoSpheres(state.range(0)).scene.geometry;
    for (auto _ : state)
        benchmark::DoNotOptimize(pairsOf(geometry));
    countTriangles(state, geometry);
}

void BuildBinary(benchmark::State& state, SplitMethod method) {
    const Geometry& geometry = twoSpheres(state.range(0)).scene.geometry;
    const std::vector<PrimitiveRef> refs = boxesOf(geometry, pairsOf(geometry));
    for (auto _ : state) {
        std::vector<PrimitiveRef> copy = refs;
        benchmark::DoNotOptimize(buildBinaryBvh(copy, method));
    }
    countTriangles(state, geometry);
}

void Collapse(benchmark::State& state) {
    const Geometry& geometry = twoSpheres(state.range(0)).scene.geometry;
    std::vector<PrimitiveRef> refs = boxesOf(geometry, pairsOf(geometry));
    const BinaryBvh binary = buildBinaryBvh(refs, SplitMethod::kBinnedSah);
    for (auto _ : state)
        benchmark::DoNotOptimize(CollapsePlan(binary));
    countTriangles(state, geometry);
}

void BuildWide(benchmark::State& state) {
    const Geometry& geometry = twoSpheres(state.range(0)).scene.geometry;
    for (auto _ : state)
        benchmark::DoNotOptimize(buildWideBvh(geometry));
    countTriangles(state, geometry);
}

void ResolveFilm(benchmark::State& state) {
    const auto side = static_cast<std::uint32_t>(state.range(0));
    Film film(side, side, 1.0f / 1024.0f);
    std::vector<std::uint32_t> pixels(std::size_t{side} * side);
    std::iota(pixels.begin(), pixels.end(), 0u);
    film.add(pixels, std::vector<Film::PixelSum>(pixels.size(), Film::PixelSum{{1, 2, 3}, {4, 5, 6}}), 4);
    for (auto _ : state)
        benchmark::DoNotOptimize(film.resolve());
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(pixels.size()));
}

constexpr auto kUnit = benchmark::kMillisecond;

BENCHMARK(LoadObj)->Arg(1'000)->Arg(100'000)->Arg(500'000)->Unit(kUnit)->UseRealTime();
BENCHMARK(PairTriangles)->Arg(500'000)->Unit(kUnit)->UseRealTime();
BENCHMARK_CAPTURE(BuildBinary, binned_sah, SplitMethod::kBinnedSah)
    ->Arg(1'000)
    ->Arg(500'000)
    ->Unit(kUnit)
    ->UseRealTime();
BENCHMARK_CAPTURE(BuildBinary, median, SplitMethod::kMedian)->Arg(500'000)->Unit(kUnit)->UseRealTime();
BENCHMARK(Collapse)->Arg(500'000)->Unit(kUnit)->UseRealTime();
BENCHMARK(BuildWide)->Arg(1'000)->Arg(100'000)->Arg(500'000)->Unit(kUnit)->UseRealTime();
BENCHMARK(ResolveFilm)->Arg(512)->Unit(kUnit)->UseRealTime();

}  // namespace

BENCHMARK_MAIN();

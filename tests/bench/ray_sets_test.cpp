#include "host/tools/bench/ray_sets.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "host/cli/temporary_folder.h"
#include "host/scene/hash.h"
#include "host/tools/bench/builtin_scenes.h"
#include "host/tools/bench/trace_kernel.h"
#include "host/view/load.h"
#include "shaders/embedded.h"
#include "tests/reference/triangles.h"
#include "tests/support/device.h"
#include "tests/support/spec_ids.h"
#include "tests/support/tunings.h"

namespace duolux::test {
namespace {

using reference::Crossing;
using reference::Vec3;

LoadedScene builtin(const std::string& name) {
    const TemporaryFolder folder;
    return loadScene(writeBuiltinScene(name, folder.path()));
}

TEST(BuiltinScenes, AreThoseOfTheAssets) {
    EXPECT_EQ(hashScene(builtin("cornell")), hashScene(loadScene(DUOLUX_ASSETS "/cornell/cornell.json")));
    EXPECT_EQ(hashScene(builtin("spot")), hashScene(loadScene(DUOLUX_ASSETS "/spot/spot.json")));
    EXPECT_NEAR(static_cast<double>(builtin("two-spheres-1000").geometry.triangles.size()), 1000.0, 10.0);
    EXPECT_TRUE(isBuiltinScene("two-spheres-1000"));
    for (const char* name :
         {"two-spheres", "two-spheres-", "two-spheres-x", "two-spheres-5", "Cornell", "1000"})
        EXPECT_FALSE(isBuiltinScene(name)) << name;
}

/// Compares each ray set with brute force in double precision: the nearest hit, any hit, and all crossings.
class RaySets : public testing::TestWithParam<const char*> {};

/// Rays of the set for which the kernel and brute force do not agree.
std::size_t differences(const RaySet& set, const std::vector<shared::TraceHit>& hits,
                        const Geometry& geometry) {
    const reference::Triangles triangles(geometry);
    const Bounds bounds = boundsOf(geometry);
    const double size = glm::length(Vec3(bounds.upper) - Vec3(bounds.lower));
    std::size_t count = 0;
    for (std::size_t i = 0; i < set.rays.size(); ++i) {
        const shared::TraceRay& ray = set.rays[i];
        std::vector<Crossing> found;
        triangles.crossings({Vec3(ray.origin), Vec3(ray.direction)}, static_cast<double>(ray.tMax),
                            reference::Triangles::kNone, reference::Triangles::kNone, found);
        const bool hit = hits[i].t >= 0.0f;
        bool same = hit == !found.empty();
        if (same && hit && set.mode != shared::kTraceAnyHit) {
            const double off = std::abs(static_cast<double>(hits[i].t) - found.front().distance);
            same = off < 1e-4 * (size + found.front().distance);
        }
        if (same && hit && set.mode == shared::kTraceAllCrossings) {
            // Both triangles at a shared edge are one surface.
            std::size_t surfaces = 1;
            for (std::size_t k = 1; k < found.size(); ++k)
                surfaces += found[k].distance - found[k - 1].distance > 1e-7 * size ? 1 : 0;
            same = static_cast<std::size_t>(hits[i].normal.x) == surfaces;
        }
        count += same ? 0 : 1;
    }
    return count;
}

TEST(TraceSpecialization, GivesAllConstantsOfTheKernel) {
    const std::vector<Specialization> constants = traceSpecialization({}, shared::kTraceNearest, true);
    for (const spirv::Words& kernel :
         {spirv::kTraceKernelTexel, spirv::kTraceKernelStorage, spirv::kTraceKernelRayQuery})
        EXPECT_THAT(idsLeftOut(kernel, constants), testing::IsEmpty());
}

TEST_P(RaySets, KernelsMeetWhatBruteForceMeets) {
    const LoadedScene scene = builtin(GetParam());
    const std::vector<RaySet> sets = makeRaySets(device(), scene, uploadScene(device(), scene), 40, 30);
    std::vector<std::string> names;
    for (const RaySet& set : sets) {
        names.push_back(set.name);
        EXPECT_GT(set.rays.size(), 100u) << set.name;
    }
    EXPECT_THAT(names, testing::ElementsAre("primary", "diffuse", "shadow", "crossings"));
    for (const TuningChoice& tuning : allTunings(device().info())) {
        const DeviceScene deviceScene = uploadScene(device(), scene, Integrator::kPathTracer, tuning);
        for (const RaySet& set : sets) {
            TraceKernel kernel(device(), deviceScene, set.mode, set.rays);
            kernel.run(2);
            // A ray within rounding error of an edge hits one triangle, both or none; and some rays start in
            // a corner of the room, within rounding error of another wall.
            EXPECT_LE(static_cast<double>(differences(set, kernel.hits(), scene.geometry)),
                      0.01 * static_cast<double>(set.rays.size()))
                << set.name << ", " << nameOf(tuning);
        }
    }
}

/// With three copies of each surface, a ray crosses all copies, and continues behind coincident ones.
TEST_P(RaySets, CoincidentSurfacesAreAllMet) {
    const LoadedScene once = builtin(GetParam());
    LoadedScene thrice = once;
    Geometry& geometry = thrice.geometry;
    for (int copy = 0; copy < 2; ++copy) {
        for (std::size_t i = 0; i < once.geometry.triangles.size(); ++i) {
            geometry.triangles.push_back(once.geometry.triangles[i]);
            geometry.materials.push_back(once.geometry.materials[i]);
            if (!once.geometry.normals.empty())
                geometry.normalIndices.push_back(once.geometry.normalIndices[i]);
        }
    }
    const std::vector<RaySet> sets = makeRaySets(device(), once, uploadScene(device(), once), 40, 30);
    const RaySet& crossings = sets.back();
    ASSERT_EQ(crossings.mode, shared::kTraceAllCrossings);
    for (const TuningChoice& tuning : allTunings(device().info())) {
        const auto trace = [&](const LoadedScene& scene) {
            const DeviceScene deviceScene = uploadScene(device(), scene, Integrator::kPathTracer, tuning);
            TraceKernel kernel(device(), deviceScene, crossings.mode, crossings.rays);
            kernel.run();
            return kernel.hits();
        };
        const std::vector<shared::TraceHit> single = trace(once);
        const std::vector<shared::TraceHit> triple = trace(thrice);
        std::size_t wrong = 0;
        for (std::size_t i = 0; i < single.size(); ++i)
            wrong += triple[i].t == single[i].t && triple[i].normal.x == 3.0f * single[i].normal.x ? 0 : 1;
        EXPECT_EQ(wrong, 0u) << nameOf(tuning);
    }
}

TEST_P(RaySets, CountsAreThoseOfTheRays) {
    const LoadedScene scene = builtin(GetParam());
    const DeviceScene deviceScene = uploadScene(device(), scene);
    const std::uint32_t lanes = device().info().subgroupSize;
    for (const RaySet& set : makeRaySets(device(), scene, deviceScene, 40, 30)) {
        TraceKernel counting(device(), deviceScene, set.mode, set.rays, true);
        counting.run();
        const shared::TraceCounts counts = counting.counts();
        EXPECT_GE(counts.nodes, set.rays.size()) << set.name;  // at least the root
        EXPECT_GT(counts.pairs, 0u) << set.name;
        EXPECT_LE(counts.nodes, std::uint64_t{counts.nodeSteps} * lanes) << set.name;
        EXPECT_LE(counts.pairs, std::uint64_t{counts.pairSteps} * lanes) << set.name;
        EXPECT_LE(counts.nodeSteps, counts.nodes) << set.name;
    }
}

INSTANTIATE_TEST_SUITE_P(All, RaySets, testing::Values("cornell", "two-spheres-1000"));

}  // namespace
}  // namespace duolux::test

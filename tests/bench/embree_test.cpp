#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "host/base/error.h"
#include "host/cli/temporary_folder.h"
#include "host/scene/emitters.h"
#include "host/tools/bench/builtin_scenes.h"
#include "host/tools/bench/ray_sets.h"
#include "host/tools/bench/trace_kernel.h"
#include "host/tools/peers/embree_path_tracer.h"
#include "host/tools/peers/embree_scene.h"
#include "host/view/load.h"
#include "tests/reference/tracer.h"
#include "tests/support/agreement.h"
#include "tests/support/cornell.h"
#include "tests/support/device.h"

// The Embree programs that duolux-peers measures compute the same results as Duolux.

namespace duolux::test {
namespace {

/// The same reference also tests Duolux's path tracer, in tests/statistical/cornell_test.cpp.
TEST(Embree, PathTracerMatchesTheReference) {
    LoadedScene scene = cornellBox();
    scene.reflectance = *presetReflectance("global");
    scene.settings.bounces = 8;
    scene.settings.spp = 128;
    reference::Settings settings;
    settings.width = scene.settings.width;
    settings.height = scene.settings.height;
    settings.bounces = scene.settings.bounces;
    settings.samples = 2048;
    reference::Estimates expected = reference::trace(scene, settings);
    for (reference::Estimate& pixel : expected.pixels) {
        // Embree's path tracer leaves out the invisible component.
        std::ranges::fill(pixel.mean[0], 0.0);
        std::ranges::fill(pixel.variance[0], 0.0);
    }
    const EmbreeScene embree(scene.geometry);
    const EmitterTable emitters = buildEmitterTable(scene, listEmitters(scene), false);
    std::vector<RadianceImage> renders;
    for (scene.settings.seed = 1; scene.settings.seed <= 16; ++scene.settings.seed)
        renders.push_back(renderByEmbree(embree, scene, scene.settings, emitters));
    const Agreement agreement = judge(renders, expected);
    EXPECT_TRUE(agreement.agrees) << agreement.report;
}

TEST(Embree, PathTracerRefusesWhatItLeavesOut) {
    const auto isRefused = [](void (*change)(Scene&)) {
        LoadedScene scene = cornellBox();
        scene.reflectance = *presetReflectance("global");
        scene.settings.width = scene.settings.height = scene.settings.spp = 1;
        change(scene);
        const EmbreeScene embree(scene.geometry);
        const EmitterTable emitters = buildEmitterTable(scene, listEmitters(scene), false);
        try {
            renderByEmbree(embree, scene, scene.settings, emitters);
            return false;
        } catch (const UsageError&) {
            return true;
        }
    };
    EXPECT_FALSE(isRefused([](Scene&) {}));
    EXPECT_TRUE(isRefused([](Scene& scene) { scene.reflectance = *presetReflectance("local"); }));
    EXPECT_TRUE(isRefused([](Scene& scene) {
        scene.geometry.colours.assign(scene.geometry.positions.size(), glm::vec3(0.5f));
    }));
    EXPECT_TRUE(isRefused([](Scene& scene) {
        scene.geometry.normals = {glm::vec3(0.0f, 0.0f, 1.0f)};
        scene.geometry.normalIndices.assign(scene.geometry.triangles.size(), glm::uvec3(0u));
    }));
    EXPECT_TRUE(isRefused([](Scene& scene) { scene.pointEmitters.emplace_back(); }));
    EXPECT_TRUE(isRefused([](Scene& scene) { scene.materials[0].metallic = 0.5f; }));
    EXPECT_TRUE(isRefused([](Scene& scene) { scene.materials[0].reflectance = scene.reflectance; }));
}

TEST(Embree, RaysMeetWhatOursMeet) {
    for (const char* name : {"cornell", "two-spheres-1000"}) {
        const TemporaryFolder folder;
        const LoadedScene scene = loadScene(writeBuiltinScene(name, folder.path()));
        const DeviceScene deviceScene = uploadScene(device(), scene);
        const EmbreeScene embree(scene.geometry);
        for (const RaySet& set : makeRaySets(device(), scene, deviceScene, 128, 96)) {
            if (set.mode == shared::kTraceAllCrossings) continue;
            TraceKernel kernel(device(), deviceScene, set.mode, set.rays);
            kernel.run();
            const std::vector<shared::TraceHit> ours = kernel.hits();
            std::vector<float> theirs;
            embree.trace(set.rays, set.mode, theirs);
            ASSERT_EQ(theirs.size(), ours.size());
            std::size_t differences = 0;
            for (std::size_t i = 0; i < ours.size(); ++i) {
                const bool hit = ours[i].t >= 0.0f;
                const bool far = set.mode == shared::kTraceNearest && hit &&
                                 std::abs(ours[i].t - theirs[i]) > 1e-4f * (1.0f + ours[i].t);
                differences += hit != (theirs[i] >= 0.0f) || far ? 1 : 0;
            }
            // Excepts rays within rounding error of an edge, and rays that start in a corner.
            EXPECT_LE(static_cast<double>(differences), 2e-3 * static_cast<double>(ours.size()))
                << name << " " << set.name;
        }
    }
}

}  // namespace
}  // namespace duolux::test

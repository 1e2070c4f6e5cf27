#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "host/cli/temporary_folder.h"
#include "host/generators/two_spheres.h"
#include "host/render/render.h"
#include "host/view/load.h"
#include "tests/statistical/films.h"
#include "tests/statistical/renders.h"
#include "tests/support/cornell.h"
#include "tests/support/device.h"
#include "tests/support/exact_case.h"
#include "tests/support/scene_builder.h"

// The light tracer against closed forms and against the path tracer, which uses a different order of matrix
// products and different densities. (cornell_test.cpp compares it with the reference.)

namespace duolux::test {

namespace {

class LightExact : public testing::TestWithParam<ExactCase> {};

TEST_P(LightExact, MatchesClosedForm) {
    const ExactCase& exact = GetParam();
    const std::uint32_t pixels = exact.scene.settings.width * exact.scene.settings.height;
    expectAgreement(exact.name + "Light", renderByLight(exact.scene, (1u << 17) / pixels, 16), exact.expected,
                    {.relative = exact.relative, .lightPaths = true});
}

std::vector<ExactCase> casesForLight() {
    std::vector<ExactCase> cases = exactCases();
    for (ExactCase& metal : metalCases())
        cases.push_back(std::move(metal));
    std::erase_if(cases, [](const ExactCase& exact) { return exact.onePoint; });
    return cases;
}

INSTANTIATE_TEST_SUITE_P(Often, LightExact, testing::ValuesIn(oftenCases(casesForLight())),
                         [](const auto& test) { return test.param.name; });
INSTANTIATE_TEST_SUITE_P(Nightly, LightExact, testing::ValuesIn(nightlyCases(casesForLight())),
                         [](const auto& test) { return test.param.name; });

struct PairCase {
    std::string name;
    LoadedScene scene;
};

/// For messages of the test framework.
void PrintTo(const PairCase& pair, std::ostream* out) {
    *out << pair.name;
}

/// Full matrices that do not commute and differ between channels.
Reflectance fullReflectance() {
    return {{{0.5f, 0.2f, 0.7f}, {0.4f, 0.6f, 0.1f}, {0.3f, 0.9f, 0.5f}, {0.2f, 0.3f, 0.4f}},
            {{0.3f, 0.6f, 0.1f}, {0.2f, 0.1f, 0.5f}, {0.4f, 0.2f, 0.3f}, {0.1f, 0.5f, 0.7f}}};
}

/// Identity on the invisible component, which each crossing also makes visible.
Reflectance glowing() {
    return {matrix(0.5f, 0, 0.5f, 0), matrix(1, 0, 0.25f, 0)};
}

LoadedScene twoSpheres(const Reflectance& reflectance) {
    const TemporaryFolder folder;
    writeTwoSpheres(folder.path(), 2000);
    LoadedScene scene = loadScene(folder.path() / "two_spheres.json");
    scene.reflectance = reflectance;
    scene.settings.width = scene.settings.height = 32;
    scene.settings.bounces = 4;
    return scene;
}

/// A coarse sphere above a floor, with smooth normals that differ much from those of its faces.
LoadedScene smoothSphere(const Reflectance& reflectance, Sides sides = Sides::kBoth) {
    SceneBuilder builder;
    Material grey;
    grey.name = "grey";
    grey.baseColor = {0.8f, 0.6f, 0.4f};
    grey.sides = sides;
    const std::uint32_t surface = builder.add(grey);
    builder.sphere({0, 1, 0}, 1.0f, 1, Facing::kOutward, surface);
    Geometry& geometry = builder.scene.geometry;
    geometry.normalIndices = geometry.triangles;
    for (const glm::vec3& p : geometry.positions)
        geometry.normals.push_back(glm::normalize(p - glm::vec3(0, 1, 0)));
    builder.quad({-3, -0.2f, -3}, {-3, -0.2f, 3}, {3, -0.2f, 3}, {3, -0.2f, -3}, surface);
    Material lamp;
    lamp.name = "lamp";
    lamp.baseColor = glm::vec3(0.0f);
    lamp.emission = {{20, 15, 10}, {5, 10, 15}, Sides::kFront};
    builder.quad({-1.5f, 4, 0}, {-1.5f, 3, 1}, {-2.5f, 2, 0}, {-2.5f, 3, -1}, builder.add(lamp));
    geometry.normalIndices.resize(geometry.triangles.size(), glm::uvec3(Geometry::kNoNormal));
    LoadedScene& scene = builder.scene;
    scene.reflectance = reflectance;
    scene.camera = {{0.5f, 2.5f, 5}, {0, 0.7f, 0}, {0, 1, 0}, 40.0f};
    scene.settings.width = scene.settings.height = 32;
    scene.settings.bounces = 3;
    return scene;
}

/// A floor with normals that lean far to one side, and walls that only the floor lights, because the lamp is
/// low and shines down.
LoadedScene leaningFloor() {
    SceneBuilder builder;
    Material grey;
    grey.name = "grey";
    grey.baseColor = glm::vec3(0.8f);
    const std::uint32_t surface = builder.add(grey);
    builder.quad({-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1}, surface);
    Geometry& geometry = builder.scene.geometry;
    geometry.normals.push_back(glm::normalize(glm::vec3(1, 0.7f, 0.2f)));
    geometry.normalIndices.assign(geometry.triangles.size(), glm::uvec3(0));
    builder.quad({-1, 0, -1}, {1, 0, -1}, {1, 2, -1}, {-1, 2, -1}, surface);
    builder.quad({-1, 0, 1}, {-1, 0, -1}, {-1, 2, -1}, {-1, 2, 1}, surface);
    builder.quad({1, 0, -1}, {1, 0, 1}, {1, 2, 1}, {1, 2, -1}, surface);
    Material lamp;
    lamp.name = "lamp";
    lamp.baseColor = glm::vec3(0.0f);
    lamp.emission.invisible = {30, 20, 10};
    builder.quad({-0.4f, 0.4f, -0.4f}, {-0.2f, 0.4f, -0.4f}, {-0.2f, 0.4f, 0}, {-0.4f, 0.4f, 0},
                 builder.add(lamp));
    geometry.normalIndices.resize(geometry.triangles.size(), glm::uvec3(Geometry::kNoNormal));
    LoadedScene& scene = builder.scene;
    scene.reflectance = preset("global");
    scene.camera = {{0, 1.2f, 4.5f}, {0, 0.9f, 0}, {0, 1, 0}, 38.0f};
    scene.settings.width = scene.settings.height = 32;
    scene.settings.bounces = 3;
    return scene;
}

std::vector<PairCase> pairCases() {
    std::vector<PairCase> cases;
    const std::vector<std::pair<std::string, Reflectance>> reflectances = {
        {"Local", preset("local")},
        {"Global", preset("global")},
        {"Shadowless", preset("shadowless")},
        {"OneBounce", preset("one-bounce")},
        {"Blend62", blendReflectance(0.6f, 0.2f)},
        {"Full", fullReflectance()},
        {"Glowing", glowing()}};
    for (const auto& [name, reflectance] : reflectances) {
        cases.push_back({"TwoSpheres" + name, twoSpheres(reflectance)});
        cases.push_back({"SmoothSphere" + name, smoothSphere(reflectance)});
    }
    cases.push_back({"LeaningFloor", leaningFloor()});
    // With both sides and transmission, a sphere would also scatter on its inside.
    cases.push_back({"SmoothSphereOneSided", smoothSphere(fullReflectance(), Sides::kFront)});
    // Metal, flat and with leaning normals: the light tracer samples it in importance mode.
    const auto ofMetal = [](LoadedScene scene, float roughness) {
        for (Material& material : scene.materials) {
            material.metallic = material.emission.any() ? 0.0f : 0.8f;
            material.roughness = roughness;
        }
        return scene;
    };
    cases.push_back({"MetalSphereRough", ofMetal(smoothSphere(preset("global")), 0.8f)});
    cases.push_back({"MetalFloorGlossy", ofMetal(leaningFloor(), 0.6f)});
    cases.push_back({"MetalSphereGlossy", ofMetal(smoothSphere(fullReflectance()), 0.4f)});
    cases.push_back({"MetalFloorRough", ofMetal(leaningFloor(), 0.8f)});
    // Point emitters beside the lamp, or alone.
    LoadedScene lit = smoothSphere(fullReflectance());
    lit.pointEmitters = {{{-2, 3, 0.5f}, {30, 20, 10}, {5, 10, 15}}, {{1.5f, 1.5f, 1.5f}, {1, 2, 3}, {}}};
    cases.push_back({"PointsAndLamp", lit});
    for (Material& material : lit.materials)
        material.emission = {};
    cases.push_back({"PointsAlone", lit});
    LoadedScene parallel = leaningFloor();
    parallel.camera.type = CameraType::kOrthographic;
    parallel.camera.height = 3.0f;
    cases.push_back({"Orthographic", parallel});
    return cases;
}

class Pair : public testing::TestWithParam<PairCase> {};

TEST_P(Pair, GatheringAndShootingAgree) {
    const PairCase& pair = GetParam();
    expectAgreement(pair.name + "Light", renderByLight(pair.scene, 128, 24),
                    estimatesOf(renderSeeds(pair.scene, 64, 24, 1000)), {.lightPaths = true});
}

INSTANTIATE_TEST_SUITE_P(Often, Pair, testing::ValuesIn(oftenCases(pairCases())),
                         [](const auto& test) { return test.param.name; });
INSTANTIATE_TEST_SUITE_P(Nightly, Pair, testing::ValuesIn(nightlyCases(pairCases())),
                         [](const auto& test) { return test.param.name; });

/// If both components arrive equally, every vertex must be connected, whichever component is displayed:
/// Russian roulette applies only to the component that is not displayed. The number of rays of identical
/// paths shows this.
TEST(LightPaths, WhatIsDisplayedIsAlwaysConnected) {
    LoadedScene scene = byLight(emptyCornellBox());
    scene.reflectance = preset("global");
    scene.settings.spp = 64;
    const auto raysToCamera = [&](glm::vec2 display) {
        scene.display = display;
        return render(device(), scene).statistics.shadowRays;
    };
    const std::uint64_t visible = raysToCamera({0, 1});
    EXPECT_EQ(raysToCamera({1, 0}), visible);
    EXPECT_EQ(raysToCamera({1, 1}), visible);
    // An emitter that contributes only to the component that is not displayed is connected seldom.
    for (Material& material : scene.materials)
        material.emission.visible = glm::vec3(0.0f);
    EXPECT_LT(raysToCamera({0, 1}), visible);
}

/// The camera is so near to a lit floor that the image is a million times as bright as the emission.
TEST(LightPaths, ManyTimesBrighterThanItsEmitterIsHeld) {
    SceneBuilder builder;
    Material floor, lamp;
    floor.name = "floor";
    lamp.name = "lamp";
    lamp.emission.invisible = glm::vec3(1.0f);
    const float a = 2e-3f, b = 1e-3f, h = 5e-4f;
    builder.quad({-a, 0, a}, {a, 0, a}, {a, 0, -a}, {-a, 0, -a}, builder.add(floor));
    builder.quad({-b, h, -b}, {b, h, -b}, {b, h, b}, {-b, h, b}, builder.add(lamp));
    LoadedScene& scene = builder.scene;
    scene.reflectance = {matrix(0.0f, 0.0f, 1e6f, 0.0f), {matrix(1.0f, 0.0f, 0.0f, 0.0f)}};
    scene.camera = {{0, 3e-4f, 0}, {0, 0, 0}, {0, 0, 1}, 60.0f};
    scene.settings.width = scene.settings.height = 2;
    scene.settings.bounces = 1;
    scene.settings.spp = 1u << 14;
    const RenderOutput gathered = render(device(), scene);
    scene.settings.integrator = Integrator::kLightTracer;
    const RenderOutput shot = render(device(), scene);
    EXPECT_FALSE(gathered.statistics.filmOverflowed);
    EXPECT_FALSE(shot.statistics.filmOverflowed);
    double expected = 0.0, found = 0.0;
    for (std::size_t i = 0; i < 4; ++i) {
        expected += static_cast<double>(gathered.film.resolve().visible[i].x);
        found += static_cast<double>(shot.film.resolve().visible[i].x);
    }
    EXPECT_GT(expected, 4e5);
    EXPECT_NEAR(found, expected, 0.1 * expected);  // 4 standard errors
}

/// Light that grows 28 times with each bounce, in sums beyond 64 bits, in any order and in any parts.
TEST(LightPaths, SumsOfGrowingLightAreTheSameBits) {
    const std::vector<ExactCase> cases = enclosureCases();
    const auto growing = std::ranges::find(cases, "EnclosureGrowing", &ExactCase::name);
    ASSERT_NE(growing, cases.end());
    LoadedScene scene = byLight(growing->scene);
    scene.reflectance = {matrix(35.0f, 0.0f, 35.0f, 0.0f), {}};
    scene.settings.bounces = 4;
    scene.settings.width = scene.settings.height = 4;
    scene.settings.spp = 1u << 13;
    const RenderOutput whole = render(device(), scene);
    EXPECT_FALSE(whole.statistics.filmOverflowed);
    EXPECT_GT(whole.statistics.previousBounceRadiance, 0.0);
    EXPECT_GT(whole.statistics.lastBounceRadiance, 10.0 * whole.statistics.previousBounceRadiance);

    // In a finer unit than the light tracer would choose.
    const RenderState fine{Film(whole.film.width(), whole.film.height(), whole.film.quantum() * 0x1p-24f),
                           0.0, 0.0, false};
    const auto filmOf = [&](RenderControl control) {
        control.resume = &fine;
        return render(device(), scene, control).film;
    };
    const Film expected = filmOf({});
    EXPECT_FALSE(expected.carries().empty());
    for (const auto& [noInt64Atomics, pathsPerDispatch] :
         {std::pair(true, 0u), {false, 5000u}, {true, 5000u}}) {
        RenderControl control;
        control.limits.noInt64Atomics = noInt64Atomics;
        control.limits.maxPixelsPerDispatch = pathsPerDispatch;
        EXPECT_TRUE(sameBits(filmOf(control), expected));
    }
    Film sum = fine.film;
    for (const SampleRange& range : {SampleRange{5000, scene.settings.spp}, {0, 5000}}) {
        RenderControl control;
        control.samples = range;
        sum.add(filmOf(control));
    }
    EXPECT_TRUE(sameBits(sum, expected));
}

}  // namespace

}  // namespace duolux::test

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "host/base/error.h"
#include "host/tools/gl/spot_lights.h"
#include "tests/support/closed_form.h"
#include "tests/support/scene_builder.h"

// The spot lights' irradiance against Lambert's polygon formula for the luminaire they stand for.

namespace duolux::test {
namespace {

using testing::HasSubstr;

constexpr float kRadiance = 7.0f;

/// A luminaire a x b at height 2 that faces down, oblique to the axes.
struct Luminaire {
    std::array<glm::vec3, 4> corners{
        {{-1.0f, 2.0f, -0.5f}, {1.0f, 2.0f, -1.0f}, {1.5f, 2.0f, 0.5f}, {-0.5f, 2.0f, 1.0f}}};
    LoadedScene scene;

    explicit Luminaire(Sides sides = Sides::kFront) {
        SceneBuilder builder;
        Material lamp;
        lamp.name = "lamp";
        lamp.emission = {glm::vec3(kRadiance), glm::vec3(1.0f), sides};
        const std::uint32_t index = builder.add(lamp);
        builder.quad(corners[0], corners[1], corners[2], corners[3], index);
        scene = builder.scene;
        scene.source = "scene.json";
    }

    double exactIrradiance(const Vec3& point, const Vec3& normal) const {
        std::vector<Vec3> polygon;
        for (const glm::vec3& corner : corners)
            polygon.emplace_back(corner);
        return static_cast<double>(kRadiance) * std::abs(lambertPolygon(point, normal, polygon));
    }
};

/// Sum over the lights of I max(cos, 0)^1 cos / r^2: Warn's model.
double irradiance(const std::vector<SpotLight>& lights, const Vec3& point, const Vec3& normal) {
    double sum = 0.0;
    for (const SpotLight& light : lights) {
        const Vec3 toLight = Vec3(light.position) - point;
        const double r = glm::length(toLight);
        const Vec3 w = toLight / r;
        sum += static_cast<double>(light.intensity.x) * std::max(-glm::dot(w, Vec3(light.direction)), 0.0) *
               std::max(glm::dot(w, normal), 0.0) / (r * r);
    }
    return sum;
}

TEST(SpotLights, ManyTilesConvergeToLambertsFormula) {
    const Luminaire luminaire;
    for (const auto& [point, normal] :
         {std::pair(Vec3(0, 0, 0), Vec3(0, 1, 0)), {Vec3(2, 0.5, -1), glm::normalize(Vec3(-1, 2, 0.5))}}) {
        const double exact = luminaire.exactIrradiance(point, normal);
        double last = 1.0;
        for (const char* tiling : {"2x2", "8x8", "32x32"}) {
            const double error = std::abs(
                irradiance(spotLights(luminaire.scene, Tiling::parse(tiling)), point, normal) / exact - 1.0);
            EXPECT_LT(error, last / 8.0) << tiling;  // a factor of 16 for a quarter of the tile width
            last = error;
        }
        EXPECT_LT(last, 3e-4);
    }
}

TEST(SpotLights, AllTilingsHaveTheSamePower) {
    const Luminaire luminaire;
    const double far = 1e4;
    const double exact = luminaire.exactIrradiance({0, -far, 0}, {0, 1, 0});
    for (const char* tiling : {"5", "1x1", "3x3", "2x7"}) {
        const auto lights = spotLights(luminaire.scene, Tiling::parse(tiling));
        EXPECT_NEAR(irradiance(lights, {0, -far, 0}, {0, 1, 0}) / exact, 1.0, 1e-5) << tiling;
    }
}

TEST(SpotLights, FiveAreCentreAndCorners) {
    const Luminaire luminaire;
    const auto lights = spotLights(luminaire.scene, Tiling::parse("5"));
    ASSERT_EQ(lights.size(), 5u);
    const auto& c = luminaire.corners;
    const auto at = [&](float s, float t) { return c[0] + s * (c[1] - c[0]) + t * (c[3] - c[0]); };
    for (const glm::vec3& expected : {at(0.5f, 0.5f), at(1 / 6.f, 1 / 6.f), at(5 / 6.f, 1 / 6.f),
                                      at(1 / 6.f, 5 / 6.f), at(5 / 6.f, 5 / 6.f)}) {
        EXPECT_TRUE(std::ranges::any_of(
            lights, [&](const SpotLight& l) { return glm::length(l.position - expected) < 1e-5f; }));
    }
    for (const SpotLight& light : lights)
        EXPECT_LT(glm::length(light.direction - glm::vec3(0, -1, 0)), 1e-6f);
}

TEST(SpotLights, LightsOfBothSidesShineBothWays) {
    const auto lights = spotLights(Luminaire(Sides::kBoth).scene, Tiling::parse("3x3"));
    EXPECT_EQ(lights.size(), 18u);
    EXPECT_NEAR(irradiance(lights, {0, 4, 0}, {0, -1, 0}), irradiance(lights, {0, 0, 0}, {0, 1, 0}), 1e-5);
}

TEST(SpotLights, WhatIsNoParallelogramIsRefused) {
    const auto error = [](const LoadedScene& scene) {
        try {
            spotLights(scene, Tiling::parse("5"));
        } catch (const InputError& e) {
            return std::string(e.what());
        }
        return std::string();
    };
    LoadedScene single = Luminaire().scene;
    single.geometry.triangles.pop_back();
    single.geometry.materials.pop_back();
    EXPECT_THAT(error(single), HasSubstr("scene.json: material lamp: a luminaire is not a parallelogram"));
    LoadedScene dark = Luminaire().scene;
    dark.materials[0].emission.invisible = glm::vec3(0.0f);
    EXPECT_THAT(error(dark), HasSubstr("nothing emits invisible light"));
}

TEST(SpotLights, AStripOfQuadrilateralsIsSeveralLuminaires) {
    SceneBuilder builder;
    Material lamp;
    lamp.emission = {glm::vec3(kRadiance), glm::vec3(0.0f), Sides::kFront};
    const std::uint32_t index = builder.add(lamp);
    for (int i = 0; i < 5; ++i) {
        const auto x = static_cast<float>(i);
        builder.quad({x, 2, 0}, {x + 1, 2, 0}, {x + 1, 2, 1}, {x, 2, 1}, index);
    }
    const auto lights = spotLights(builder.scene, Tiling::parse("1x1"));
    ASSERT_EQ(lights.size(), 5u);
    for (const SpotLight& light : lights)
        EXPECT_NEAR(light.position.x - std::floor(light.position.x), 0.5f, 1e-5f);
}

TEST(SpotLights, TilingsAreChecked) {
    for (const char* wrong : {"", "6", "3x", "x3", "0x3", "3x257", "3x3x3", "-1x2", "3*3"})
        EXPECT_THROW(Tiling::parse(wrong), UsageError) << wrong;
}

}  // namespace
}  // namespace duolux::test

#include <gtest/gtest.h>

#include <numbers>

#include "tests/reference/estimates_image.h"
#include "tests/reference/pinhole.h"
#include "tests/reference/triangles.h"
#include "tests/support/agreement.h"
#include "tests/support/cornell.h"
#include "tests/support/scene_builder.h"

namespace duolux::test {

namespace {

using reference::Crossing;
using reference::Ray;
using reference::Triangles;
using reference::Vec3;

TEST(Pinhole, RowsRunFromTheTopAndColumnsToTheRight) {
    const Camera camera{{0, 0, 0}, {0, 0, -1}, {0, 1, 0}, 90.0f};
    const reference::Pinhole pinhole(camera, 200, 100);
    const Ray corner = pinhole.ray(0.0, 0.0);
    const Vec3 expected = glm::normalize(Vec3(-2, 1, -1));
    EXPECT_NEAR(glm::distance(corner.direction, expected), 0.0, 1e-12);
    EXPECT_NEAR(glm::distance(pinhole.ray(100.0, 50.0).direction, Vec3(0, 0, -1)), 0.0, 1e-12);
}

TEST(Triangles, CrossingsAreSortedAndKnowTheirSide) {
    SceneBuilder builder;
    const std::uint32_t material = builder.add({});
    builder.sphere(glm::vec3(0.0f), 1.0f, 2, Facing::kInward, material);
    builder.sphere(glm::vec3(0.0f), 2.0f, 1, Facing::kOutward, material);
    const Triangles triangles(builder.scene.geometry);
    const Ray ray{{0.1, 0.2, 5.0}, glm::normalize(Vec3(0.01, -0.02, -1.0))};
    std::vector<Crossing> found;
    triangles.crossings(ray, 1e30, Triangles::kNone, Triangles::kNone, found);
    ASSERT_EQ(found.size(), 4u);
    EXPECT_TRUE(found[0].front);
    EXPECT_FALSE(found[1].front);
    EXPECT_TRUE(found[2].front);
    EXPECT_FALSE(found[3].front);
    for (std::size_t i = 1; i < found.size(); ++i)
        EXPECT_LT(found[i - 1].distance, found[i].distance);
    const std::uint32_t left = found[1].triangle;
    const double limit = found[3].distance;
    triangles.crossings(ray, limit, left, Triangles::kNone, found);
    EXPECT_EQ(found.size(), 2u);
}

TEST(Triangles, SphereAndBoxHaveTheirAreasAndFaceAsAsked) {
    SceneBuilder builder;
    const std::uint32_t material = builder.add({});
    builder.sphere({1, 2, 3}, 2.0f, 4, Facing::kOutward, material);
    const std::size_t sphereEnd = builder.scene.geometry.triangles.size();
    EXPECT_EQ(sphereEnd, 20u * 256u);
    builder.box({-1, -2, -3}, {3, 4, 5}, Facing::kInward, material);
    const Triangles triangles(builder.scene.geometry);
    double sphereArea = 0.0, boxArea = 0.0;
    for (std::uint32_t i = 0; i < triangles.size(); ++i) {
        const bool sphere = i < sphereEnd;
        (sphere ? sphereArea : boxArea) += triangles.area(i);
        const Vec3 outward = triangles.point(i, 1.0 / 3, 1.0 / 3) - (sphere ? Vec3(1, 2, 3) : Vec3(1, 1, 1));
        EXPECT_EQ(glm::dot(outward, triangles.normal(i)) > 0.0, sphere) << i;
    }
    EXPECT_NEAR(sphereArea, 16.0 * std::numbers::pi, 0.2);
    EXPECT_NEAR(boxArea, 2.0 * (4 * 6 + 6 * 8 + 8 * 4), 1e-9);
}

/// Both methods for direct light must agree; one of them uses no emitter list, area, cosine or shadow ray.
TEST(ReferenceTracer, LightSearchesAgree) {
    LoadedScene scene = mixedCornellBox();
    // A lamp that is large enough to be hit by chance.
    for (glm::vec3& p : scene.geometry.positions) {
        if (p.y == 548.3f) p = {278.0f + 3.0f * (p.x - 278.0f), p.y, 279.0f + 3.0f * (p.z - 279.0f)};
    }
    reference::Settings settings;
    settings.width = settings.height = 16;
    settings.bounces = 3;
    settings.samples = 1024;
    const reference::Estimates byArea = reference::trace(scene, settings);
    settings.search = reference::LightSearch::kDirection;
    settings.samples = 512;
    std::vector<RadianceImage> byDirection;
    for (settings.seed = 2; settings.seed <= 13; ++settings.seed) {
        byDirection.push_back(imageOf(reference::trace(scene, settings)));
    }
    const Agreement agreement = judge(byDirection, byArea);
    EXPECT_TRUE(agreement.agrees) << agreement.report;
}

TEST(ReferenceTracer, SameSettingsSameNumbers) {
    reference::Settings settings;
    settings.width = settings.height = 8;
    settings.samples = 4;
    const RadianceImage a = imageOf(reference::trace(cornellBox(), settings));
    const RadianceImage b = imageOf(reference::trace(cornellBox(), settings));
    EXPECT_EQ(a.visible, b.visible);
    settings.seed = 2;
    EXPECT_NE(imageOf(reference::trace(cornellBox(), settings)).visible, a.visible);
}

}  // namespace

}  // namespace duolux::test

#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/constants.hpp>
#include <optional>

#include "host/view/illumination.h"
#include "host/view/view_axes.h"
#include "tests/unit/view_framed.h"

namespace duolux::test {
namespace {

constexpr int kRays = 400;

/// Distance to the nearest of the scene's triangles, by testing all of them in double precision.
std::optional<double> nearest(const LoadedScene& scene, const glm::dvec3& origin,
                              const glm::dvec3& direction) {
    std::optional<double> result;
    for (const glm::uvec3& t : scene.geometry.triangles) {
        const glm::dvec3 a(scene.geometry.positions[t.x]);
        const glm::dvec3 e1 = glm::dvec3(scene.geometry.positions[t.y]) - a;
        const glm::dvec3 e2 = glm::dvec3(scene.geometry.positions[t.z]) - a;
        const glm::dvec3 n = glm::cross(e1, e2);
        const double along = glm::dot(n, direction);
        if (along == 0.0) continue;
        const double distance = glm::dot(n, a - origin) / along;
        const glm::dvec3 at = origin + distance * direction - a;
        const double u = glm::dot(glm::cross(at, e2), n) / glm::dot(n, n);
        const double v = glm::dot(glm::cross(e1, at), n) / glm::dot(n, n);
        if (distance > 0.0 && u >= 0.0 && v >= 0.0 && u + v <= 1.0 && (!result || distance < *result))
            result = distance;
    }
    return result;
}

TEST(ViewSurface, FindsTheNearestTriangleAtAnyScale) {
    for (const float size : {1e-3f, 1.0f, 1e5f}) {
        const LoadedScene scene = transformed(terrain(12), size, size * glm::vec3(100.0f, -50.0f, 70.0f));
        const Surface surface(scene, scene.geometry.triangles.size());
        ASSERT_EQ(surface.triangles().size(), scene.geometry.triangles.size());
        int hits = 0;
        for (int i = 0; i < kRays; ++i) {
            const glm::vec3 origin = 1.5f * onSphere(i, kRays);
            const glm::vec3 direction = glm::normalize(0.6f * onSphere((7 * i) % kRays, kRays) - origin);
            const auto hit = surface.firstHit(origin, direction);
            const auto expected = nearest(scene, surface.toScene(origin), glm::dvec3(direction));
            ASSERT_EQ(hit.has_value(), expected.has_value()) << i;
            if (!hit) continue;
            ++hits;
            EXPECT_NEAR(static_cast<double>(hit->distance), *expected * surface.scale(), 1e-3) << i;
            const glm::vec3 before = origin + 0.99f * hit->distance * direction;
            EXPECT_TRUE(surface.sees(origin, before));
            EXPECT_FALSE(surface.sees(origin, origin + 1.01f * hit->distance * direction));
        }
        EXPECT_GT(hits, kRays / 20);
    }
}

TEST(ViewSurface, ManyTrianglesBecomeFewerWithoutHoles) {
    const LoadedScene scene = terrain(400);
    const Surface surface(scene, scene.geometry.triangles.size());
    EXPECT_LT(surface.triangles().size(), 100'000u);
    for (int i = 0; i < kRays; ++i) {
        const float x = 1.0f + 8.0f * static_cast<float>(i % 20) / 20.0f;
        const float z = 1.0f + 8.0f * static_cast<float>(i / 20) / 20.0f;
        const auto hit = surface.firstHit(surface.toLocal(glm::dvec3(x, 5, z)), glm::vec3(0, -1, 0));
        ASSERT_TRUE(hit) << x << " " << z;
        const double height = 5.0 - static_cast<double>(hit->distance) / surface.scale();
        EXPECT_NEAR(height, 0.5 * std::sin(static_cast<double>(x)) * std::cos(1.3 * static_cast<double>(z)),
                    0.1);
        EXPECT_TRUE(hit->front);
    }
}

/// Inside a closed sphere of albedo a that emits E everywhere, a white surface shows E (1 + a + a^2 ...).
TEST(ViewSurface, IlluminationIsThatOfAFurnace) {
    SceneBuilder builder;
    Material material;
    material.baseColor = glm::vec3(0.5f);
    material.emission.invisible = glm::vec3(2.0f);
    builder.sphere({0, 0, 0}, 1.0f, 2, Facing::kInward, builder.add(material));
    const Surface surface(builder.scene, builder.scene.geometry.triangles.size());
    const Illumination illumination(surface);
    double sum = 0.0;
    constexpr int kPoints = 100;
    for (std::uint32_t i = 0; i < kPoints; ++i) {
        const glm::vec3 direction = onSphere(static_cast<int>(i), kPoints);
        const auto hit = surface.firstHit(glm::vec3(0), direction);
        ASSERT_TRUE(hit);
        const SurfacePoint point = pointOf(surface, glm::vec3(0), direction, *hit);
        EXPECT_TRUE(point.front);
        sum += static_cast<double>(illumination.onWhite(point, i + 1, 50)) / kPoints;
    }
    EXPECT_NEAR(sum, 2.0 * (1.0 + 0.5 + 0.25 + 0.125), 0.15) << "four scatterings";
}

/// A point of intensity I at the height h above white gives it the radiance I / (pi h^2).
TEST(ViewSurface, IlluminationByAPointIsThatOfItsPlaceInTheScene) {
    for (const float size : {0.1f, 1.0f, 50.0f}) {
        const glm::vec3 centre = size * glm::vec3(30, 5, -7);
        const auto corner = [&](float x, float z) { return centre + size * glm::vec3(x, 0, z); };
        SceneBuilder builder;
        builder.quad(corner(-1, 1), corner(1, 1), corner(1, -1), corner(-1, -1), builder.add({}));
        builder.scene.pointEmitters = {{centre + glm::vec3(0, 2 * size, 0), glm::vec3(3), glm::vec3(0)}};
        const Surface surface(builder.scene, builder.scene.geometry.triangles.size());
        const SurfacePoint below{surface.toLocal(glm::dvec3(centre)), {0, 1, 0}, 0, true};
        const float radiance = Illumination(surface).onWhite(below, 1, 4);
        EXPECT_NEAR(radiance * size * size, 3.0f / (glm::pi<float>() * 4.0f), 1e-3f) << size;
    }
}

}  // namespace
}  // namespace duolux::test

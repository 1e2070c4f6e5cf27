#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "host/view/load.h"
#include "tests/unit/scene_files.h"

namespace duolux::test {
namespace {

const std::filesystem::path kAssets = DUOLUX_ASSETS;

glm::vec3 centreOf(const Geometry& geometry, std::size_t triangle) {
    const glm::uvec3& t = geometry.triangles[triangle];
    return (geometry.positions[t.x] + geometry.positions[t.y] + geometry.positions[t.z]) / 3.0f;
}

/// Number of triangles that the segment from `a` to `b` crosses strictly between its ends.
int crossings(const Geometry& geometry, const glm::dvec3& a, const glm::dvec3& b) {
    int count = 0;
    for (const glm::uvec3& t : geometry.triangles) {
        const glm::dvec3 p(geometry.positions[t.x]), q(geometry.positions[t.y]), r(geometry.positions[t.z]);
        const auto volume = [](const glm::dvec3& u, const glm::dvec3& v, const glm::dvec3& w,
                               const glm::dvec3& x) { return glm::dot(glm::cross(v - u, w - u), x - u); };
        const bool sides = (volume(p, q, r, a) > 0) != (volume(p, q, r, b) > 0);
        const bool inside = (volume(a, b, p, q) > 0) == (volume(a, b, q, r) > 0) &&
                            (volume(a, b, q, r) > 0) == (volume(a, b, r, p) > 0);
        count += sides && inside ? 1 : 0;
    }
    return count;
}

TEST(Assets, CornellBoxIsAsPublished) {
    const LoadedScene scene = loadScene(kAssets / "cornell" / "cornell.json");
    EXPECT_TRUE(scene.warnings.empty());
    EXPECT_EQ(scene.camera.position, glm::vec3(278, 273, -800));
    EXPECT_NEAR(scene.camera.vfov, 2 * std::atan(0.0125 / 0.035) * 180 / 3.14159265358979, 1e-4);
    std::map<std::string, double> areas;
    for (std::size_t i = 0; i < scene.geometry.triangles.size(); ++i) {
        areas[scene.materials[scene.geometry.materials[i]].name] +=
            static_cast<double>(glm::length(areaVector(scene.geometry, i)));
    }
    EXPECT_NEAR(areas["light"], 130.0 * 105.0, 0.1);
    EXPECT_NEAR(areas["green"], 559.2 * 548.8, 0.1);
    const double floor = (552.8 + 549.6) / 2 * 559.2;
    const double ceiling = 556.0 * 559.2 - 130.0 * 105.0;
    const double back = (549.6 + 556.0) / 2 * 548.8;
    EXPECT_NEAR(areas["white"], floor + ceiling + back, 1.0);
    EXPECT_EQ(areas.size(), 6u) << "and red, short, tall";
    const Bounds bounds = boundsOf(scene.geometry);
    EXPECT_EQ(bounds.lower, glm::vec3(0));
    EXPECT_EQ(bounds.upper, glm::vec3(556.0f, 548.8f, 559.2f));
}

TEST(Assets, CornellFrontsFaceTheRoom) {
    const LoadedScene scene = loadScene(kAssets / "cornell" / "cornell.json");
    const Geometry& geometry = scene.geometry;
    for (std::size_t i = 0; i < geometry.triangles.size(); ++i) {
        const std::string& name = scene.materials[geometry.materials[i]].name;
        const glm::vec3 centre = centreOf(geometry, i);
        const glm::vec3 normal = glm::normalize(areaVector(geometry, i));
        const glm::vec3 roomCentre(278, 274, 279), shortCentre(185, 82, 169), tallCentre(368, 165, 351);
        if (name == "short") {
            EXPECT_GT(glm::dot(normal, centre - shortCentre), 0.0f);
        } else if (name == "tall") {
            EXPECT_GT(glm::dot(normal, centre - tallCentre), 0.0f);
        } else {
            EXPECT_GT(glm::dot(normal, roomCentre - centre), 0.0f) << name;
        }
        if (name == "light") {
            EXPECT_EQ(normal, glm::vec3(0, -1, 0));
        }
        // The red wall is on the left of the picture, whose right is towards -x.
        if (name == "red") {
            EXPECT_GT(centre.x, 500.0f);
        }
    }
}

TEST(Assets, CornellCeilingHasNoGapNorOverlap) {
    const LoadedScene scene = loadScene(kAssets / "cornell" / "cornell.json");
    for (int i = 0; i < 400; ++i) {
        const double x = 3.7 + 27.3 * (i % 20), z = 2.9 + 27.7 * static_cast<double>(i / 20);
        EXPECT_EQ(crossings(scene.geometry, {x, 540, z}, {x, 560, z}), 1) << x << ' ' << z;
    }
}

TEST(Assets, SpotStandsOnTheFloorUnderTheLuminaire) {
    const LoadedScene scene = loadScene(kAssets / "spot" / "spot.json");
    EXPECT_TRUE(scene.warnings.empty());
    EXPECT_EQ(scene.geometry.triangles.size(), 5856u + 10u + 2u);
    Geometry spot = scene.geometry;
    spot.triangles.clear();
    float volume = 0.0f;
    for (std::size_t i = 0; i < scene.geometry.triangles.size(); ++i) {
        const Material& material = scene.materials[scene.geometry.materials[i]];
        const glm::vec3 area = areaVector(scene.geometry, i);
        if (material.name == "spot") {
            spot.triangles.push_back(scene.geometry.triangles[i]);
            volume += glm::dot(area, centreOf(scene.geometry, i)) / 3.0f;
            EXPECT_NE(scene.geometry.normalIndices[i].x, Geometry::kNoNormal) << "is smooth";
        } else {
            EXPECT_GT(glm::dot(area, glm::vec3(0, 1.8f, 0) - centreOf(scene.geometry, i)), 0.0f)
                << material.name;
        }
    }
    EXPECT_GT(volume, 0.0f) << "faces outwards";
    const Bounds bounds = boundsOf(spot);
    EXPECT_NEAR(bounds.lower.y, 0.0f, 1e-4f);
    EXPECT_LT(bounds.upper.y, 3.5f);
    EXPECT_LT(glm::abs(bounds.lower.x), 2.5f);
}

}  // namespace
}  // namespace duolux::test

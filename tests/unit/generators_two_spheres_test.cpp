#include <algorithm>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "host/generators/icosphere.h"
#include "host/generators/two_spheres.h"
#include "host/view/load.h"
#include "tests/unit/scene_files.h"

namespace duolux::test {
namespace {

/// Whether every edge occurs once in each direction: closed, and consistently wound.
template <typename Triangles>
bool isClosed(const Triangles& triangles) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
    for (const glm::uvec3& t : triangles) {
        for (int i = 0; i < 3; ++i)
            ++edges[{t[i], t[(i + 1) % 3]}];
    }
    return std::all_of(edges.begin(), edges.end(), [&](const auto& edge) {
        const auto back = edges.find({edge.first.second, edge.first.first});
        return edge.second == 1 && back != edges.end() && back->second == 1;
    });
}

TEST(Icosphere, CountsClosednessAndWinding) {
    for (const std::uint32_t frequency : {1u, 2u, 3u, 7u, 24u}) {
        const Icosphere sphere = makeIcosphere(frequency);
        EXPECT_EQ(sphere.triangles.size(), 20u * frequency * frequency);
        EXPECT_EQ(sphere.positions.size(), 10u * frequency * frequency + 2);
        EXPECT_TRUE(isClosed(sphere.triangles));
        for (const glm::dvec3& position : sphere.positions)
            EXPECT_NEAR(glm::length(position), 1.0, 1e-12);
        for (const glm::uvec3& t : sphere.triangles) {
            const glm::dvec3 &a = sphere.positions[t.x], &b = sphere.positions[t.y],
                             &c = sphere.positions[t.z];
            EXPECT_GT(glm::dot(glm::cross(b - a, c - a), a + b + c), 0.0) << "faces outwards";
        }
    }
}

TEST(Icosphere, HasNoSlivers) {
    const Icosphere sphere = makeIcosphere(40);
    for (const glm::uvec3& t : sphere.triangles) {
        const glm::dvec3 &a = sphere.positions[t.x], &b = sphere.positions[t.y], &c = sphere.positions[t.z];
        const double longest = std::max({glm::distance(a, b), glm::distance(b, c), glm::distance(c, a)});
        const double height = glm::length(glm::cross(b - a, c - a)) / longest;
        EXPECT_GT(height / longest, 0.6);  // an equilateral triangle has 0.866
    }
}

class TwoSpheresTest : public SceneFiles {};

TEST_F(TwoSpheresTest, MeetsTheNumberOfTrianglesWithinOnePercent) {
    for (const std::size_t asked : {100u, 137u, 500u, 999u, 2001u, 10'000u, 33'333u, 123'457u}) {
        const std::size_t written = writeTwoSpheres(folder_, asked);
        EXPECT_NEAR(static_cast<double>(written), static_cast<double>(asked),
                    0.01 * static_cast<double>(asked));
        EXPECT_EQ(load("two_spheres.json").geometry.triangles.size(), written) << "none is degenerate";
    }
}

TEST_F(TwoSpheresTest, SpheresAreClosedOutwardAndMostOfTheTriangles) {
    const std::size_t written = writeTwoSpheres(folder_, 20'000);
    const LoadedScene scene = load("two_spheres.json");
    EXPECT_TRUE(scene.warnings.empty());
    std::size_t inSpheres = 0;
    for (const char* name : {"left_sphere", "right_sphere"}) {
        std::vector<glm::uvec3> triangles;
        float volume = 0.0f;
        for (std::size_t i = 0; i < scene.geometry.triangles.size(); ++i) {
            if (scene.materials[scene.geometry.materials[i]].name != name) continue;
            const glm::uvec3& t = scene.geometry.triangles[i];
            triangles.push_back(t);
            volume += glm::dot(areaVector(scene.geometry, i), scene.geometry.positions[t.x]) / 3.0f;
        }
        EXPECT_TRUE(isClosed(triangles)) << name;
        const float radius = name[0] == 'l' ? 20.0f : 16.0f;
        EXPECT_NEAR(volume, 4.18879f * radius * radius * radius, 0.01f * 4.18879f * radius * radius * radius);
        inSpheres += triangles.size();
    }
    EXPECT_GT(inSpheres, written * 9 / 10);
}

TEST_F(TwoSpheresTest, WallsFaceTheRoomAndTheLuminaireFacesDown) {
    writeTwoSpheres(folder_, 1000);
    const LoadedScene scene = load("two_spheres.json");
    const std::set<std::string> spheres{"left_sphere", "right_sphere"};
    const glm::vec3 middle(50.0f);
    for (std::size_t i = 0; i < scene.geometry.triangles.size(); ++i) {
        const Material& material = scene.materials[scene.geometry.materials[i]];
        if (spheres.contains(material.name)) continue;
        const glm::vec3 area = areaVector(scene.geometry, i);
        EXPECT_GT(glm::dot(area, middle - scene.geometry.positions[scene.geometry.triangles[i].x]), 0.0f);
        if (material.name == "luminaire") {
            EXPECT_EQ(glm::normalize(area), glm::vec3(0, -1, 0));
            EXPECT_EQ(material.emission.visible, glm::vec3(0));
            EXPECT_GT(material.emission.invisible.x, 0.0f);
        }
    }
}

TEST_F(TwoSpheresTest, WritesAllOrNothingIntoANewFolder) {
    writeTwoSpheres(folder_ / "a" / "b", 100);
    std::set<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder_ / "a" / "b")) {
        names.insert(entry.path().filename().string());
    }
    EXPECT_EQ(names, (std::set<std::string>{"two_spheres.json", "two_spheres.mtl", "two_spheres.obj"}));
}

}  // namespace
}  // namespace duolux::test

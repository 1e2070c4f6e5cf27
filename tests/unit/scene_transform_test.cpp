#include <array>
#include <cmath>
#include <stdexcept>

#include "host/scene/compose.h"
#include "tests/unit/scene_files.h"

namespace duolux::test {
namespace {

/// A triangle in the plane z = 0 with its front and its normals along +z, and one normal along x.
Geometry makeTriangle() {
    Geometry geometry;
    geometry.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    geometry.triangles = {{0, 1, 2}};
    geometry.materials = {0};
    geometry.normals = {{0, 0, 1}, {std::sqrt(0.5f), 0, std::sqrt(0.5f)}};
    geometry.normalIndices = {{0, 1, 0}};
    return geometry;
}

glm::dmat4 rows(std::array<double, 16> m) {
    glm::dmat4 result;
    for (int i = 0; i < 16; ++i)
        result[i % 4][i / 4] = m[static_cast<std::size_t>(i)];
    return result;
}

glm::vec3 normalAt(const Geometry& geometry, const glm::vec3& position) {
    for (int i = 0; i < 3; ++i) {
        if (geometry.positions[geometry.triangles[0][i]] == position) {
            return geometry.normals[geometry.normalIndices[0][i]];
        }
    }
    throw std::out_of_range("no such corner");
}

/// Tangents are directions on the surface, so that they follow its points; mirroring turns bitangents round.
TEST(SceneTransform, TangentsFollowTheSurface) {
    for (const double side : {1.0, -1.0}) {
        Geometry geometry = makeTriangle();
        geometry.uvs = {{0, 0}, {1, 1}};
        geometry.tangents = {{std::sqrt(0.5f), std::sqrt(0.5f), 0, -1}, {0, 0, 0, 0}};
        ASSERT_TRUE(
            transformGeometry(geometry, rows({3 * side, 0, 0, 1, 0, 4, 0, 2, 0, 0, 5, 3, 0, 0, 0, 1})));
        const glm::vec4 expected(0.6 * side, 0.8, 0.0, -side);
        EXPECT_LT(glm::length(geometry.tangents[0] - expected), 1e-6f);
        EXPECT_EQ(geometry.tangents[1], glm::vec4(0.0f));
    }
}

TEST(SceneTransform, MovesAndScales) {
    Geometry geometry = makeTriangle();
    ASSERT_TRUE(transformGeometry(geometry, rows({2, 0, 0, 10, 0, 3, 0, 20, 0, 0, 4, 30, 0, 0, 0, 1})));
    EXPECT_EQ(geometry.positions[0], glm::vec3(10, 20, 30));
    EXPECT_EQ(geometry.positions[1], glm::vec3(12, 20, 30));
    EXPECT_EQ(geometry.positions[2], glm::vec3(10, 23, 30));
    EXPECT_THAT(areaVector(geometry, 0), IsNear(glm::vec3(0, 0, 3), 1e-6f));
}

TEST(SceneTransform, NormalsGoByTheInverseTranspose) {
    Geometry geometry = makeTriangle();
    transformGeometry(geometry, rows({2, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}));
    // (1, 0, 1) becomes (1/2, 0, 1): stretching along x turns a slope upwards.
    EXPECT_THAT(normalAt(geometry, {2, 0, 0}), IsNear(glm::normalize(glm::vec3(0.5f, 0, 1)), 1e-6f));
    EXPECT_THAT(normalAt(geometry, {0, 0, 0}), IsNear(glm::vec3(0, 0, 1), 1e-6f));
}

TEST(SceneTransform, MirroringKeepsFrontsAndNormalsTogether) {
    const std::array<double, 16> mirrors[] = {{-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1},
                                              {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1, 0, 0, 0, 0, 1},
                                              {0, 1, 0, 0, 1, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}};
    const glm::vec3 fronts[] = {{0, 0, 0.5f}, {0, 0, -0.5f}, {0, 0, 0.5f}};
    for (std::size_t i = 0; i < 3; ++i) {
        Geometry geometry = makeTriangle();
        transformGeometry(geometry, rows(mirrors[i]));
        EXPECT_THAT(areaVector(geometry, 0), IsNear(fronts[i], 1e-6f)) << i;
        EXPECT_GT(glm::dot(normalAt(geometry, {0, 0, 0}), areaVector(geometry, 0)), 0.0f) << i;
        const glm::vec3 moved(glm::dvec3(rows(mirrors[i]) * glm::dvec4(1, 0, 0, 1)));
        const glm::vec3 slope(
            glm::dvec3(rows(mirrors[i]) * glm::dvec4(std::sqrt(0.5), 0, std::sqrt(0.5), 0)));
        EXPECT_THAT(normalAt(geometry, moved), IsNear(slope, 1e-6f)) << "normals stay with their corners";
    }
}

TEST(SceneTransform, MirroredClosedMeshStillFacesOutwards) {
    Geometry tetrahedron;
    tetrahedron.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    tetrahedron.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
    const auto volume = [](const Geometry& geometry) {
        float sum = 0.0f;
        for (std::size_t i = 0; i < geometry.triangles.size(); ++i) {
            sum += glm::dot(areaVector(geometry, i), geometry.positions[geometry.triangles[i].x]) / 3.0f;
        }
        return sum;
    };
    EXPECT_NEAR(volume(tetrahedron), 1.0f / 6.0f, 1e-6f);
    transformGeometry(tetrahedron, rows({-2, 0, 0, 1, 0, 1, 0, 2, 0, 0, 1, 3, 0, 0, 0, 1}));
    EXPECT_NEAR(volume(tetrahedron), 2.0f / 6.0f, 1e-5f);
}

TEST(SceneTransform, RegularIsAboutShapeNotSize) {
    EXPECT_TRUE(isRegular(glm::dmat3(1e-8)));
    EXPECT_TRUE(isRegular(glm::dmat3(1e8)));
    EXPECT_FALSE(isRegular(glm::dmat3(0.0)));
    EXPECT_FALSE(isRegular(glm::dmat3(1, 2, 3, 2, 4, 6, 0, 0, 1)));
}

TEST(SceneTransform, AppendingShiftsIndices) {
    LoadedScene scene;
    Mesh first;
    first.geometry = makeTriangle();
    first.geometry.normals.clear();
    first.geometry.normalIndices.clear();
    first.materials.emplace_back().name = "a";
    Mesh second;
    second.geometry = makeTriangle();
    second.materials.emplace_back().name = "b";
    appendMesh(scene, first);
    appendMesh(scene, second);
    const Geometry& geometry = scene.geometry;
    EXPECT_EQ(geometry.triangles[1], glm::uvec3(3, 4, 5));
    EXPECT_EQ(geometry.normalIndices[0].x, Geometry::kNoNormal) << "the first mesh has none";
    EXPECT_EQ(geometry.normalIndices[1], glm::uvec3(0, 1, 0));
    EXPECT_EQ(scene.materials[geometry.materials[1]].name, "b");
}

}  // namespace
}  // namespace duolux::test

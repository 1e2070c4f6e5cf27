#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <string>

#include "host/bvh/wide_bvh.h"
#include "host/device_scene/vertex_records.h"
#include "shaders/shared/bvh_layout.h"

// The memory of textured triangles, and which vertices corners share. What vertices hold is tested on the
// device (tests/shader/vertex_records_test.cpp).

namespace duolux {
namespace {

/// n x n quads of a wavy sheet whose corners share all indices, as in glTF.
Scene sheet(std::uint32_t n) {
    Scene scene;
    Geometry& geometry = scene.geometry;
    for (std::uint32_t y = 0; y <= n; ++y) {
        for (std::uint32_t x = 0; x <= n; ++x) {
            const glm::vec2 uv = glm::vec2(x, y) / static_cast<float>(n);
            geometry.positions.emplace_back(uv, 0.1f * std::sin(9.0f * uv.x));
            geometry.normals.push_back(glm::normalize(glm::vec3(-0.9f * std::cos(9.0f * uv.x), 0.0f, 1.0f)));
            geometry.uvs.push_back(uv);
        }
    }
    for (std::uint32_t y = 0; y < n; ++y) {
        for (std::uint32_t x = 0; x < n; ++x) {
            const std::uint32_t i = y * (n + 1) + x;
            geometry.triangles.emplace_back(i, i + 1, i + n + 2);
            geometry.triangles.emplace_back(i, i + n + 2, i + n + 1);
        }
    }
    geometry.normalIndices = geometry.uvIndices = geometry.triangles;
    geometry.materials.assign(geometry.triangles.size(), 0);
    scene.materials.resize(1);
    scene.materials[0].textures = {{MaterialInput::kBaseColor, {}, 0}};
    return scene;
}

TEST(VertexRecords, ATexturedTriangleTakes64Bytes) {
    Scene scene = sheet(200);
    const WideBvh tree = buildWideBvh(scene.geometry, allTriangles(scene.geometry));
    for (const bool tangents : {false, true}) {
        if (tangents) scene.materials[0].textures = {{MaterialInput::kNormal, {}, 0}};
        const VertexRecords records = makeVertexRecords(scene.geometry, tree.pairs, vertexNeeds(scene));
        const std::size_t bytes = tree.nodes.size() * sizeof(shared::WideNode) +
                                  tree.pairs.size() * sizeof(shared::DevicePair) +
                                  records.corners.size() * sizeof(shared::DeviceCorners) +
                                  records.vertices.size() * sizeof(shared::DeviceVertex);
        const double each = static_cast<double>(bytes) / static_cast<double>(scene.geometry.triangles.size());
        RecordProperty("bytes", std::to_string(each));
        EXPECT_LE(each, 64.0);
    }
}

TEST(VertexRecords, SharedCornersAreOneVertex) {
    Scene scene = sheet(20);
    const std::vector<TrianglePair> pairs = pairTriangles(scene.geometry, allTriangles(scene.geometry));
    EXPECT_EQ(makeVertexRecords(scene.geometry, pairs, vertexNeeds(scene)).vertices.size(), 21u * 21u);
    // Tangents are computed if a material needs them, and do not separate the vertices of a smooth mapping.
    scene.materials[0].anisotropy = 1.0f;
    const VertexRecords records = makeVertexRecords(scene.geometry, pairs, vertexNeeds(scene));
    EXPECT_EQ(records.vertices.size(), 21u * 21u);
    for (const shared::DeviceVertex& vertex : records.vertices)
        EXPECT_NE(vertex.tangent & shared::kTangentKnown, 0u);
    // Nothing needs texture coordinates.
    scene.materials[0] = {};
    EXPECT_TRUE(makeVertexRecords(scene.geometry, pairs, vertexNeeds(scene)).vertices.empty());
}

/// A cube of shared positions and texture coordinates, but a normal for each face: 24 vertices; without
/// normals, the faces share them, unless they have tangents.
TEST(VertexRecords, VerticesDifferInNormalOrTextureCoordinatesOrTangent) {
    Scene scene;
    Geometry& geometry = scene.geometry;
    for (int i = 0; i < 8; ++i) {
        geometry.positions.emplace_back(i & 1, i >> 1 & 1, i >> 2);
        geometry.uvs.emplace_back(0.3f * static_cast<float>(i & 3), 0.2f * static_cast<float>(i >> 1));
    }
    const glm::uvec4 faces[]{{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                             {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
    for (std::uint32_t face = 0; face < 6; ++face) {
        const glm::uvec4 f = faces[face];
        geometry.triangles.insert(geometry.triangles.end(), {{f.x, f.y, f.z}, {f.x, f.z, f.w}});
        geometry.normals.emplace_back(1, 0, 0);  // distinct by their indices
        geometry.normalIndices.insert(geometry.normalIndices.end(), 2, glm::uvec3(face));
    }
    geometry.uvIndices = geometry.triangles;
    geometry.materials.assign(geometry.triangles.size(), 0);
    scene.materials.resize(1);
    const auto vertices = [&](MaterialInput input) {
        scene.materials[0].textures = {{input, {}, 0}};
        const std::vector<TrianglePair> pairs = pairTriangles(geometry, allTriangles(geometry));
        return makeVertexRecords(geometry, pairs, vertexNeeds(scene)).vertices.size();
    };
    EXPECT_EQ(vertices(MaterialInput::kBaseColor), 24u);
    geometry.normals.clear();
    geometry.normalIndices.clear();
    EXPECT_EQ(vertices(MaterialInput::kBaseColor), 8u);
    EXPECT_EQ(vertices(MaterialInput::kNormal), 36u);
}

TEST(VertexRecords, OnlyWhatMaterialsUseIsNeeded) {
    Scene scene = sheet(2);
    EXPECT_TRUE(vertexNeeds(scene).records);
    EXPECT_FALSE(vertexNeeds(scene).tangents[0]);
    scene.materials[0].textures[0].texture.uvSet = 1;
    EXPECT_FALSE(vertexNeeds(scene).secondUvs);  // the scene has none
    scene.geometry.secondUvs = scene.geometry.uvs;
    EXPECT_TRUE(vertexNeeds(scene).secondUvs);
    scene.materials[0] = {};
    EXPECT_FALSE(vertexNeeds(scene).records);
    scene.materials[0].anisotropy = 0.5f;
    EXPECT_TRUE(vertexNeeds(scene).records && vertexNeeds(scene).tangents[0]);
    for (glm::uvec3& indices : scene.geometry.uvIndices)
        indices = glm::uvec3(Geometry::kNoUv);
    EXPECT_FALSE(vertexNeeds(scene).records);
}

}  // namespace
}  // namespace duolux

#include "host/device_scene/vertex_records.h"

#include <gtest/gtest.h>

#include "tests/shader/inputs.h"
#include "tests/shader/oracles.h"
#include "tests/support/scene_builder.h"

// Vertices that the host encodes, decoded on the device at the corners of triangles and between them.

namespace duolux::test {
namespace {

/// Separate triangles with random normals, texture coordinates and tangents; every fourth is flat, every
/// fifth has no texture coordinates. The materials differ in what they need.
Scene randomScene() {
    SceneBuilder builder;
    duolux::Material normalMapped, coloured;
    normalMapped.textures = {{MaterialInput::kNormal, {}}};
    coloured.textures = {{MaterialInput::kBaseColor, {}}};
    coloured.textures[0].texture.uvSet = 1;
    builder.add(normalMapped);
    builder.add(coloured);
    const std::vector<glm::vec3> directions = randomDirections(6 * 300, 3);
    const std::vector<glm::vec2> uvs = randomSquare(6 * 300, 4);
    Geometry& geometry = builder.scene.geometry;
    for (std::uint32_t i = 0; i < 300; ++i) {
        builder.triangle(directions[6 * i], directions[6 * i + 1], directions[6 * i + 2], i % 2);
        geometry.normalIndices.emplace_back(i % 4 == 0 ? glm::uvec3(Geometry::kNoNormal)
                                                       : glm::uvec3(3 * i, 3 * i + 1, 3 * i + 2));
        geometry.uvIndices.emplace_back(i % 5 == 0 ? glm::uvec3(Geometry::kNoUv)
                                                   : glm::uvec3(3 * i + 2, 3 * i, 3 * i + 1));
        for (std::uint32_t k = 0; k < 3; ++k) {
            // Within 90 degrees of each other, as on surfaces.
            const glm::vec3 normal = glm::normalize(directions[6 * i] + 0.5f * directions[6 * i + 3 + k]);
            geometry.normals.push_back(normal);
            geometry.uvs.push_back(20.0f * uvs[6 * i + k] - 10.0f);
            geometry.secondUvs.push_back(uvs[6 * i + 3 + k]);
        }
    }
    for (std::uint32_t i = 0; i < 300; ++i) {
        for (std::uint32_t k = 0; k < 3; ++k) {
            // uvIndices puts uv 3 i + k at the corner (k + 1) % 3, whose normal is 3 i + (k + 1) % 3.
            const glm::vec3 n = geometry.normals[3 * i + (k + 1) % 3];
            const glm::vec3 t = glm::normalize(glm::cross(n, directions[6 * ((i + k) % 300) + 5]));
            geometry.tangents.emplace_back(t, i % 3 == 0 ? -1.0f : 1.0f);
        }
    }
    return builder.scene;
}

ShaderLibrary libraryOf(const VertexRecords& records) {
    ShaderLibrary library("shaders/lib/vertex_records.glsl");
    library.texels("fetchCornerTexel", std::span(records.corners))
        .texels("fetchVertexTexel", std::span(records.vertices))
        .texels("fetchSecondUvTexel", std::span(records.secondUvs))
        .constant(shared::kSpecVertexRecords, 1)
        .constant(shared::kSpecSecondUvs, 1);
    return library;
}

/// A corner of a triangle in device memory, and in the scene.
struct Corners {
    std::vector<std::uint32_t> triangles;
    std::vector<glm::vec2> barycentrics;
    std::vector<std::pair<std::uint32_t, int>> ofScene;  ///< triangle and corner

    explicit Corners(const Geometry& geometry, const std::vector<TrianglePair>& pairs) {
        for (std::uint32_t i = 0; i < pairs.size(); ++i) {
            const PairCorners corners = cornersOf(geometry, pairs[i]).value();
            for (std::uint32_t half = 0; half < (pairs[i].isSingle() ? 1u : 2u); ++half) {
                for (std::uint32_t k = 0; k < 3; ++k) {
                    triangles.push_back(2 * i + half);
                    barycentrics.emplace_back(k == 1 ? 1.0f : 0.0f, k == 2 ? 1.0f : 0.0f);
                    ofScene.emplace_back(half == 0 ? pairs[i].first : pairs[i].second,
                                         static_cast<int>((corners.turns[half] + k) % 3));
                }
            }
        }
    }
};

TEST(VertexRecords, CornersHaveWhatTheSceneGivesThem) {
    const Scene scene = randomScene();
    const Geometry& geometry = scene.geometry;
    const VertexNeeds needs = vertexNeeds(scene);
    ASSERT_TRUE(needs.records && needs.secondUvs);
    EXPECT_EQ(needs.tangents, (std::vector<bool>{true, false}));
    const std::vector<TrianglePair> pairs = pairTriangles(geometry, allTriangles(geometry));
    const VertexRecords records = makeVertexRecords(geometry, pairs, needs);
    const Corners corners(geometry, pairs);
    const ShaderLibrary library = libraryOf(records);
    const auto normals = library.evaluate<glm::vec3>("result = vertexNormal(fetchVertices(x0), x1);",
                                                     corners.triangles, corners.barycentrics);
    const auto uvs = library.evaluate<glm::vec2>("result = vertexUv(fetchVertices(x0), x1);",
                                                 corners.triangles, corners.barycentrics);
    const auto second = library.call<glm::vec2>("secondVertexUv", corners.triangles, corners.barycentrics);
    const char* const kFrame =
        "VertexRecords v = fetchVertices(x0); TangentFrame f = tangentFrame(v, x1, vertexNormal(v, x1)); ";
    const auto tangents = library.evaluate<glm::vec3>(std::string(kFrame) + "result = f.tangent;",
                                                      corners.triangles, corners.barycentrics);
    const auto bitangents = library.evaluate<glm::vec3>(std::string(kFrame) + "result = f.bitangent;",
                                                        corners.triangles, corners.barycentrics);
    for (std::size_t i = 0; i < corners.ofScene.size(); ++i) {
        const auto [triangle, corner] = corners.ofScene[i];
        const bool hasUvs = geometry.uvIndices[triangle].x != Geometry::kNoUv;
        const std::uint32_t uv = hasUvs ? geometry.uvIndices[triangle][corner] : 0;
        EXPECT_EQ(uvs[i], hasUvs ? geometry.uvs[uv] : glm::vec2(0.0f)) << i;
        EXPECT_EQ(second[i], hasUvs ? geometry.secondUvs[uv] : glm::vec2(0.0f)) << i;
        if (geometry.normalIndices[triangle].x == Geometry::kNoNormal) continue;
        const glm::vec3 normal = geometry.normals[geometry.normalIndices[triangle][corner]];
        // The error of two times 16 bits, see normals_test.cpp.
        EXPECT_LT(glm::length(normals[i] - normal), 6.6e-5f) << i;
        if (!hasUvs || geometry.materials[triangle] != 0) continue;
        // Half a step of 2^-15 of a turn, and the error of the normal.
        EXPECT_LT(glm::length(tangents[i] - glm::vec3(geometry.tangents[uv])), 9.6e-5f + 1.4e-4f) << i;
        const glm::vec3 bitangent =
            glm::cross(normal, glm::vec3(geometry.tangents[uv])) * geometry.tangents[uv].w;
        EXPECT_LT(glm::length(bitangents[i] - bitangent), 4e-4f) << i;
    }
}

/// Between corners, u and v are linear, and the frame is orthonormal.
TEST(VertexRecords, ValuesAreInterpolated) {
    const Scene scene = randomScene();
    const std::vector<TrianglePair> pairs = pairTriangles(scene.geometry, allTriangles(scene.geometry));
    const ShaderLibrary library = libraryOf(makeVertexRecords(scene.geometry, pairs, vertexNeeds(scene)));
    std::vector<std::uint32_t> triangles;
    std::vector<glm::vec2> points;
    for (const glm::vec2 u : randomSquare(4096, 8)) {
        triangles.push_back(static_cast<std::uint32_t>(2 * (triangles.size() % pairs.size())));
        points.push_back(u.x + u.y > 1.0f ? 1.0f - u : u);
    }
    const auto off = library.evaluate<glm::vec4>(
        "VertexRecords v = fetchVertices(x0); vec2 b = x1;"
        "vec2 uv = vertexUv(v, b) - vertexUv(v, vec2(0.0)) * (1.0 - b.x - b.y) - vertexUv(v, vec2(1.0, 0.0)) "
        "* b.x -"
        "          vertexUv(v, vec2(0.0, 1.0)) * b.y;"
        "vec2 second = secondVertexUv(x0, b) - secondVertexUv(x0, vec2(0.0)) * (1.0 - b.x - b.y) -"
        "              secondVertexUv(x0, vec2(1.0, 0.0)) * b.x - secondVertexUv(x0, vec2(0.0, 1.0)) * b.y;"
        "TangentFrame f = tangentFrame(v, b, normalize(vec3(b, 0.7)));"
        "vec3 axes = vec3(dot(f.tangent, f.normal), dot(f.bitangent, f.normal), dot(f.tangent, f.bitangent));"
        "vec3 lengths = vec3(length(f.tangent), length(f.bitangent), length(f.normal)) - 1.0;"
        "result = vec4(length(uv), length(second), length(axes), length(lengths));",
        triangles, points);
    for (const glm::vec4& o : off) {
        EXPECT_LT(o.x, 1e-5f);
        EXPECT_LT(o.y, 1e-6f);
        EXPECT_LT(o.z, 1e-5f);  // where the tangents almost cancel
        EXPECT_LT(o.w, 1e-6f);
    }
}

}  // namespace
}  // namespace duolux::test

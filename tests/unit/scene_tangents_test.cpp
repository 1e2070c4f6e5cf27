#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "host/scene/tangents.h"

// Tangents of texture coordinates that are known functions of the position.

namespace duolux {
namespace {

constexpr double kPi = std::numbers::pi;

std::vector<bool> allOf(const Geometry& geometry) {
    return std::vector<bool>(geometry.triangles.size(), true);
}

/// n x n quads over the unit square, whose corners share indices; `uv` of a point.
Geometry plane(int n, const std::function<glm::dvec2(glm::dvec2)>& uv) {
    Geometry geometry;
    for (int y = 0; y <= n; ++y) {
        for (int x = 0; x <= n; ++x) {
            const glm::dvec2 p = glm::dvec2(x, y) / static_cast<double>(n);
            geometry.positions.emplace_back(p, 0.0);
            geometry.uvs.emplace_back(uv(p));
        }
    }
    for (int y = 0; y < n; ++y) {
        for (int x = 0; x < n; ++x) {
            const auto i = static_cast<std::uint32_t>(y * (n + 1) + x),
                       row = static_cast<std::uint32_t>(n + 1);
            geometry.triangles.emplace_back(i, i + 1, i + row + 1);
            geometry.triangles.emplace_back(i, i + row + 1, i + row);
        }
    }
    geometry.normals = {{0, 0, 1}};
    geometry.normalIndices.assign(geometry.triangles.size(), glm::uvec3(0));
    geometry.uvIndices = geometry.triangles;
    geometry.materials.assign(geometry.triangles.size(), 0);
    return geometry;
}

glm::vec4 tangentAt(const CornerTangents& tangents, std::size_t triangle, int corner) {
    return tangents.tangents[tangents.indices[triangle][corner]];
}

/// u grows along a direction in the plane, v points down: the bitangent is up, w is 1.
TEST(Tangents, FollowRotatedTextures) {
    for (double degrees = 0.0; degrees < 360.0; degrees += 30.0) {
        const double angle = degrees * kPi / 180.0;
        const glm::dvec2 u(std::cos(angle), std::sin(angle)), up(-std::sin(angle), std::cos(angle));
        for (const double side : {1.0, -1.0}) {
            const Geometry geometry = plane(
                3, [&](glm::dvec2 p) { return glm::dvec2(3.0 * glm::dot(p, u), -side * glm::dot(p, up)); });
            const CornerTangents tangents = computeTangents(geometry, allOf(geometry));
            for (std::size_t i = 0; i < geometry.triangles.size(); ++i) {
                for (int k = 0; k < 3; ++k) {
                    const glm::vec4 t = tangentAt(tangents, i, k);
                    EXPECT_LT(glm::length(glm::dvec3(t) - glm::dvec3(u, 0.0)), 1e-6) << degrees;
                    EXPECT_EQ(t.w, static_cast<float>(side)) << degrees;
                }
            }
            EXPECT_EQ(tangents.tangents.size(), 16u);  // one for each vertex
        }
    }
}

/// Sheared coordinates: the tangent is along growing u at constant v, not along the gradient of u. x = u -
/// 0.5 v.
TEST(Tangents, AreAlongLinesOfConstantV) {
    const Geometry geometry = plane(2, [](glm::dvec2 p) { return glm::dvec2(p.x - 0.5 * p.y, -p.y); });
    const CornerTangents tangents = computeTangents(geometry, allOf(geometry));
    EXPECT_LT(glm::length(tangentAt(tangents, 0, 0) - glm::vec4(1, 0, 0, 1)), 1e-6f);
}

/// Longitude and latitude on a sphere: the tangent is along circles of latitude, exactly by symmetry.
TEST(Tangents, OfASphereAreAlongItsParallels) {
    constexpr int kColumns = 24, kRows = 12;
    Geometry geometry;
    for (int y = 1; y < kRows; ++y) {
        for (int x = 0; x <= kColumns; ++x) {
            const double phi = 2.0 * kPi * x / kColumns, theta = kPi * y / kRows;
            const glm::dvec3 p(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi),
                               std::cos(theta));
            geometry.positions.emplace_back(p);
            geometry.normals.emplace_back(p);
            geometry.uvs.emplace_back(
                glm::dvec2(static_cast<double>(x) / kColumns, static_cast<double>(y) / kRows));
        }
    }
    for (std::uint32_t y = 0; y + 2 < kRows; ++y) {
        for (std::uint32_t x = 0; x < kColumns; ++x) {
            const std::uint32_t i = y * (kColumns + 1) + x, below = i + kColumns + 1;
            geometry.triangles.emplace_back(i, below, below + 1);
            geometry.triangles.emplace_back(i, below + 1, i + 1);
        }
    }
    geometry.normalIndices = geometry.uvIndices = geometry.triangles;
    geometry.materials.assign(geometry.triangles.size(), 0);
    const CornerTangents tangents = computeTangents(geometry, allOf(geometry));
    for (std::size_t i = 0; i < geometry.triangles.size(); ++i) {
        for (int k = 0; k < 3; ++k) {
            const std::uint32_t vertex = geometry.triangles[i][k];
            const std::uint32_t column = vertex % (kColumns + 1), row = vertex / (kColumns + 1);
            const glm::vec4 t = tangentAt(tangents, i, k);
            EXPECT_NEAR(glm::dot(glm::vec3(t), geometry.normals[vertex]), 0.0f, 1e-6f);
            EXPECT_EQ(t.w, 1.0f);
            // Inside, where both neighbours along the parallel contribute alike; the seam has only one.
            const bool inside = column > 0 && column < kColumns && row > 0 && row + 2 < kRows;
            const double phi = 2.0 * kPi * column / kColumns;
            const glm::dvec3 east(-std::sin(phi), std::cos(phi), 0.0);
            EXPECT_GT(glm::dot(glm::dvec3(t), east), inside ? 0.9995 : 0.98) << column << " " << row;
        }
    }
}

/// Two triangles share an edge, and the texture of the second is mirrored: they share no tangents there.
TEST(Tangents, MirroredTexturesAreSeparate) {
    Geometry geometry;
    geometry.positions = {{-1, 0, 0}, {0, 0, 0}, {0, 1, 0}, {1, 0, 0}};
    geometry.uvs = {{1, 0}, {0, 0}, {0, -1}, {1, 0}};
    geometry.triangles = {{0, 1, 2}, {1, 3, 2}};
    geometry.uvIndices = geometry.triangles;
    geometry.materials = {0, 0};
    const CornerTangents tangents = computeTangents(geometry, allOf(geometry));
    EXPECT_EQ(tangentAt(tangents, 0, 1), glm::vec4(-1, 0, 0, -1));
    EXPECT_EQ(tangentAt(tangents, 1, 0), glm::vec4(1, 0, 0, 1));
    EXPECT_EQ(tangents.tangents.size(), 6u);
}

/// Corners with equal position, normal and texture coordinates count as one whatever their indices, weighted
/// by their angles: 90 degrees along x, 45 along a direction 60 degrees from it.
TEST(Tangents, AreWeightedByAngles) {
    Geometry geometry;
    const glm::vec2 along(std::cos(kPi / 3.0), std::sin(kPi / 3.0));
    geometry.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 0}, {-1, 0, 0}, {-1, -1, 0}};
    geometry.triangles = {{0, 1, 2}, {3, 4, 5}};
    for (const glm::vec3& p : geometry.positions) {
        const bool second = geometry.uvs.size() >= 3;
        const glm::vec2 u = second ? along : glm::vec2(1, 0),
                        up = second ? glm::vec2(-along.y, along.x) : glm::vec2(0, 1);
        geometry.uvs.emplace_back(glm::dot(glm::vec2(p), u), -glm::dot(glm::vec2(p), up));
    }
    geometry.uvIndices = geometry.triangles;
    geometry.materials = {0, 0};
    const CornerTangents tangents = computeTangents(geometry, allOf(geometry));
    const glm::vec2 expected = glm::normalize(2.0f * glm::vec2(1, 0) + along);
    for (std::size_t i = 0; i < 2; ++i)
        EXPECT_LT(glm::length(tangentAt(tangents, i, 0) - glm::vec4(expected, 0, 1)), 1e-6f);
    EXPECT_LT(glm::length(tangentAt(tangents, 0, 1) - glm::vec4(1, 0, 0, 1)), 1e-6f);
}

/// The gradient is projected onto the plane of the normal.
TEST(Tangents, ArePerpendicularToNormals) {
    Geometry geometry = plane(1, [](glm::dvec2 p) { return glm::dvec2(p.x, -p.y); });
    geometry.normals = {glm::normalize(glm::vec3(1, 0, 1))};
    const CornerTangents tangents = computeTangents(geometry, allOf(geometry));
    EXPECT_LT(glm::length(tangentAt(tangents, 0, 0) - glm::vec4(glm::normalize(glm::vec3(1, 0, -1)), 1)),
              1e-6f);
}

TEST(Tangents, AreUnknownWithoutTextureCoordinates) {
    Geometry geometry = plane(1, [](glm::dvec2) { return glm::dvec2(0.5); });
    EXPECT_EQ(computeTangents(geometry, allOf(geometry)).indices[0], glm::uvec3(CornerTangents::kNone));
    geometry = plane(1, [](glm::dvec2 p) { return p; });
    geometry.uvIndices[1] = glm::uvec3(Geometry::kNoUv);
    const CornerTangents tangents = computeTangents(geometry, {true, true});
    EXPECT_NE(tangents.indices[0].x, CornerTangents::kNone);
    EXPECT_EQ(tangents.indices[1], glm::uvec3(CornerTangents::kNone));
    EXPECT_EQ(computeTangents(geometry, {false, false}).indices[0], glm::uvec3(CornerTangents::kNone));
    geometry = {};
    geometry.triangles = {{0, 1, 2}};
    EXPECT_EQ(computeTangents(geometry, {true}).indices[0], glm::uvec3(CornerTangents::kNone));
}

}  // namespace
}  // namespace duolux

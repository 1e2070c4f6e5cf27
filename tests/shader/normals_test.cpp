#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "shaders/shared/path_tracer_layout.h"
#include "tests/shader/inputs.h"
#include "tests/shader/no_scene.h"
#include "tests/shader/oracles.h"

// Shading normals: the error of their 16-bit coding, interpolation in double precision, and both oracles.

namespace duolux::test {
namespace {

const ShaderLibrary& normals() {
    static const ShaderLibrary library =
        ShaderLibrary("shaders/lib/normals.glsl")
            .define("uvec4 fetchNormalTexel(uint index) { return uvec4(0u); }")
            .define(kNoVertexRecords);
    return library;
}

std::uint32_t code(int x, int y) {
    return (static_cast<std::uint32_t>(x) & 0xffffu) | static_cast<std::uint32_t>(y) << 16;
}

/// Projects a direction to the octahedron |x| + |y| + |z| = 1, folds its lower half outwards, and rounds to
/// the nearest of 65535 x 65535 codes (Cigolle et al., "A Survey of Efficient Representations for Independent
/// Unit Vectors", 2014).
std::uint32_t encode(const glm::dvec3& direction) {
    const glm::dvec3 n = direction / (std::abs(direction.x) + std::abs(direction.y) + std::abs(direction.z));
    glm::dvec2 e(n.x, n.y);
    if (n.z < 0.0) e = {std::copysign(1.0 - std::abs(n.y), n.x), std::copysign(1.0 - std::abs(n.x), n.y)};
    return code(static_cast<int>(std::lround(e.x * 32767.0)), static_cast<int>(std::lround(e.y * 32767.0)));
}

/// Its inverse: unfolds and normalises.
glm::dvec3 decode(std::uint32_t bits) {
    const glm::dvec2 e = glm::max(
        glm::dvec2(static_cast<std::int16_t>(bits & 0xffffu), static_cast<std::int16_t>(bits >> 16)) /
            32767.0,
        -1.0);
    const double z = 1.0 - std::abs(e.x) - std::abs(e.y);
    if (z >= 0.0) return glm::normalize(glm::dvec3(e, z));
    return glm::normalize(
        glm::dvec3(std::copysign(1.0 - std::abs(e.y), e.x), std::copysign(1.0 - std::abs(e.x), e.y), z));
}

/// Directions on the whole sphere, on the axes and on the planes between octants, and near these.
std::vector<glm::dvec3> directions() {
    std::vector<glm::dvec3> all;
    for (const glm::vec3& d : randomDirections(1 << 16))
        all.emplace_back(d);
    const std::vector<float> tiny = randomScales(4096, -30.0, -2.0);
    for (std::size_t i = 0; i < tiny.size(); ++i) {
        const double epsilon = i % 7 == 0 ? 0.0 : static_cast<double>(tiny[i]);
        const double side = i % 2 == 0 ? 1.0 : -1.0;
        const double other = i % 3 == 0 ? epsilon : static_cast<double>(tiny[i / 2]);
        const auto axis = static_cast<glm::length_t>(i % 3);
        glm::dvec3 d;
        d[axis] = epsilon;
        d[(axis + 1) % 3] = side;
        d[(axis + 2) % 3] = i % 4 < 2 ? other : 2.0 * other * static_cast<double>(1 << 29);
        all.push_back(glm::normalize(d));
    }
    return all;
}

/// Half a unit in both coordinates is at most 2^-0.5 / 32767 in the square's plane. A step (dx, dy) there is
/// (dx, dy, -dx - dy) on the octahedron, at most sqrt(3) times as long, and its angle seen from the centre is
/// at most sqrt(3) times as large: 6.48e-5 rad (0.0037 degrees, as in table 2 of Cigolle et al.), plus the
/// rounding of floats.
TEST(Normals, CodingIsOffByNoMoreThanItsUnit) {
    const std::vector<glm::dvec3> all = directions();
    std::vector<std::uint32_t> codes;
    for (const glm::dvec3& d : all)
        codes.push_back(encode(d));
    const std::vector<glm::vec3> decoded = normals().call<glm::vec3>("octahedralDecode", codes);
    double worst = 0.0;
    for (std::size_t i = 0; i < all.size(); ++i) {
        const glm::dvec3 n(decoded[i]);
        worst = std::max(worst, std::asin(glm::length(glm::cross(all[i], n))));
        ASSERT_GT(glm::dot(all[i], n), 0.0) << i;
        ASSERT_NEAR(glm::length(n), 1.0, 4e-7) << i;
    }
    EXPECT_LT(worst, 6.5e-5);
    EXPECT_GT(worst, 4e-5);  // the inputs come near the worst case
}

/// All eight octants: each component has the sign of the direction that was encoded.
TEST(Normals, SignsAreKept) {
    std::vector<glm::dvec3> all;
    std::vector<std::uint32_t> codes;
    for (const glm::dvec3& d : directions()) {
        if (std::min({std::abs(d.x), std::abs(d.y), std::abs(d.z)}) < 1e-4) continue;
        all.push_back(d);
        codes.push_back(encode(d));
    }
    const std::vector<glm::vec3> decoded = normals().call<glm::vec3>("octahedralDecode", codes);
    for (std::size_t i = 0; i < all.size(); ++i)
        ASSERT_EQ(glm::sign(glm::dvec3(decoded[i])), glm::sign(all[i])) << i;
}

/// Every code except those on the border, where a direction has two codes, is the nearest one to the
/// direction that it decodes to. In double precision the directions are the same up to the rounding of
/// floats.
TEST(Normals, DecodingInvertsEncoding) {
    std::vector<std::uint32_t> codes = randomWords(1 << 18);
    for (int x = -32766; x <= 32766; x += 7) {
        for (const int y : {-32766, -1, 0, 1, 32766, 32767 - std::abs(x), std::abs(x) - 32766})
            codes.push_back(code(x, std::clamp(y, -32766, 32766)));
    }
    std::erase_if(codes, [](std::uint32_t c) {
        return std::abs(static_cast<std::int16_t>(c & 0xffffu)) >= 32767 ||
               std::abs(static_cast<std::int16_t>(c >> 16)) >= 32767;
    });
    const std::vector<glm::vec3> decoded = normals().call<glm::vec3>("octahedralDecode", codes);
    for (std::size_t i = 0; i < codes.size(); ++i) {
        ASSERT_EQ(encode(glm::dvec3(decoded[i])), codes[i]);
        ASSERT_LT(glm::length(glm::dvec3(decoded[i]) - decode(codes[i])), 4e-7) << codes[i];
    }
}

struct Points {
    std::vector<std::uint32_t> triangles;
    std::vector<glm::vec2> barycentrics;
};

constexpr std::uint32_t kTriangles = 64;

/// Normals of triangles whose corners are up to 60 degrees apart, with an unrelated fourth word.
std::vector<shared::DeviceNormals> triangleNormals() {
    std::vector<shared::DeviceNormals> all;
    const std::vector<glm::vec3> directions = randomDirections(4 * kTriangles, 2);
    for (std::size_t i = 0; i < kTriangles; ++i) {
        shared::DeviceNormals n{{}, 0xdeadbeefu};
        for (std::size_t c = 0; c < 3; ++c)
            n.octahedral[c] =
                encode(2.0 * glm::dvec3(directions[4 * i + 3]) + glm::dvec3(directions[4 * i + c]));
        all.push_back(n);
    }
    return all;
}

/// Corners, points on edges and interior points of every triangle.
Points pointsOfAll() {
    Points points;
    for (std::uint32_t triangle = 0; triangle < kTriangles; ++triangle) {
        for (int i = 0; i <= 8; ++i) {
            for (int j = 0; i + j <= 8; ++j) {
                points.triangles.push_back(triangle);
                points.barycentrics.push_back(glm::vec2(i, j) / 8.0f);
            }
        }
        for (const glm::vec2 u : randomSquare(32, triangle)) {
            points.triangles.push_back(triangle);
            points.barycentrics.push_back(u.x + u.y > 1.0f ? 1.0f - u : u);
        }
    }
    return points;
}

TEST(Normals, AreInterpolatedAndNormalised) {
    const std::vector<shared::DeviceNormals> corners = triangleNormals();
    ShaderLibrary library("shaders/lib/normals.glsl");
    library.define(kNoVertexRecords);
    library.texels("fetchNormalTexel", std::span(corners));
    const Points points = pointsOfAll();
    const std::vector<glm::vec3> ns =
        library.call<glm::vec3>("shadingNormal", points.triangles, points.barycentrics);
    for (std::size_t i = 0; i < ns.size(); ++i) {
        const shared::DeviceNormals& n = corners[points.triangles[i]];
        const glm::dvec2 b(points.barycentrics[i]);
        const glm::dvec3 expected =
            glm::normalize(decode(n.octahedral[0]) * (1.0 - b.x - b.y) + decode(n.octahedral[1]) * b.x +
                           decode(n.octahedral[2]) * b.y);
        ASSERT_LT(glm::length(glm::dvec3(ns[i]) - expected), 4e-7) << i;
    }
}

TEST(NormalsOracles, AllFunctions) {
    EXPECT_ORACLES(normals(), octahedralDecode, (Budget{0, 4e-7}), randomWords(1 << 14));
    const std::vector<shared::DeviceNormals> corners = triangleNormals();
    ShaderLibrary library("shaders/lib/normals.glsl");
    library.define(kNoVertexRecords);
    library.texels("fetchNormalTexel", std::span(corners));
    for (const shared::DeviceNormals& n : corners)
        mirror::texels().normals.emplace_back(n.octahedral[0], n.octahedral[1], n.octahedral[2], n.unused);
    const Points points = pointsOfAll();
    EXPECT_ORACLES(library, shadingNormal, (Budget{0, 4e-7}), points.triangles, points.barycentrics);
    mirror::texels() = {};
}

}  // namespace
}  // namespace duolux::test

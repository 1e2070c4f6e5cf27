#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/shader/density.h"
#include "tests/shader/inputs.h"
#include "tests/shader/oracles.h"

// Mappings from the unit square, and frames: densities, closed forms in double precision, and both oracles.

namespace duolux::test {
namespace {

const ShaderLibrary& warp() {
    static const ShaderLibrary library("shaders/lib/warp.glsl");
    return library;
}

/// A grid, and the corners, edges and diagonal of the square of numbers in [0, 1).
std::vector<glm::vec2> squareWithEdges() {
    std::vector<glm::vec2> us = unitSquare(64);
    constexpr float kLast = 1.0f - 0x1p-24f;
    for (const float x : {0.0f, 0x1p-24f, 0.25f, 0.5f, 0.75f, kLast}) {
        for (const float y : {0.0f, 0x1p-24f, 0.25f, 0.5f, 0.75f, kLast})
            us.emplace_back(x, y);
    }
    return us;
}

/// Over (z, phi), where area is solid angle: density cos / pi. Level 1e-4.
TEST(Warp, CosineHemisphereHasItsDensity) {
    std::vector<glm::dvec2> points;
    for (const glm::vec3 w : warp().call<glm::vec3>("cosineHemisphere", randomSquare(1 << 17)))
        points.emplace_back(w.z, std::atan2(w.y, w.x));
    expectDensity(
        "cosine-hemisphere", points, {{0.0, -std::numbers::pi}, {1.0, std::numbers::pi}},
        [](double z, double) { return z / std::numbers::pi; }, 1e-4);
}

/// Over s = x + y and t = x / s, whose area element is that of (x, y) divided by s: density 2 per unit of
/// barycentric area. Level 1e-4.
TEST(Warp, UniformTriangleIsUniform) {
    std::vector<glm::dvec2> points;
    for (const glm::dvec2 b : warp().call<glm::vec2>("uniformTriangle", randomSquare(1 << 17))) {
        const double s = b.x + b.y;
        points.emplace_back(s, s > 0.0 ? b.x / s : 0.5);
    }
    expectDensity(
        "uniform-triangle", points, {{0.0, 0.0}, {1.0, 1.0}}, [](double s, double) { return 2.0 * s; }, 1e-4);
}

/// The map covers the triangle without gaps: each cell of a coarse grid receives a point of a fine grid.
TEST(Warp, UniformTriangleCoversTheTriangle) {
    constexpr int kCells = 64;
    std::vector<bool> seen(kCells * kCells);
    for (const glm::vec2 b : warp().call<glm::vec2>("uniformTriangle", unitSquare(256)))
        seen.at(static_cast<std::size_t>(static_cast<int>(b.y * kCells) * kCells +
                                         static_cast<int>(b.x * kCells))) = true;
    for (int y = 0; y < kCells; ++y) {
        for (int x = 0; x + y < kCells - 1; ++x)
            EXPECT_TRUE(seen[static_cast<std::size_t>(y * kCells + x)]) << x << ' ' << y;
    }
}

/// Malley's method in double precision, and its inverse: u.x = 1 - z^2, u.y = the angle. Vulkan allows errors
/// of 2^-11 for the device's sine and cosine, which would hide a wrong formula; this test requires 2e-6.
TEST(Warp, CosineHemisphereMatchesItsFormula) {
    const std::vector<glm::vec2> us = squareWithEdges();
    const std::vector<glm::vec3> ws = warp().call<glm::vec3>("cosineHemisphere", us);
    for (std::size_t i = 0; i < us.size(); ++i) {
        const glm::dvec2 u(us[i]);
        const double theta = std::asin(std::sqrt(u.x));
        const double phi = 2.0 * std::numbers::pi * u.y;
        const glm::dvec3 expected(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi),
                                  std::cos(theta));
        ASSERT_LT(glm::length(glm::dvec3(ws[i]) - expected), 2e-6) << u.x << ' ' << u.y;
        ASSERT_NEAR(1.0 - static_cast<double>(ws[i].z) * static_cast<double>(ws[i].z), u.x, 3e-7) << u.x;
    }
}

/// Heitz's pseudocode ("A Low-Distortion Map Between Triangle and Square", 2019) in double precision. It only
/// halves and subtracts once, so floats are correct to one rounding.
TEST(Warp, UniformTriangleMatchesItsFormula) {
    const std::vector<glm::vec2> us = squareWithEdges();
    const std::vector<glm::vec2> bs = warp().call<glm::vec2>("uniformTriangle", us);
    for (std::size_t i = 0; i < us.size(); ++i) {
        double x = static_cast<double>(us[i].x);
        double y = static_cast<double>(us[i].y);
        if (y > x) {
            x *= 0.5;
            y -= x;
        } else {
            y *= 0.5;
            x -= y;
        }
        ASSERT_NEAR(static_cast<double>(bs[i].x), x, 6e-8) << us[i].x << ' ' << us[i].y;
        ASSERT_NEAR(static_cast<double>(bs[i].y), y, 6e-8) << us[i].x << ' ' << us[i].y;
    }
}

/// What orthonormalBasis returns.
template <typename Vector>
struct Basis {
    Vector tangent, bitangent;
};

}  // namespace
}  // namespace duolux::test

DUOLUX_GLSL_TYPE(duolux::test::Basis<glm::vec3>, "BasisResult", "vec3 tangent; vec3 bitangent;");

namespace duolux::test {
namespace {

std::vector<Basis<glm::vec3>> bases(const std::vector<glm::vec3>& normals) {
    return warp().evaluate<Basis<glm::vec3>>("orthonormalBasis(x0, result.tangent, result.bitangent);",
                                             normals);
}

/// Over the whole sphere; near each axis, with components down to denormal numbers; on the seam n.z = 0 and
/// -0.
std::vector<glm::vec3> frameNormals() {
    std::vector<glm::vec3> ns = randomDirections(1 << 14);
    const std::vector<float> tiny = randomScales(3 * 1024, -149.0, -1.0);
    for (std::size_t i = 0; i < tiny.size(); ++i) {
        glm::dvec3 n(static_cast<double>(tiny[i]), static_cast<double>(tiny[tiny.size() - 1 - i]), 1.0);
        if (i / 3 % 2 == 1) n.y = i % 2 == 0 ? 0.75 : -0.75;
        if (i / 6 % 2 == 1) n.z = -n.z;
        n = glm::normalize(n);
        const auto axis = static_cast<glm::length_t>(i % 3);
        ns.emplace_back(n[axis], n[(axis + 1) % 3], n[(axis + 2) % 3]);
    }
    for (const float zero : {0.0f, -0.0f}) {
        for (const glm::vec2 n : {glm::vec2(1, 0), glm::vec2(-1, 0), glm::vec2(0, 1), glm::vec2(0, -1),
                                  glm::vec2(0.6f, 0.8f), glm::vec2(-0.8f, 0.6f)}) {
            ns.emplace_back(n.x, n.y, zero);
            ns.emplace_back(n.x, zero, n.y);
            ns.emplace_back(zero, n.x, n.y);
        }
    }
    return ns;
}

/// The frame is space rotated from z to n by the smaller angle, R e = e - (e . n) (n + z) / (1 + n . z) for e
/// = x, y; below the seam, it is the frame for -n with the second vector negated (Frisvad, "Building an
/// Orthonormal Basis from a 3D Unit Vector Without Normalization", 2012, with the change by Duff et al.,
/// 2017). Apart from the rounding of n, the error is that of a few operations on numbers up to 1.
TEST(Warp, BasisIsSpaceTurnedTheShortWay) {
    const std::vector<glm::vec3> ns = frameNormals();
    const std::vector<Basis<glm::vec3>> frames = bases(ns);
    for (std::size_t i = 0; i < ns.size(); ++i) {
        const double side = ns[i].z < 0.0f ? -1.0 : 1.0;
        const glm::dvec3 m = side * glm::dvec3(ns[i]);
        const glm::dvec3 z(0.0, 0.0, 1.0);
        const auto turned = [&](const glm::dvec3& e) { return e - glm::dot(e, m) * (m + z) / (1.0 + m.z); };
        ASSERT_LT(glm::length(glm::dvec3(frames[i].tangent) - turned({1.0, 0.0, 0.0})), 2e-7) << i;
        ASSERT_LT(glm::length(glm::dvec3(frames[i].bitangent) - side * turned({0.0, 1.0, 0.0})), 2e-7) << i;
    }
}

TEST(WarpOracles, AllFunctions) {
    const std::vector<glm::vec2> us = squareWithEdges();
    EXPECT_ORACLES(warp(), cosineHemisphere, (Budget{2, 1e-6}), us);
    EXPECT_ORACLES(warp(), uniformTriangle, (Budget{1, 0}), us);
    const std::vector<glm::vec3> ns = frameNormals();
    const auto by = [](auto function, auto n) {
        Basis<decltype(n)> basis;
        function(n, basis.tangent, basis.bitangent);
        return basis;
    };
    EXPECT_WITHIN_ORACLES(
        "orthonormalBasis", bases(ns), {1, 2e-7},
        [&](const glm::vec3& n) { return by(mirror::single::orthonormalBasis, n); },
        [&](const glm::dvec3& n) { return by(mirror::twice::orthonormalBasis, n); }, ns);
}

}  // namespace
}  // namespace duolux::test

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "shaders/shared/bvh_layout.h"
#include "shaders/shared/path_tracer_layout.h"
#include "tests/shader/inputs.h"
#include "tests/shader/mirror_types.h"
#include "tests/shader/no_scene.h"
#include "tests/shader/oracles.h"

// Points on surfaces: the bound on rounding errors at every scale, frames in double precision, and both
// oracles.

namespace duolux::test {
namespace {

using mirror::single::SurfacePoint;
using mirror::single::Triangle;

const shared::DeviceNormals kCorners{{0x10002000u, 0xf0001800u, 0x0800e000u}, 0u};

const ShaderLibrary& surface() {
    static const ShaderLibrary library = ShaderLibrary("shaders/lib/surface.glsl")
                                             .texels("fetchNormalTexel", std::span(&kCorners, 1))
                                             .define(
                                                 "uvec4 fetchPlaneTexel(uint index) { return uvec4(0u); }"
                                                 "uvec4 fetchPairTexel(uint index) { return uvec4(0u); }")
                                             .define(kNoVertexRecords);
    return library;
}

/// Rays that meet triangles: what surfacePoint takes.
struct Hits {
    std::vector<Triangle> triangles;
    std::vector<glm::vec2> barycentrics;
    std::vector<glm::vec3> normals, rays;
};

/// Scenes of sizes from 1e-3 to 1e6. Triangles are as large as the scene, or down to 2^-10 of it and away
/// from the origin. Points at corners, on edges and inside. Rays from both sides, many of them grazing.
Hits hits(std::size_t n) {
    const std::vector<float> sizes = randomScales(n, std::log2(1e-3), std::log2(1e6), 1);
    const std::vector<float> shrinks = randomScales(n, -10.0, 0.0, 2);
    const std::vector<glm::vec3> directions = randomDirections(5 * n, 3);
    const std::vector<glm::vec2> us = randomSquare(n, 4);
    Hits hits;
    for (std::size_t i = 0; i < n; ++i) {
        const float size = std::abs(sizes[i]);
        const float shrink = size * std::abs(shrinks[i]);
        const auto corner = [&](std::size_t c) {
            return directions[5 * i + 3] * (i % 4 == 0 ? 0.0f : size) + directions[5 * i + c] * shrink;
        };
        const Triangle t{corner(0), corner(1), corner(2), 7u, i % 2 == 0 ? 3u : 3u | shared::kTriangleSmooth};
        const glm::dvec3 across =
            glm::cross(glm::dvec3(t.v1) - glm::dvec3(t.v0), glm::dvec3(t.v2) - glm::dvec3(t.v0));
        if (glm::length(across) < 0.02 * static_cast<double>(shrink) * static_cast<double>(shrink)) continue;
        glm::vec2 b = us[i].x + us[i].y > 1.0f ? 1.0f - us[i] : us[i];
        if (i % 8 == 1)
            b = glm::vec2(i / 8 % 2, i / 16 % 2) * glm::vec2(1, 1.0f - static_cast<float>(i / 8 % 2));
        if (i % 8 == 2) b.x = 0.0f;
        if (i % 8 == 3) b.y = 1.0f - b.x;
        const glm::dvec3 normal = glm::normalize(across);
        glm::dvec3 ray(directions[5 * i + 4]);
        if (i % 3 == 0) {  // grazing: 1e-4 out of the plane
            ray -= glm::dot(ray, normal) * normal;
            ray = glm::normalize(ray) + (i % 2 == 0 ? 1e-4 : -1e-4) * normal;
        }
        hits.triangles.push_back(t);
        hits.barycentrics.push_back(b);
        hits.normals.emplace_back(normal);
        hits.rays.emplace_back(glm::normalize(ray));
    }
    return hits;
}

std::vector<SurfacePoint> pointsOf(const Hits& h, std::uint32_t smooth) {
    return surface().evaluate<SurfacePoint>("result = surfacePoint(x0, 0u, x1, x2, x3, x4 != 0u);",
                                            h.triangles, h.barycentrics, h.normals, h.rays, smooth);
}

/// The point with the same barycentric coordinates in double precision.
glm::dvec3 exactPoint(const Triangle& t, const glm::vec2& barycentric) {
    const glm::dvec2 b(barycentric);
    return glm::dvec3(t.v0) * (1.0 - b.x - b.y) + glm::dvec3(t.v1) * b.x + glm::dvec3(t.v2) * b.y;
}

double largestCoordinate(const Triangle& t) {
    double largest = 0.0;
    for (const glm::vec3& v : {t.v0, t.v1, t.v2})
        for (glm::length_t c = 0; c < 3; ++c)
            largest = std::max(largest, static_cast<double>(std::abs(v[c])));
    return largest;
}

/// 32 units of roundoff of the largest coordinate. A point needs less than a quarter of that: with u = 2^-24,
/// three products (u each), the first weight (2 u) and two sums (2 u) of numbers that are no larger, times
/// sqrt(3) along the normal.
TEST(Surface, PointErrorBoundsTheRoundingOfPoints) {
    const Hits h = hits(1 << 16);
    const std::vector<glm::vec3> points =
        surface().call<glm::vec3>("pointOnTriangle", h.triangles, h.barycentrics);
    const std::vector<float> errors = surface().call<float>("pointError", h.triangles);
    double worst = 0.0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const double bound = largestCoordinate(h.triangles[i]) * 32.0 * 0x1p-24;
        ASSERT_NEAR(static_cast<double>(errors[i]), bound, 1e-6 * bound) << i;
        const double off = glm::length(glm::dvec3(points[i]) - exactPoint(h.triangles[i], h.barycentrics[i]));
        worst = std::max(worst, off / bound);
    }
    RecordProperty("worst", std::to_string(worst));
    EXPECT_LT(worst, 0.25);
    EXPECT_GT(worst, 0.03);  // the inputs do have rounding errors
}

/// In double precision, the position is off the triangle's plane on the ray's side, at all scales, by the
/// allowed error, and does not deviate from the hit point otherwise.
TEST(Surface, PositionIsOffTheSurfaceOnTheRaysSide) {
    const Hits h = hits(1 << 16);
    const std::vector<SurfacePoint> points = pointsOf(h, 1);  // smooth normals must not matter
    for (std::size_t i = 0; i < points.size(); ++i) {
        const Triangle& t = h.triangles[i];
        const double error = largestCoordinate(t) * 32.0 * 0x1p-24;
        const glm::dvec3 normal(h.normals[i]);
        const double side = glm::dot(normal, glm::dvec3(h.rays[i])) < 0.0 ? 1.0 : -1.0;
        const glm::dvec3 off = glm::dvec3(points[i].position) - exactPoint(t, h.barycentrics[i]);
        ASSERT_EQ(points[i].geometricNormal, h.normals[i] * static_cast<float>(side)) << i;
        ASSERT_GT(glm::dot(off, side * normal), 0.75 * error) << i;
        ASSERT_LT(glm::length(off - side * error * normal), 0.25 * error) << i;
    }
}

/// Coordinates in the frame, and back, against dot products with the axes in double precision. Directions
/// transformed back have unit length.
TEST(Surface, FramesMatchDoublePrecision) {
    const std::vector<glm::vec3> normals = randomDirections(1 << 14, 5);
    const std::vector<glm::vec3> directions = randomDirections(1 << 14, 6);
    const std::vector<glm::vec3> local =
        ShaderLibrary("shaders/lib/frame.glsl").call<glm::vec3>("toFrame", normals, directions);
    const std::vector<glm::vec3> world =
        ShaderLibrary("shaders/lib/frame.glsl").call<glm::vec3>("fromFrame", normals, directions);
    for (std::size_t i = 0; i < normals.size(); ++i) {
        // The rotation from z to the normal by the smaller angle; below the equator, the rotation from -z
        // with the second axis negated.
        const double side = normals[i].z < 0.0f ? -1.0 : 1.0;
        const glm::dvec3 n(normals[i]);
        const auto turned = [&](const glm::dvec3& e) {
            return e - glm::dot(e, n) * (n + glm::dvec3(0.0, 0.0, side)) / (1.0 + std::abs(n.z));
        };
        const glm::dmat3 axes(turned({1.0, 0.0, 0.0}), side * turned({0.0, 1.0, 0.0}), n);
        const glm::dvec3 d(directions[i]);
        ASSERT_LT(glm::length(glm::dvec3(local[i]) - d * axes), 6e-7) << i;
        ASSERT_LT(glm::length(glm::dvec3(world[i]) - axes * d), 6e-7) << i;
        ASSERT_NEAR(glm::length(glm::dvec3(world[i])), 1.0, 2e-7) << i;
    }
}

/// The same with a stored plane: the point is at the ray's intersection, offset to the ray's side by a bound
/// that depends on the point's size and not on the triangle's. Behind coincident surfaces it is on the plane,
/// and a ray that leaves it starts after the surface itself.
TEST(Surface, WithPlanesPointsAreAsExactAsTheirOwnSize) {
    const glm::vec4 plane(glm::normalize(glm::vec3(0.2f, 1.0f, -0.3f)), 0.25f);
    const glm::vec3 normal(plane);
    const std::vector<glm::vec4> planes{plane};
    const std::vector<shared::DevicePair> pairs{{{}, 5, {}, 0, {}, 0, {}, 6}};
    ShaderLibrary library("shaders/lib/surface.glsl");
    library.texels("fetchPlaneTexel", std::span(planes))
        .texels("fetchPairTexel", std::span(pairs))
        .texels("fetchNormalTexel", std::span(&kCorners, 1))
        .define(kNoVertexRecords)
        .constant(shared::kSpecPlanes, 1);
    std::vector<glm::vec3> at;
    std::vector<SurfacePoint> points;
    for (const glm::vec3& d : randomDirections(2000, 12)) {
        // Near the plane, up to 100 from the origin.
        const glm::vec3 across = 100.0f * glm::pow(std::abs(d.x), 4.0f) * glm::normalize(d);
        at.push_back(across - normal * (glm::dot(normal, across) - plane.w) + 1e-5f * d);
        const float side = at.size() % 2 == 0 ? 1.0f : -1.0f;
        points.push_back({glm::vec3(1e5f), side * normal, side * normal, 0u, 0u, 0.0f});
    }
    for (const std::uint32_t behind : {0u, 1u}) {
        const auto placed =
            library.evaluate<SurfacePoint>("result = placedByPlane(x0, x1, x2 != 0u);", points, at,
                                           std::vector<std::uint32_t>(at.size(), behind));
        const auto begins = library.evaluate<glm::vec4>(
            "Segment b = leaveSurface(x0, x0.geometricNormal, false); result = vec4(b.t, "
            "uintBitsToFloat(b.order & "
            "0xffffu), b.order == kNoTriangle ? 1.0 : 0.0, (b.order >> 31u) == 1u ? 1.0 : 0.0);",
            placed);
        for (std::size_t i = 0; i < at.size(); ++i) {
            const double size = static_cast<double>(glm::length(at[i])) + 0.25;
            const double height =
                glm::dot(glm::dvec3(normal), glm::dvec3(placed[i].position)) - static_cast<double>(plane.w);
            const double along = glm::dot(glm::dvec3(placed[i].geometricNormal), glm::dvec3(normal)) * height;
            EXPECT_LT(glm::length(glm::dvec3(placed[i].position) - glm::dvec3(at[i])), 3e-5 + 4e-6 * size);
            if (behind == 0) {
                EXPECT_GT(along, 1e-7 * size);
                EXPECT_LT(along, 2e-6 * size);
                EXPECT_EQ(begins[i].z, 1.0f);
                EXPECT_EQ(begins[i].x, 0.0f);
            } else {
                EXPECT_LT(std::abs(along), 4e-7 * size);
                EXPECT_LT(static_cast<double>(std::abs(begins[i].x)), 1e-6 * size);
                EXPECT_EQ(begins[i].z, 0.0f);
                // The order is 5 on the front, and its complement on the back.
                EXPECT_EQ(begins[i].w, i % 2 == 1 ? 1.0f : 0.0f);
            }
        }
    }
}

/// Positions in units of the triangle's size, so that one budget suffices.
TEST(SurfaceOracles, AllFunctions) {
    mirror::texels().normals = {{kCorners.octahedral[0], kCorners.octahedral[1], kCorners.octahedral[2], 0u}};
    Hits h = hits(1 << 13);
    for (Triangle& t : h.triangles) {
        const float size = static_cast<float>(largestCoordinate(t));
        for (glm::vec3* v : {&t.v0, &t.v1, &t.v2})
            *v /= size;
    }
    const std::vector<std::uint32_t> indices(h.triangles.size(), 0u);
    for (const std::uint32_t smooth : {0u, 1u}) {
        EXPECT_WITHIN_ORACLES(
            "surfacePoint", pointsOf(h, smooth), {1, 4e-7},
            [&](const auto&... x) { return mirror::single::surfacePoint(x..., smooth != 0u); },
            [&](const auto&... x) { return mirror::twice::surfacePoint(x..., smooth != 0u); }, h.triangles,
            indices, h.barycentrics, h.normals, h.rays);
    }
    const ShaderLibrary frame("shaders/lib/frame.glsl");
    EXPECT_ORACLES(frame, toFrame, (Budget{1, 6e-7}), h.normals, h.rays);
    EXPECT_ORACLES(frame, fromFrame, (Budget{1, 6e-7}), h.normals, h.rays);
    // The quotient of two cosines. Keeps the denominator away from 0, where its rounding dominates, and both
    // away from 0, where single and double precision may see different sides.
    std::vector<SurfacePoint> points;
    std::vector<glm::vec3> wi;
    for (std::size_t i = 0; i < h.rays.size(); ++i) {
        const glm::dvec3 shading = glm::normalize(glm::dvec3(h.normals[i]) + 0.9 * glm::dvec3(h.rays[i]));
        const glm::dvec3 w(h.rays[(i + 1) % h.rays.size()]);
        if (std::abs(glm::dot(shading, w)) < 1e-3 || std::abs(glm::dot(glm::dvec3(h.normals[i]), w)) < 0.05)
            continue;
        points.push_back({glm::vec3(0.0f), h.normals[i], glm::vec3(shading), 0u, 0u, 0.0f});
        wi.emplace_back(w);
    }
    EXPECT_ORACLES(surface(), shadingAdjoint, (Budget{8, 1e-5}), points, wi);
    mirror::texels() = {};
}

}  // namespace
}  // namespace duolux::test

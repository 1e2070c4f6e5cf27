#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "tests/shader/oracles.h"
#include "tests/shader/test_meshes.h"

// Compares rays against triangles and boxes with different formulas in double precision, and with both
// oracles.

namespace duolux::test {

/// Corners, ray, and the device's result.
struct Shot {
    glm::vec3 v0, v1, v2, origin, direction;
};
struct ShotHit {
    std::uint32_t hit;
    float t;
    glm::vec2 barycentric;
};
std::vector<double> numbers(const ShotHit& h) {
    return numbers(h.hit, h.hit != 0 ? h.t : 0.0f, h.hit != 0 ? h.barycentric : glm::vec2(0.0f));
}

}  // namespace duolux::test

DUOLUX_GLSL_TYPE(duolux::test::Shot, "Shot", "vec3 v0; vec3 v1; vec3 v2; vec3 origin; vec3 direction;");
DUOLUX_GLSL_TYPE(duolux::test::ShotHit, "ShotHit", "uint hit; float t; vec2 barycentric;");

namespace duolux::test {
namespace {

constexpr double kRoundoff = 0x1p-24;

const ShaderLibrary& intersect() {
    static const ShaderLibrary library("shaders/lib/intersect.glsl");
    return library;
}

std::vector<ShotHit> shoot(const std::vector<Shot>& shots) {
    return intersect().evaluate<ShotHit>(R"(
        vec3 axisU, axisV;
        orthonormalBasis(x0.direction, axisU, axisV);
        TriangleHit h = intersectTriangle(Triangle(x0.v0, x0.v1, x0.v2, 0u, 0u), x0.origin, x0.direction, axisU, axisV, false);
        result = ShotHit(h.hit ? 1u : 0u, h.t, h.barycentric);)",
                                         shots);
}

/// The intersection of a ray with the plane of a triangle, and its barycentric coordinates (Moeller and
/// Trumbore, 1997).
struct Reference {
    double t;
    std::array<double, 3> barycentric;
    double cosine;    ///< of the angle between ray and normal
    double farthest;  ///< distance of a corner from the ray's origin
    double longest;   ///< length of an edge
    double height;    ///< twice the area over the longest edge
};

Reference referenceOf(const Shot& shot) {
    const glm::dvec3 a = shot.v0, e1 = glm::dvec3(shot.v1) - a, e2 = glm::dvec3(shot.v2) - a;
    const glm::dvec3 d = glm::normalize(glm::dvec3(shot.direction));
    const glm::dvec3 p = glm::cross(d, e2), s = glm::dvec3(shot.origin) - a, q = glm::cross(s, e1);
    const double det = glm::dot(e1, p), u = glm::dot(s, p) / det, v = glm::dot(d, q) / det;
    const double area = glm::length(glm::cross(e1, e2));
    const double longest = std::max({glm::length(e1), glm::length(e2), glm::length(e2 - e1)});
    const auto far = [&](glm::vec3 corner) {
        return glm::distance(glm::dvec3(corner), glm::dvec3(shot.origin));
    };
    return {glm::dot(e2, q) / det,
            {1.0 - u - v, u, v},
            std::abs(det) / area,
            std::max({far(shot.v0), far(shot.v1), far(shot.v2)}),
            longest,
            area / longest};
}

/// Triangles of all shapes down to slivers of 1 : 1000, and rays at and beside them, from up to 100 edges
/// away, including axis-parallel and grazing ones (down to a cosine of about 0.01).
std::vector<Shot> shots(int count, float smallestCosine) {
    Random random(7);
    std::vector<Shot> out;
    while (static_cast<int>(out.size()) < count) {
        const int kind = static_cast<int>(out.size()) % 8;
        const float scale = std::exp2(random.uniform(-20.0f, 20.0f));
        const glm::vec3 a = random.inBox(1.0f), b = a + random.inBox(1.0f);
        glm::vec3 c = a + random.inBox(1.0f);
        if (kind == 1) c = glm::mix(a, b, random.uniform(-0.5f, 1.5f)) + 1e-3f * random.inBox(1.0f);
        const float u = random.uniform(-0.3f, 1.0f), v = random.uniform(-0.3f, 1.1f - u);
        const glm::vec3 target = a + u * (b - a) + v * (c - a);
        glm::vec3 d = random.direction();
        if (kind == 2) {
            d = glm::vec3(0.0f);
            d[static_cast<int>(out.size()) % 3] = random.uniform(-1.0f, 1.0f) < 0.0f ? -1.0f : 1.0f;
        }
        if (kind == 3) d = glm::normalize(u * (b - a) + (v + 0.3f) * (c - a) + 0.02f * d);
        const float distance = kind == 4 ? 100.0f : random.uniform(-1.0f, 3.0f);
        const Shot shot{scale * a, scale * b, scale * c, scale * (target - distance * d), d};
        const Reference r = referenceOf(shot);
        if (r.cosine > static_cast<double>(smallestCosine) && r.height > 1e-4 * r.longest)
            out.push_back(shot);
    }
    return out;
}

/// The corners' coordinates across the ray have errors of a few roundings of their distance. They move the
/// point by as much across the ray, by that divided by the cosine within the plane, and barycentric
/// coordinates by that divided by the triangle's height. If all of them are further from 0, hit and miss are
/// certain. Lavapipe needs 3.7 of these units.
constexpr double kBudget = 8.0;

TEST(Intersect, TrianglesAgreeWithDoublePrecision) {
    const std::vector<Shot> all = shots(100000, 0.005f);
    const std::vector<ShotHit> hits = shoot(all);
    double worstT = 0.0, worstBarycentric = 0.0;
    std::size_t certainHits = 0, certainMisses = 0, uncertain = 0;
    for (std::size_t i = 0; i < all.size(); ++i) {
        const Reference r = referenceOf(all[i]);
        const double across = kRoundoff * r.farthest / r.cosine;  // in the plane
        const double allowed = kBudget * across / r.height;
        const double least = std::min({r.barycentric[0], r.barycentric[1], r.barycentric[2]});
        if (std::abs(least) <= allowed) {
            ++uncertain;
            continue;
        }
        ASSERT_EQ(hits[i].hit != 0, least > 0.0) << i << ": " << least << ", allowed " << allowed;
        if (least < 0.0) {
            ++certainMisses;
            continue;
        }
        ++certainHits;
        worstT = std::max(worstT,
                          std::abs(static_cast<double>(hits[i].t) - r.t) / (across * r.longest / r.height));
        for (int k = 0; k < 2; ++k) {
            const double off =
                static_cast<double>(hits[i].barycentric[k]) - r.barycentric[static_cast<std::size_t>(k) + 1];
            worstBarycentric = std::max(worstBarycentric, std::abs(off) / (across / r.height));
        }
    }
    RecordProperty("t_in_roundings", std::to_string(worstT));
    RecordProperty("barycentric_in_roundings", std::to_string(worstBarycentric));
    EXPECT_LE(worstT, kBudget);
    EXPECT_LE(worstBarycentric, kBudget);
    EXPECT_GT(certainHits, all.size() / 5);
    EXPECT_GT(certainMisses, all.size() / 5);
    EXPECT_LT(uncertain, all.size() / 100);
}

struct BoxCase {
    glm::vec3 origin, direction;
    float tMin;
    glm::vec3 lower, upper;
};

/// Length of the ray's interval within the slabs, by clipping its line against one slab after another;
/// negative if it misses. Hit and miss are certain if the magnitude exceeds rounding errors.
double stayWithin(const BoxCase& box, double& farthest) {
    double entry = static_cast<double>(box.tMin), leave = 1e300;
    farthest = 0.0;
    for (int k = 0; k < 3; ++k) {
        const double o = static_cast<double>(box.origin[k]), d = static_cast<double>(box.direction[k]);
        double near = static_cast<double>(box.lower[k]) - o, far = static_cast<double>(box.upper[k]) - o;
        if (d == 0.0) {
            if (near > 0.0 || far < 0.0) return -1e300;
            continue;
        }
        if (d < 0.0) std::swap(near, far);
        entry = std::max(entry, near / d);
        leave = std::min(leave, far / d);
    }
    farthest = std::max(std::abs(entry), std::abs(leave));
    return leave - entry;
}

/// Boxes of all scales, and rays at and beside them for which double precision decides with certainty.
struct BoxCases {
    std::vector<glm::vec3> origins, directions, lowers, uppers;
    std::vector<float> tMins;
    std::vector<std::uint32_t> met;
};

BoxCases boxCases(int count) {
    Random random(3);
    BoxCases out;
    for (int i = 0; i < count; ++i) {
        const float scale = std::exp2(random.uniform(-40.0f, 40.0f));
        const glm::vec3 lower = random.inBox(1.0f);
        const glm::vec3 upper = lower + 0.5f * (random.inBox(1.0f) + 1.0f);
        const glm::vec3 origin = random.inBox(2.0f);
        glm::vec3 d = lower + (upper - lower) * (random.inBox(0.7f) + 0.5f) - origin;
        if (i % 4 == 1) d[i / 4 % 3] = i % 8 < 4 ? 0.0f : -0.0f;
        if (i % 4 == 2) d[(i / 4 + 1) % 3] = d[i / 4 % 3] = 0.0f;
        const float tMin = i % 3 == 0 ? random.uniform(-2.0f, 3.0f) : 0.0f;
        const BoxCase box{scale * origin, glm::normalize(d), scale * tMin, scale * lower, scale * upper};
        double farthest = 0.0;
        const double stay = stayWithin(box, farthest);
        if (std::abs(stay) <= 8.0 * kRoundoff * farthest) continue;
        out.origins.push_back(box.origin);
        out.directions.push_back(box.direction);
        out.tMins.push_back(box.tMin);
        out.lowers.push_back(box.lower);
        out.uppers.push_back(box.upper);
        out.met.push_back(stay > 0.0 ? 1 : 0);
    }
    return out;
}

std::vector<std::uint32_t> meetBoxes(const BoxCases& c) {
    return intersect().evaluate<std::uint32_t>("result = intersectBox(x0, x1, x2, x3, x4) ? 1u : 0u;",
                                               c.origins, c.directions, c.tMins, c.lowers, c.uppers);
}

TEST(Intersect, BoxesAgreeWithDoublePrecision) {
    const BoxCases cases = boxCases(100000);
    EXPECT_EQ(meetBoxes(cases), cases.met);
    const auto met = std::count(cases.met.begin(), cases.met.end(), 1u);
    EXPECT_GT(met, 20000);
    EXPECT_LT(met, 80000);
}

TEST(IntersectOracles, Triangle) {
    // Well conditioned, and away from edges, where single and double precision may differ.
    std::vector<Shot> all;
    for (const Shot& shot : shots(20000, 0.1f)) {
        const Reference r = referenceOf(shot);
        const double least = std::min({r.barycentric[0], r.barycentric[1], r.barycentric[2]});
        if (r.height > 0.1 * r.longest && std::abs(least) > 1e-3 && r.farthest < 8.0 * r.longest)
            all.push_back(shot);
    }
    ASSERT_GT(all.size(), 5000u);
    std::vector<ShotHit> hits = shoot(all);
    for (std::size_t i = 0; i < all.size(); ++i)  // distances in units of the triangle
        hits[i].t /= static_cast<float>(referenceOf(all[i]).longest);
    const auto single = [](const Shot& s) {
        mirror::single::vec3 u, v;
        mirror::single::orthonormalBasis(s.direction, u, v);
        const auto h =
            mirror::single::intersectTriangle({s.v0, s.v1, s.v2, 0, 0}, s.origin, s.direction, u, v, false);
        return ShotHit{h.hit, h.t / static_cast<float>(referenceOf(s).longest), h.barycentric};
    };
    const auto twice = [](const Shot& s) {
        const glm::dvec3 d = s.direction;
        mirror::twice::vec3 u, v;
        mirror::twice::orthonormalBasis(d, u, v);
        const auto h =
            mirror::twice::intersectTriangle({glm::dvec3(s.v0), glm::dvec3(s.v1), glm::dvec3(s.v2), 0, 0},
                                             glm::dvec3(s.origin), d, u, v, false);
        return ShotHit{h.hit, static_cast<float>(h.t / referenceOf(s).longest), glm::vec2(h.barycentric)};
    };
    EXPECT_WITHIN_ORACLES("intersectTriangle", hits, Budget{4, 1e-5}, single, twice, all);
}

}  // namespace

inline Shot widen(const Shot& s) {
    return s;
}

namespace {

TEST(IntersectOracles, SafeInverse) {
    Random random;
    std::vector<float> ds{0.0f, -0.0f, 1e-20f, -1e-20f, 1.0f, -1.0f, 1e30f};
    for (int i = 0; i < 4096; ++i)
        ds.push_back((i % 2 == 0 ? 1.0f : -1.0f) * std::exp2(random.uniform(-100.0f, 100.0f)));
    EXPECT_ORACLES(intersect(), safeInverse, (Budget{3, 0}), ds);
}

TEST(IntersectOracles, Boxes) {
    const BoxCases c = boxCases(4096);
    const auto single = [](const auto&... x) { return mirror::single::intersectBox(x...); };
    const auto twice = [](const auto&... x) { return mirror::twice::intersectBox(x...); };
    EXPECT_WITHIN_ORACLES("intersectBox", meetBoxes(c), Budget{0, 0}, single, twice, c.origins, c.directions,
                          c.tMins, c.lowers, c.uppers);
}

TEST(IntersectOracles, PointsOnTriangles) {
    Random random;
    std::vector<Shot> triangles = shots(4096, 0.0f);
    std::vector<glm::vec2> bs;
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        bs.emplace_back(random.uniform(0.0f, 1.0f), random.uniform(0.0f, 0.5f));
        const float size = static_cast<float>(glm::length(triangles[i].v0) + glm::length(triangles[i].v1));
        for (glm::vec3* p : {&triangles[i].v0, &triangles[i].v1, &triangles[i].v2})
            *p /= size;
    }
    const auto points = intersect().evaluate<glm::vec4>(
        "Triangle tri = Triangle(x0.v0, x0.v1, x0.v2, 0u, 0u); result = vec4(pointOnTriangle(tri, x1), "
        "pointError(tri));",
        triangles, bs);
    const auto single = [](const Shot& s, glm::vec2 b) {
        const mirror::single::Triangle tri{s.v0, s.v1, s.v2, 0, 0};
        return glm::vec4(mirror::single::pointOnTriangle(tri, b), mirror::single::pointError(tri));
    };
    const auto twice = [](const Shot& s, glm::dvec2 b) {
        const mirror::twice::Triangle tri{glm::dvec3(s.v0), glm::dvec3(s.v1), glm::dvec3(s.v2), 0, 0};
        return glm::dvec4(mirror::twice::pointOnTriangle(tri, b), mirror::twice::pointError(tri));
    };
    EXPECT_WITHIN_ORACLES("pointOnTriangle and pointError", points, Budget{1, 2e-7}, single, twice, triangles,
                          bs);
}

}  // namespace
}  // namespace duolux::test

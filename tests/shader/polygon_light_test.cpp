#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>

#include "tests/shader/harness/census.h"
#include "tests/shader/oracles.h"
#include "tests/support/closed_form.h"

// Lambert's formula against double precision, formulas for other shapes, and sums over the area.

namespace duolux::test {
namespace {

const ShaderLibrary& polygonLight() {
    static const ShaderLibrary library("shaders/lib/polygon_light.glsl");
    return library;
}

/// A corner and the edges to the others, relative to the receiver, and the receiver's normal.
struct LightTriangle {
    glm::vec3 a, edge1, edge2, normal;
};

/// From its corners.
LightTriangle cornered(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c, const glm::vec3& normal) {
    return {a, b - a, c - a, normal};
}

struct Columns {
    std::vector<glm::vec3> a, edge1, edge2, normal;
};

Columns columns(const std::vector<LightTriangle>& triangles) {
    Columns out;
    for (const LightTriangle& t : triangles) {
        out.a.push_back(t.a);
        out.edge1.push_back(t.edge1);
        out.edge2.push_back(t.edge2);
        out.normal.push_back(t.normal);
    }
    return out;
}

std::vector<float> evaluate(const std::vector<LightTriangle>& triangles) {
    const Columns in = columns(triangles);
    return polygonLight().call<float>("projectedSolidAngle", in.a, in.edge1, in.edge2, in.normal);
}

/// The same in double precision, by clipping the polygon.
double exact(const LightTriangle& t) {
    const Vec3 a(t.a);
    const std::array<Vec3, 3> corners{a, a + Vec3(t.edge1), a + Vec3(t.edge2)};
    return std::abs(lambertPolygon(Vec3(0.0), glm::normalize(Vec3(t.normal)), corners));
}

/// The value for a square with sides as long as the triangle's longest edge, overhead and facing the
/// receiver: an upper bound for oblique and thin triangles.
double facing(const LightTriangle& t) {
    const Vec3 edge1(t.edge1), edge2(t.edge2), middle = Vec3(t.a) + (edge1 + edge2) / 3.0;
    const double longest =
        std::max({glm::dot(edge1, edge1), glm::dot(edge2, edge2), glm::dot(edge2 - edge1, edge2 - edge1)});
    return longest / glm::dot(middle, middle);
}

class PolygonLight : public testing::Test {
  protected:
    glm::vec3 direction() {
        glm::vec3 v;
        do {
            v = {uniform_(engine_), uniform_(engine_), uniform_(engine_)};
        } while (glm::length(v) < 0.1f || glm::length(v) > 1.0f);
        return glm::normalize(v);
    }

    std::vector<LightTriangle> triangles(std::size_t count) {
        std::vector<LightTriangle> out;
        for (std::size_t i = 0; i < count; ++i) {
            const float size = std::exp(4.0f * uniform_(engine_));
            const glm::vec3 centre = direction();
            out.push_back(cornered(centre + size * direction(), centre + size * direction(),
                                   centre + size * direction(), direction()));
        }
        return out;
    }

    /// The error of a sum of three arcs of at most pi, each with a few roundings.
    static constexpr double kTolerance = 2e-6;

    std::mt19937 engine_{7};
    std::uniform_real_distribution<float> uniform_{-1.0f, 1.0f};
};

TEST_F(PolygonLight, TrianglesOfAllSizesAndHeightsMatchDoublePrecision) {
    const std::vector<LightTriangle> inputs = triangles(20000);
    const std::vector<float> results = evaluate(inputs);
    int above = 0;
    int cut = 0;
    Census census("projectedSolidAngle");
    for (std::size_t i = 0; i < inputs.size(); ++i) {
        const LightTriangle& t = inputs[i];
        int corners = 0;
        for (const glm::vec3& corner : {t.a, t.a + t.edge1, t.a + t.edge2})
            corners += glm::dot(corner, t.normal) > 0.0f ? 1 : 0;
        above += corners == 3 ? 1 : 0;
        cut += corners == 1 || corners == 2 ? 1 : 0;
        census.compare(i, results[i], exact(t), kTolerance);
    }
    EXPECT_GT(above, 1000);
    EXPECT_GT(cut, 5000);
}

// Sizes from a millionth of the distance to the distance itself, above the horizon and cut by it. The error
// is relative if neither cosine is small; a small cosine has an absolute error from the rounding of the
// corner's position.
TEST_F(PolygonLight, SmallTrianglesKeepTheirDigits) {
    std::vector<LightTriangle> inputs;
    std::array<int, 3> cut{};  // by corners above the horizon: 1, 2, 3
    for (int exponent = 0; exponent <= 60; ++exponent) {
        const float size = std::pow(10.0f, -0.1f * static_cast<float>(exponent));
        for (int i = 0; i < 400; ++i) {
            const float distance = std::exp2(10.0f * uniform_(engine_));
            LightTriangle t{distance * direction(), size * distance * direction(),
                            size * distance * direction(), direction()};
            // Every second triangle is cut by the horizon.
            if (i % 2 == 0) {
                const glm::vec3 inside = t.a + 0.4f * t.edge1 + 0.3f * t.edge2;
                t.normal = glm::normalize(glm::cross(inside, direction()));
            }
            int above = 0;
            for (const glm::vec3& edge : {glm::vec3(0.0f), t.edge1, t.edge2})
                above += glm::dot(Vec3(t.a) + Vec3(edge), Vec3(t.normal)) > 0.0 ? 1 : 0;
            if (above > 0) ++cut[static_cast<std::size_t>(above - 1)];
            inputs.push_back(t);
        }
    }
    for (const int count : cut)
        EXPECT_GT(count, 2000);
    const std::vector<float> results = evaluate(inputs);
    Census census("projectedSolidAngle");
    for (std::size_t i = 0; i < inputs.size(); ++i) {
        const double expected = exact(inputs[i]);
        census.compare(i, results[i], expected, 1.5e-4 * expected + 4e-6 * facing(inputs[i]));
    }
}

TEST_F(PolygonLight, ScaleDoesNotMatter) {
    std::vector<LightTriangle> inputs;
    for (const float scale : {1e-6f, 1e-3f, 1.0f, 1e3f, 1e6f}) {
        inputs.push_back(cornered(scale * glm::vec3(-1, 2, -1), scale * glm::vec3(1, 2, -1),
                                  scale * glm::vec3(0, 2, 1), {0, 1, 0}));
        inputs.push_back(cornered(scale * glm::vec3(-1, -2, -1), scale * glm::vec3(1, 2, -1),
                                  scale * glm::vec3(0, 2, 1), {0, 1, 0}));
    }
    const std::vector<float> results = evaluate(inputs);
    Census census("projectedSolidAngle");
    for (std::size_t i = 0; i < inputs.size(); ++i)
        census.compare(i, results[i], exact(inputs[i % 2]), kTolerance);
}

TEST_F(PolygonLight, LimitsByHand) {
    const glm::vec3 up(0, 1, 0);
    const std::vector<LightTriangle> inputs{
        cornered({-1, -1, 0}, {1, -1, 0}, {0, -1, 1}, up),                // below the horizon
        cornered({-1, 0, -1}, {1, 0, -1}, {0, 0, 1}, up),                 // in the horizon
        cornered({-1e6f, 1, -1e6f}, {1e6f, 1, -1e6f}, {0, 1, 1e6f}, up),  // the whole sky: pi
        cornered({0, 1e-3f, 0}, {1, 1e-3f, 0}, {1, 1e-3f, 0}, up),        // no area
        cornered({0, 0, 0}, {1, 1, 0}, {0, 1, 1}, up),  // receiver at a corner: must be finite
    };
    const std::vector<float> results = evaluate(inputs);
    EXPECT_EQ(results[0], 0.0f);
    EXPECT_NEAR(results[1], 0.0f, kTolerance);
    EXPECT_NEAR(results[2], std::numbers::pi, 1e-5);
    EXPECT_NEAR(results[3], 0.0f, kTolerance);
    EXPECT_TRUE(std::isfinite(results[4]));
}

// A rectangle with sides a and b at height c, one corner of it overhead: pi times the configuration factor
// B-3 in Howell, "A Catalog of Radiation Heat Transfer Configuration Factors" (Hamilton and Morgan, NACA TN
// 2836, 1952).
TEST_F(PolygonLight, RectanglesOverheadHaveTheirConfigurationFactor) {
    std::vector<LightTriangle> inputs;
    std::vector<double> expected;
    for (const float a : {0.01f, 0.3f, 1.0f, 5.0f, 200.0f}) {
        for (const float b : {0.02f, 0.7f, 1.0f, 30.0f}) {
            for (const float c : {0.5f, 1.0f, 4.0f}) {
                const glm::vec3 overhead(0, 0, c), far(a, b, c), up(0, 0, 1);
                inputs.push_back(cornered(overhead, {a, 0, c}, far, up));
                inputs.push_back(cornered(overhead, far, {0, b, c}, up));
                const double x = static_cast<double>(a / c), y = static_cast<double>(b / c);
                const double p = std::sqrt(1.0 + x * x), q = std::sqrt(1.0 + y * y);
                expected.push_back(0.5 * (x / p * std::atan(y / p) + y / q * std::atan(x / q)));
            }
        }
    }
    const std::vector<float> results = evaluate(inputs);
    for (std::size_t i = 0; i < expected.size(); ++i)
        EXPECT_NEAR(static_cast<double>(results[2 * i]) + static_cast<double>(results[2 * i + 1]),
                    expected[i], kTolerance)
            << i;
}

// The integral of cos cos' / d^2 over the area, by the midpoints of 200^2 cells. For triangles that the
// horizon clips, this sum is less accurate.
TEST_F(PolygonLight, SumsOverTheAreaAgree) {
    std::vector<LightTriangle> inputs;
    std::vector<double> expected;
    constexpr int kCells = 200;
    while (inputs.size() < 60) {
        const glm::vec3 centre = 2.0f * direction();
        const LightTriangle t =
            cornered(centre + direction(), centre + direction(), centre + direction(), direction());
        const Vec3 a(t.a), e1(t.edge1), e2(t.edge2);
        const Vec3 across = glm::cross(e1, e2);  // its length: twice the area
        double sum = 0.0;
        double nearest = 1e30;
        for (int i = 0; i < kCells; ++i) {
            for (int j = 0; j < kCells; ++j) {
                const double x = (i + 0.5) / kCells, y = (j + 0.5) / kCells * (1.0 - x);
                const Vec3 p = a + x * e1 + y * e2;
                const double d2 = glm::dot(p, p);
                nearest = std::min(nearest, d2);
                const double height = std::max(glm::dot(p, Vec3(t.normal)), 0.0);
                sum += (1.0 - x) * height * std::abs(glm::dot(p, across)) / (d2 * d2);
            }
        }
        if (nearest < 0.04) continue;  // its peak would need finer cells
        inputs.push_back(t);
        expected.push_back(sum / (kCells * kCells));
    }
    const std::vector<float> results = evaluate(inputs);
    Census census("projectedSolidAngle");
    for (std::size_t i = 0; i < inputs.size(); ++i)
        census.compare(i, results[i], expected[i], 2e-4);
}

// The comment at angleOf states the error, 3e-7. All ratios and all magnitudes of sine and cosine.
TEST_F(PolygonLight, AnglesAreThoseOfAtan2) {
    std::vector<float> sine, cosine;
    for (int i = 0; i <= 20000; ++i) {
        const double angle = std::numbers::pi * i / 20000.0;
        const double size = i % 2 == 0 ? 1.0 : std::exp2(60.0 * static_cast<double>(uniform_(engine_)));
        sine.push_back(static_cast<float>(size * std::max(std::sin(angle), 0.0)));
        cosine.push_back(static_cast<float>(size * std::cos(angle)));
        sine.push_back(static_cast<float>(std::exp2(20.0 * static_cast<double>(uniform_(engine_)))));
        cosine.push_back(static_cast<float>(i % 2 == 0 ? 1 : -1));
    }
    const std::vector<float> results = polygonLight().call<float>("angleOf", sine, cosine);
    double worst = 0.0;
    for (std::size_t i = 0; i < sine.size(); ++i)
        worst = std::max(worst,
                         std::abs(static_cast<double>(results[i]) -
                                  std::atan2(static_cast<double>(sine[i]), static_cast<double>(cosine[i]))));
    EXPECT_LE(worst, 3e-7);
}

class PolygonLightOracles : public PolygonLight {};

TEST_F(PolygonLightOracles, Arcs) {
    std::vector<float> sine, cosine;
    for (int i = 0; i < 10000; ++i) {
        sine.push_back(std::abs(uniform_(engine_)));
        cosine.push_back(uniform_(engine_));
    }
    EXPECT_ORACLES(polygonLight(), angleOf, (Budget{4, 0}), sine, cosine);
    const Columns in = columns(triangles(10000));
    std::vector<glm::vec3> b;
    for (std::size_t i = 0; i < in.a.size(); ++i)
        b.push_back(in.a[i] + in.edge1[i]);
    EXPECT_ORACLES(polygonLight(), edgeIntegral, (Budget{0, 1.5e-6}), in.a, b, in.normal);
    EXPECT_ORACLES(polygonLight(), projectedSolidAngle, (Budget{0, kTolerance}), in.a, in.edge1, in.edge2,
                   in.normal);
}

TEST_F(PolygonLightOracles, HorizonPoint) {
    std::vector<glm::vec3> a, b;
    std::vector<float> da, db;
    for (int i = 0; i < 10000; ++i) {
        a.push_back(direction());
        b.push_back(direction());
        da.push_back(0.5f + 0.49f * uniform_(engine_));
        db.push_back(-0.5f + 0.49f * uniform_(engine_));
    }
    EXPECT_ORACLES(polygonLight(), horizonPoint, (Budget{2, 1e-6}), a, b, da, db);
}

}  // namespace
}  // namespace duolux::test

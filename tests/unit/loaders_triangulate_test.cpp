#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <ctime>
#include <numeric>
#include <random>
#include <vector>

#include "host/loaders/clip_ears.h"
#include "host/loaders/triangulate.h"

namespace duolux {
namespace {

using Triangle = std::array<std::uint32_t, 3>;
using Polygon = std::vector<glm::vec3>;

glm::dvec3 doubleArea(const Polygon& p, const Triangle& t) {
    const glm::dvec3 a(p[t[0]]);
    return glm::cross(glm::dvec3(p[t[1]]) - a, glm::dvec3(p[t[2]]) - a);
}

/// Shoelace formula, for polygons in the plane z = 0.
double doubleArea(const Polygon& p) {
    double sum = 0.0;
    for (std::size_t i = 0; i < p.size(); ++i) {
        const glm::dvec3 a(p[i]), b(p[(i + 1) % p.size()]);
        sum += a.x * b.y - a.y * b.x;
    }
    return sum;
}

/// Expects n - 2 triangles that face +z and whose areas add up to the polygon's, so that they tile it.
void expectTiling(const Polygon& polygon) {
    std::vector<Triangle> triangles;
    triangulate(polygon, triangles);
    ASSERT_EQ(triangles.size(), polygon.size() - 2);
    double sum = 0.0;
    for (const Triangle& triangle : triangles) {
        const double area = doubleArea(polygon, triangle).z;
        EXPECT_GE(area, 0.0) << triangle[0] << ' ' << triangle[1] << ' ' << triangle[2];
        sum += area;
    }
    EXPECT_NEAR(sum, doubleArea(polygon), 1e-5 * sum);
}

TEST(Triangulate, TriangleAndConvexPolygons) {
    expectTiling({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
    expectTiling({{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 1, 0}});
    Polygon circle;
    for (int i = 0; i < 24; ++i)
        circle.emplace_back(std::cos(i * 0.2618), std::sin(i * 0.2618), 0.0);
    expectTiling(circle);
}

/// The triangles of a fan are as long as the polygon: their sides add up to about 2.5 n radii. Cutting off
/// every second corner adds less than the circumference in each of log2 n rounds.
TEST(Triangulate, ConvexPolygonsOfManyCornersHaveFewLongTriangles) {
    for (const std::size_t count : {32u, 33u, 47u, 64u, 1000u, 4097u}) {
        Polygon circle;
        for (std::size_t i = 0; i < count; ++i) {
            const double angle = 6.283185307179586 * static_cast<double>(i) / static_cast<double>(count);
            circle.emplace_back(std::cos(angle), std::sin(angle), 0.0);
        }
        expectTiling(circle);
        std::vector<Triangle> triangles;
        triangulate(circle, triangles);
        double sides = 0.0;
        for (const Triangle& t : triangles) {
            for (std::size_t k = 0; k < 3; ++k)
                sides += static_cast<double>(glm::distance(circle[t[k]], circle[t[(k + 1) % 3]]));
        }
        EXPECT_LT(sides, 2.0 * 6.2832 * (std::log2(static_cast<double>(count)) + 1.0)) << count;
        // Rounding makes some corners of a circle concave, so that its ears are clipped.
        std::vector<glm::dvec2> dented(circle.begin(), circle.end());
        dented[1] = 0.5 * (dented[0] + dented[2]) - 1e-9 * dented[1];
        triangles.clear();
        clipEars(dented, triangles);
        sides = 0.0;
        for (const Triangle& t : triangles) {
            for (std::size_t k = 0; k < 3; ++k)
                sides += glm::distance(dented[t[k]], dented[t[(k + 1) % 3]]);
        }
        EXPECT_LT(sides, 4.0 * 6.2832 * (std::log2(static_cast<double>(count)) + 1.0)) << count;
    }
}

TEST(Triangulate, ConcaveQuadrilateralFromEachCorner) {
    const Polygon dart{{0, 0, 0}, {2, 0, 0}, {0.5f, 0.5f, 0}, {0, 2, 0}};  // the inner corner is (0.5, 0.5)
    for (std::size_t turn = 0; turn < 4; ++turn) {
        Polygon turned = dart;
        std::rotate(turned.begin(), turned.begin() + static_cast<std::ptrdiff_t>(turn), turned.end());
        expectTiling(turned);
    }
}

TEST(Triangulate, QuadrilateralTakesTheShorterDiagonal) {
    std::vector<Triangle> triangles;
    triangulate(Polygon{{0, -1, 0}, {3, 0, 0}, {0, 1, 0}, {-3, 0, 0}}, triangles);
    EXPECT_EQ(triangles, (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}}));
    triangles.clear();
    triangulate(Polygon{{3, 0, 0}, {0, 1, 0}, {-3, 0, 0}, {0, -1, 0}}, triangles);
    EXPECT_EQ(triangles, (std::vector<Triangle>{{0, 1, 3}, {1, 2, 3}}));
}

TEST(Triangulate, ConcavePolygons) {
    expectTiling({{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}, {1, 2, 0}, {0, 2, 0}});  // L
    expectTiling(
        {{0, 0, 0}, {5, 0, 0}, {5, 3, 0}, {4, 3, 0}, {4, 1, 0}, {1, 1, 0}, {1, 3, 0}, {0, 3, 0}});  // U
    Polygon star;
    for (int i = 0; i < 14; ++i) {
        const double radius = i % 2 == 0 ? 1.0 : 0.3;
        const double angle = i * 3.14159265358979 / 7;
        star.emplace_back(radius * std::cos(angle), radius * std::sin(angle), 0.0);
    }
    expectTiling(star);
    Polygon comb;
    for (int i = 0; i < 50; ++i)
        comb.emplace_back(i, i % 2 == 0 ? 0.1f : 5.0f, 0);
    comb.emplace_back(49, -1, 0);
    comb.emplace_back(0, -1, 0);
    std::reverse(comb.begin(), comb.end());
    expectTiling(comb);
}

TEST(Triangulate, RandomStarShapedPolygons) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> radius(0.1, 1.0);
    for (int round = 0; round < 200; ++round) {
        const int corners = 5 + round % 20;
        Polygon polygon;
        for (int i = 0; i < corners; ++i) {
            const double r = radius(random);
            const double angle = 2 * 3.14159265358979 * i / corners;
            polygon.emplace_back(r * std::cos(angle), r * std::sin(angle), 0.0);
        }
        expectTiling(polygon);
    }
}

/// Ear clipping by its definition, in cubic time.
std::vector<Triangle> clipByDefinition(const std::vector<glm::dvec2>& points) {
    std::vector<std::uint32_t> ring(points.size());
    std::iota(ring.begin(), ring.end(), 0u);
    const auto turn = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        return turnAt(points[a], points[b], points[c]);
    };
    std::vector<Triangle> triangles;
    for (std::size_t from = 0; ring.size() > 3;) {
        const std::size_t n = ring.size();
        const auto corner = [&](std::size_t i) {
            return Triangle{ring[(i + n - 1) % n], ring[i % n], ring[(i + 1) % n]};
        };
        const auto turnOf = [&](std::size_t i) { return turn(corner(i)[0], corner(i)[1], corner(i)[2]); };
        const auto isEar = [&](std::size_t i) {
            const auto [a, b, c] = corner(i);
            if (turnOf(i) <= 0.0) return false;
            for (std::size_t j = 0; j < n; ++j) {
                const std::uint32_t p = ring[j];
                const bool isCorner =
                    points[p] == points[a] || points[p] == points[b] || points[p] == points[c];
                if (!isCorner && turnOf(j) <= 0.0 && turn(a, b, p) >= 0.0 && turn(b, c, p) >= 0.0 &&
                    turn(c, a, p) >= 0.0)
                    return false;
            }
            return true;
        };
        std::size_t chosen = n;
        for (std::size_t step = 0; step < n && chosen == n; ++step) {
            if (isEar((from + step) % n)) chosen = (from + step) % n;
        }
        for (std::size_t step = 0; step < n && chosen == n; ++step) {
            if (turnOf((from + step) % n) == 0.0) chosen = (from + step) % n;
        }
        if (chosen == n) chosen = from;
        triangles.push_back(corner(chosen));
        ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(chosen));
        from = (chosen + 1) % ring.size();
    }
    triangles.push_back({ring[0], ring[1], ring[2]});
    return triangles;
}

TEST(Triangulate, ClipsEarsAsDefined) {
    std::mt19937 random(11);
    for (int round = 0; round < 600; ++round) {
        // Points of a coarse grid: many are collinear or identical, and polygons cross themselves.
        std::uniform_int_distribution<int> coordinate(0, round % 2 == 0 ? 5 : 1000);
        std::vector<glm::dvec2> points(static_cast<std::size_t>(5 + round % 40));
        for (glm::dvec2& point : points)
            point = glm::dvec2(coordinate(random), coordinate(random));
        // Slanted lines of points, without rounding.
        if (round % 3 == 0) {
            for (glm::dvec2& point : points)
                point = {13 * point.x + point.y, 7 * point.x - 2 * point.y};
        }
        std::vector<Triangle> triangles;
        clipEars(points, triangles);
        ASSERT_EQ(triangles, clipByDefinition(points)) << "round " << round;
    }
}

/// Seconds of CPU time for a polygon with very many corners; checks that it gives n - 2 triangles.
double secondsFor(const Polygon& polygon) {
    std::vector<Triangle> triangles;
    const std::clock_t start = std::clock();
    triangulate(polygon, triangles);
    const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    EXPECT_EQ(triangles.size(), polygon.size() - 2);
    return seconds;
}

TEST(Triangulate, TimeGrowsWithTheCorners) {
    constexpr int kCorners = 50'000;
    constexpr double kMost = 5.0;  // takes 0.1 s; quadratic time would be half a minute
    Polygon wave, comb, spiral, tangle;
    std::mt19937 random(3);
    std::uniform_real_distribution<float> anywhere(0.0f, 1.0f);
    for (int i = 0; i < kCorners; ++i) {
        const double angle = 2 * 3.14159265358979 * i / kCorners;
        const double radius = 1 + 0.05 * std::sin(40 * angle);
        wave.emplace_back(radius * std::cos(angle), radius * std::sin(angle), 0.0);
        comb.emplace_back(kCorners - i, i % 2 == 0 ? 0.1f : 5000.0f, 0);
        const int along = i < kCorners / 2 ? i : kCorners - 1 - i;  // there and back
        const double turn = 0.004 * along, distance = 1 + turn + (i < kCorners / 2 ? 1.0 : 0.0);
        spiral.emplace_back(distance * std::cos(turn), distance * std::sin(turn), 0.0);
        tangle.emplace_back(anywhere(random), anywhere(random), anywhere(random));
    }
    comb.emplace_back(0, -1, 0);
    comb.emplace_back(kCorners, -1, 0);
    EXPECT_LT(secondsFor(wave), kMost);
    EXPECT_LT(secondsFor(comb), kMost);
    EXPECT_LT(secondsFor(spiral), kMost);
    EXPECT_LT(secondsFor(tangle), kMost);
    expectTiling(wave);
}

TEST(Triangulate, LinesAcrossTheAxesTakeNoLonger) {
    constexpr int kCorners = 100'000;
    constexpr double kMost = 3.0;  // takes tenths of a second; axis-parallel boxes take 10 to 50 s
    std::vector<glm::dvec2> zigzag, curve, slope;
    for (int i = 0; i < kCorners; ++i) {
        const double e = i % 2 == 1 ? 0.001 : 0.0, bend = i - kCorners / 2;
        zigzag.emplace_back(i + e, i - e);
        curve.emplace_back(i, i - 1e-9 * bend * bend);
        slope.emplace_back(i + 0.3 * e, 0.37 * i - e - 1e-8 * bend * bend);
    }
    for (std::vector<glm::dvec2>* points : {&zigzag, &curve, &slope}) {
        points->emplace_back(kCorners, points == &curve ? -10 : kCorners + 5);
        if (points != &curve) points->emplace_back(0, kCorners);
        double area = 0.0;
        for (std::size_t i = 0; i < points->size(); ++i)
            area += turnAt({0, 0}, (*points)[i], (*points)[(i + 1) % points->size()]);
        if (area < 0.0) std::reverse(points->begin(), points->end());
        std::vector<Triangle> triangles;
        const std::clock_t start = std::clock();
        clipEars(*points, triangles);
        EXPECT_LT(static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC, kMost);
        double sum = 0.0;
        for (const auto& [a, b, c] : triangles)
            sum += turnAt((*points)[a], (*points)[b], (*points)[c]);
        EXPECT_NEAR(sum, std::abs(area), 1e-6 * std::abs(area));
    }
}

TEST(Triangulate, LongStripsTakeNoLonger) {
    constexpr int kCorners = 50'000, kAlong = kCorners / 2;
    for (const double ripple : {0.0, 1e-4, 0.02}) {
        for (const double angle : {0.0, 0.4}) {
            std::vector<glm::dvec2> strip;
            for (int i = 0; i < kCorners; ++i) {
                const bool back = i >= kAlong;
                const double x = 0.3 * (back ? kCorners - 1 - i : i);
                const double y = ripple * std::sin(0.05 * x) + (back ? 1.0 : 0.0);
                strip.emplace_back(x * std::cos(angle) - y * std::sin(angle),
                                   x * std::sin(angle) + y * std::cos(angle));
            }
            std::vector<Triangle> triangles;
            const std::clock_t start = std::clock();
            clipEars(strip, triangles);
            EXPECT_LT(static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC, 1.0)
                << "10 to 30 s if boxes hold both sides of the strip: " << ripple << ' ' << angle;
            double area = 0.0;
            for (const auto& [a, b, c] : triangles)
                area += turnAt(strip[a], strip[b], strip[c]);
            EXPECT_NEAR(area, 2.0 * 0.3 * (kAlong - 1), 1e-6 * area);
        }
    }
}

TEST(Triangulate, CornersAtTheSamePlacesTakeNoLonger) {
    Polygon polygon;
    for (int i = 0; i < 100'000; ++i)
        polygon.emplace_back(i % 3 == 0, i % 3 == 1, 0);
    EXPECT_LT(secondsFor(polygon), 3.0) << "half a minute if tested one by one";
}

TEST(Triangulate, CollinearCornersAndHolesByABridge) {
    expectTiling({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {2, 2, 0}, {1, 2, 0}, {0, 2, 0}});
    // A square with a square hole, joined by an edge that is walked twice.
    expectTiling({{0, 0, 0},
                  {3, 0, 0},
                  {3, 3, 0},
                  {0, 3, 0},
                  {0, 0, 0},
                  {1, 1, 0},
                  {1, 2, 0},
                  {2, 2, 0},
                  {2, 1, 0},
                  {1, 1, 0}});
}

TEST(Triangulate, AnyOrientationInSpaceKeepsTheWinding) {
    const Polygon flat{{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}, {1, 2, 0}, {0, 2, 0}};
    const glm::mat3 turns[] = {{{0, 1, 0}, {0, 0, 1}, {1, 0, 0}},
                               {{0, 0, 1}, {1, 0, 0}, {0, 1, 0}},
                               {{-1, 0, 0}, {0, 1, 0}, {0, 0, -1}},
                               {{0.6f, 0.8f, 0}, {-0.8f, 0.6f, 0}, {0, 0, 1}}};
    for (const glm::mat3& turn : turns) {
        Polygon polygon;
        for (const glm::vec3& corner : flat)
            polygon.push_back(turn * corner);
        const glm::dvec3 front(turn * glm::vec3(0, 0, 1));
        std::vector<Triangle> triangles;
        triangulate(polygon, triangles);
        double sum = 0.0;
        for (const Triangle& triangle : triangles) {
            const double area = glm::dot(doubleArea(polygon, triangle), front);
            EXPECT_GT(area, 0.0);
            sum += area;
        }
        EXPECT_NEAR(sum, 6.0, 1e-6);
    }
}

TEST(Triangulate, PolygonsWithoutAnAnswerStillGiveTriangles) {
    for (const Polygon& polygon :
         {Polygon(6, glm::vec3(1.0f)), Polygon{{0, 0, 0}, {2, 2, 0}, {2, 0, 0}, {0, 2, 0}, {1, 5, 0}},
          Polygon{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {4, 0, 0}}}) {
        std::vector<Triangle> triangles;
        triangulate(polygon, triangles);
        EXPECT_EQ(triangles.size(), polygon.size() - 2);
    }
}

}  // namespace
}  // namespace duolux

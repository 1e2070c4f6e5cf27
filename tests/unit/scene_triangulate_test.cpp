#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "host/scene/triangulate.h"

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

/// n - 2 triangles that all face along +z and whose areas add up to the polygon's: then they tile it.
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

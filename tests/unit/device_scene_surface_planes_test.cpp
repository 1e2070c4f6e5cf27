#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "host/device_scene/coincident.h"
#include "host/device_scene/surface_planes.h"

namespace duolux {
namespace {

/// Quadrilaterals and triangles, rotated and moved so that nothing is axis-parallel.
class CoincidentGroups : public testing::Test {
  protected:
    std::uint32_t triangle(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
        const auto first = static_cast<std::uint32_t>(scene_.geometry.positions.size());
        for (const glm::dvec3& p : {a, b, c})
            scene_.geometry.positions.emplace_back(size_ * (turn_ * p + offset_));
        scene_.geometry.triangles.emplace_back(first, first + 1, first + 2);
        scene_.geometry.materials.push_back(material_);
        return static_cast<std::uint32_t>(scene_.geometry.triangles.size()) - 1;
    }
    /// A square of two triangles in the plane z = height that faces up, or down if `turned`.
    std::uint32_t quad(double x, double y, double width, double height, bool turned = false) {
        const glm::dvec3 a(x, y, height), b(x + width, y, height), c(x + width, y + width, height),
            d(x, y + width, height);
        triangle(a, turned ? c : b, turned ? b : c);
        return triangle(a, turned ? d : c, turned ? c : d) - 1;
    }
    std::vector<std::uint32_t> groups() const { return coincidentGroups(scene_.geometry); }

    double size_ = 1.0;
    glm::dvec3 offset_{0.7, -0.3, 0.9};
    glm::dmat3 turn_ = glm::dmat3(0.6, 0.8, 0.0, -0.64, 0.48, 0.6, 0.48, -0.36, 0.8);
    std::uint32_t material_ = 0;
    LoadedScene scene_;
};

TEST_F(CoincidentGroups, NeighboursAreNone) {
    for (int i = 0; i < 8; ++i) {
        for (int k = 0; k < 8; ++k)
            quad(i, k, 1.0, 0.0);
    }
    quad(0.0, 0.0, 1.0, 1.0);   // above
    quad(20.0, 0.0, 1.0, 0.0);  // in the plane, elsewhere
    EXPECT_TRUE(groups().empty());
}

TEST_F(CoincidentGroups, CopiesOfBothWindingsAndSizes) {
    for (const double size : {1e-6, 1.0, 1e5}) {
        for (const bool turned : {false, true}) {
            scene_ = {};
            size_ = size;
            quad(0.0, 0.0, 1.0, 0.0);
            quad(0.0, 0.0, 1.0, 0.0, turned);
            quad(0.0, 0.0, 1.0, 0.5);
            const std::vector<std::uint32_t> found = groups();
            ASSERT_EQ(found.size(), 6u);
            EXPECT_EQ(found[0], found[2]);
            EXPECT_EQ(found[1], found[3]);
            EXPECT_EQ(found[4], 4u);
            EXPECT_EQ(found[5], 5u);
        }
    }
}

// A decal that shares no corner with the wall and overlaps both of its triangles.
TEST_F(CoincidentGroups, ADecalHasThePlaneOfTheWall) {
    const std::uint32_t wall = quad(0.0, 0.0, 10.0, 0.0);
    const std::uint32_t decal = quad(4.3, 4.8, 1.0, 0.0);
    quad(4.3, 4.8, 1.0, 0.01);
    const std::vector<std::uint32_t> found = groups();
    ASSERT_FALSE(found.empty());
    for (const std::uint32_t i : {wall, wall + 1, decal, decal + 1})
        EXPECT_EQ(found[i], found[wall]);
    EXPECT_LE(found[wall], wall + 1) << "the plane is that of the larger one";
    EXPECT_EQ(found[4], 4u);
}

// A wall of many tiles with one decal; and a whole wall that exists twice.
TEST_F(CoincidentGroups, AmongManyTilesOfOnePlane) {
    for (int i = 0; i < 100; ++i) {
        for (int k = 0; k < 100; ++k)
            quad(i, k, 1.0, 0.0);
    }
    const std::uint32_t decal = quad(50.3, 20.4, 0.2, 0.0);
    const std::vector<std::uint32_t> found = groups();
    ASSERT_FALSE(found.empty());
    EXPECT_EQ(std::ranges::count_if(found, [&, i = 0u](std::uint32_t group) mutable { return group != i++; }),
              3)
        << "the decal, and the tile's other half";
    EXPECT_EQ(found[decal] / 2, (50u * 100u + 20u));
    EXPECT_EQ(found[decal + 1] / 2, (50u * 100u + 20u));

    for (int i = 0; i < 100; ++i) {
        for (int k = 0; k < 100; ++k)
            quad(i, k, 1.0, 0.0, true);
    }
    const std::vector<std::uint32_t> twice = groups();
    for (std::uint32_t i = 0; i < 20000; i += 997)
        EXPECT_EQ(twice[i], twice[20002 + i]) << i;
}

// Slender triangles, whose boxes overlap; and a second layer of other slices.
TEST_F(CoincidentGroups, OfSlendersOnlyThoseThatOverlap) {
    constexpr int kCorners = 3000;
    const auto corner = [](int i) {
        const double angle = i * (2.0 * 3.14159265358979 / kCorners);
        return glm::dvec3(std::cos(angle), std::sin(angle), 0.0);
    };
    const auto addFan = [&](const glm::dvec3& centre) {
        for (int i = 0; i < kCorners; ++i)
            triangle(centre, corner(i), corner(i + 1));
    };
    addFan(glm::dvec3(0.0));
    EXPECT_TRUE(groups().empty());
    // Exactly in one plane, of which rounding leaves slender triangles otherwise.
    turn_ = glm::dmat3(1.0);
    scene_ = {};
    addFan(glm::dvec3(0.0));
    EXPECT_TRUE(groups().empty());
    const std::uint32_t copy = triangle(glm::dvec3(0.0), corner(100), corner(101));
    const std::uint32_t bridge = triangle(glm::dvec3(0.5, 0.5, 0.0), corner(200), corner(202));
    const std::vector<std::uint32_t> found = groups();
    ASSERT_FALSE(found.empty());
    EXPECT_EQ(found[copy], found[100]);
    EXPECT_EQ(found[bridge], found[220]);
    EXPECT_EQ(found[bridge], found[360]);
    EXPECT_NE(found[bridge], found[100]);
    EXPECT_EQ(found[2000], 2000u);
    scene_ = {};
    addFan(glm::dvec3(0.0));
    addFan(glm::dvec3(0.01, 0.0, 0.0));
    const std::vector<std::uint32_t> both = groups();
    EXPECT_EQ(std::set(both.begin(), both.end()).size(), 2u) << "the line through the centres parts them";
}

// Planes on the border between two cells of a grid, which rounding puts in one or the other.
TEST_F(CoincidentGroups, WhereRoundingPartsPlanes) {
    for (int cell = 100; cell < 900; cell += 20) {
        const double x = (cell + 0.75) / 4096.0, rest = std::sqrt(1.0 - x * x);
        const glm::dvec3 normal(x, 0.6 * rest, 0.8 * rest), side(0.0, 0.8, -0.6);
        scene_ = {};
        turn_ = glm::dmat3(glm::cross(side, normal), side, normal);
        const std::uint32_t wall = quad(0.0, 0.0, 10.0, 0.0);
        const std::uint32_t decal = quad(4.6, 4.5, 1.0, 0.0);
        const std::vector<std::uint32_t> found = groups();
        ASSERT_FALSE(found.empty()) << cell;
        for (const std::uint32_t i : {decal, decal + 1})
            EXPECT_LE(found[i], wall + 1) << cell;
    }
}

TEST_F(CoincidentGroups, CurvedSurfacesAreNone) {
    for (int i = 0; i < 200; ++i) {
        for (int k = 0; k < 100; ++k) {
            const auto at = [&](int u, int v) {
                const double theta = 0.1 + 0.029 * v, phi = 0.0314159 * u;
                return glm::dvec3(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi),
                                  std::cos(theta));
            };
            triangle(at(i, k), at(i, k + 1), at(i + 1, k));
        }
    }
    EXPECT_TRUE(groups().empty());
}

TEST_F(CoincidentGroups, PlanesAreOneToTheBit) {
    const std::uint32_t ceiling = quad(0.0, 0.0, 10.0, 0.0);
    const std::uint32_t lamp = quad(2.0, 1.0, 1.0, 0.0), turned = quad(6.0, 5.5, 1.0, 0.0, true);
    const std::uint32_t apart = quad(0.0, 0.0, 1.0, 3.0);
    const SurfacePlanes planes(scene_.geometry);
    ASSERT_TRUE(planes.used());
    EXPECT_EQ(planes.planeOf(lamp), planes.planeOf(ceiling));
    EXPECT_EQ(planes.planeOf(turned), -planes.planeOf(ceiling));
    EXPECT_TRUE(planes.coincident(ceiling) || planes.coincident(ceiling + 1));
    EXPECT_TRUE(planes.coincident(lamp));
    EXPECT_FALSE(planes.coincident(apart));
    const glm::dvec4 plane(planes.planeOf(apart));
    for (int k = 0; k < 3; ++k) {
        const glm::dvec3 p(scene_.geometry.positions[scene_.geometry.triangles[apart][k]]);
        EXPECT_NEAR(glm::dot(glm::dvec3(plane), p), plane.w, 1e-6);
    }
}

TEST_F(CoincidentGroups, PlanesAreUsedWhereTrianglesReachFar) {
    offset_ = glm::dvec3(0.0);
    quad(0.0, 0.0, 1.0, 0.5);
    quad(-20.0, -20.0, 40.0, 0.0);
    EXPECT_FALSE(SurfacePlanes(scene_.geometry).used());
    quad(-1000.0, -1000.0, 2000.0, -1.0);
    EXPECT_TRUE(SurfacePlanes(scene_.geometry).used());
}

}  // namespace
}  // namespace duolux

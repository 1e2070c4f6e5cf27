#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <random>
#include <set>

#include "host/bvh/pairs.h"
#include "host/generators/icosphere.h"

namespace duolux {
namespace {

using testing::ElementsAre;

std::vector<TrianglePair> pairAll(const Geometry& geometry) {
    return pairTriangles(geometry, allTriangles(geometry));
}

/// A plane of squares, each cut into two triangles.
Geometry grid(std::uint32_t squares) {
    Geometry geometry;
    for (std::uint32_t y = 0; y <= squares; ++y) {
        for (std::uint32_t x = 0; x <= squares; ++x)
            geometry.positions.emplace_back(x, y, 0.0f);
    }
    for (std::uint32_t y = 0; y < squares; ++y) {
        for (std::uint32_t x = 0; x < squares; ++x) {
            const std::uint32_t at = y * (squares + 1) + x, above = at + squares + 1;
            geometry.triangles.push_back({at, at + 1, above + 1});
            geometry.triangles.push_back({at, above + 1, above});
        }
    }
    return geometry;
}

TEST(Pairs, AreTheHalvesOfSquares) {
    Geometry geometry = grid(20);
    std::vector<TrianglePair> pairs = pairAll(geometry);
    ASSERT_EQ(pairs.size(), 400u);
    for (std::uint32_t i = 0; i < 400; ++i)
        EXPECT_EQ(pairs[i], (TrianglePair{2 * i, 2 * i + 1}));
    // The same for any order of triangles and any first corner.
    std::mt19937 engine(3);
    std::shuffle(geometry.triangles.begin(), geometry.triangles.end(), engine);
    for (std::size_t i = 0; i < geometry.triangles.size(); i += 3) {
        glm::uvec3& t = geometry.triangles[i];
        t = {t.y, t.z, t.x};
    }
    pairs = pairAll(geometry);
    EXPECT_EQ(pairs.size(), 400u);
    for (const TrianglePair& pair : pairs) {
        glm::vec3 lower(1e9f), upper(-1e9f);
        const PairCorners corners = cornersOf(geometry, pair).value();
        for (const std::uint32_t corner : corners.positions) {
            lower = glm::min(lower, geometry.positions[corner]);
            upper = glm::max(upper, geometry.positions[corner]);
        }
        EXPECT_EQ(upper - lower, glm::vec3(1.0f, 1.0f, 0.0f));
    }
}

/// For all pairs, all corners of both triangles are present, in order.
void expectCorners(const Geometry& geometry, const std::vector<TrianglePair>& pairs) {
    std::multiset<std::uint32_t> seen;
    for (const TrianglePair& pair : pairs) {
        const PairCorners corners = cornersOf(geometry, pair).value();
        const auto& p = corners.positions;
        const glm::uvec3 first{p[0], p[1], p[2]}, second{p[3], p[2], p[1]};
        const glm::uvec3 a = geometry.triangles[pair.first];
        seen.insert(pair.first);
        for (std::uint32_t k = 0; k < 3; ++k)
            EXPECT_EQ(first[static_cast<int>(k)], a[static_cast<int>((corners.turns[0] + k) % 3)]);
        if (pair.isSingle()) {
            EXPECT_EQ(p[3], p[1]) << "a degenerate triangle, which nothing hits";
            continue;
        }
        seen.insert(pair.second);
        const glm::uvec3 b = geometry.triangles[pair.second];
        for (std::uint32_t k = 0; k < 3; ++k)
            EXPECT_EQ(second[static_cast<int>(k)], b[static_cast<int>((corners.turns[1] + k) % 3)]);
    }
    std::multiset<std::uint32_t> all;
    for (std::uint32_t i = 0; i < geometry.triangles.size(); ++i)
        all.insert(i);
    EXPECT_EQ(seen, all);
}

TEST(Pairs, OfAClosedMeshAreNearlyAll) {
    const Icosphere icosphere = makeIcosphere(20);
    Geometry geometry;
    geometry.positions.assign(icosphere.positions.begin(), icosphere.positions.end());
    geometry.triangles = icosphere.triangles;
    std::mt19937 engine(5);
    for (glm::uvec3& t : geometry.triangles) {
        for (std::uint32_t turns = engine() % 3; turns > 0; --turns)
            t = {t.y, t.z, t.x};
    }
    const std::vector<TrianglePair> pairs = pairAll(geometry);
    expectCorners(geometry, pairs);
    EXPECT_LT(static_cast<double>(pairs.size()), 0.6 * static_cast<double>(geometry.triangles.size()));
}

TEST(Pairs, AreNotMadeWhereTwoBoxesAreSmallerThanOne) {
    Geometry geometry;
    geometry.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    // Two triangles at a right angle, whose boxes have no volume.
    geometry.triangles = {{0, 1, 2}, {1, 0, 3}};
    EXPECT_THAT(pairAll(geometry), ElementsAre(TrianglePair{0}, TrianglePair{1}));
    // Both in one plane.
    geometry.positions[3] = {1, -1, 0};
    EXPECT_THAT(pairAll(geometry), ElementsAre(TrianglePair{0, 1}));
}

TEST(Pairs, RunAlongTheirEdgeInOppositeDirections) {
    Geometry geometry;
    geometry.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, -1, 0}};
    geometry.triangles = {{0, 1, 2}, {0, 1, 3}};
    EXPECT_THAT(pairAll(geometry), ElementsAre(TrianglePair{0}, TrianglePair{1}));
    EXPECT_FALSE(cornersOf(geometry, {0, 1}).has_value());
    // Of three triangles at an edge, two are a pair.
    geometry.triangles = {{0, 1, 2}, {1, 0, 3}, {0, 1, 2}};
    EXPECT_THAT(pairAll(geometry), ElementsAre(TrianglePair{0, 1}, TrianglePair{2}));
    expectCorners(geometry, pairAll(geometry));
}

TEST(Pairs, OfDegenerateTriangles) {
    Geometry geometry;
    geometry.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    geometry.triangles = {{0, 0, 0}, {0, 0, 1}, {0, 1, 0}, {0, 1, 2}, {1, 0, 0}, {2, 1, 0}, {0, 1, 2}};
    expectCorners(geometry, pairAll(geometry));
}

// Takes tens of milliseconds; seconds if each triangle is compared with all others at the centre.
TEST(Pairs, OfAFanAreNeighbours) {
    constexpr std::uint32_t kCount = 100'000;
    Geometry geometry;
    geometry.positions.emplace_back(0.0f);
    for (std::uint32_t i = 0; i < kCount; ++i) {
        const double angle = i * (6.283185307179586 / kCount);
        geometry.positions.emplace_back(std::cos(angle), std::sin(angle), 0.0f);
        geometry.triangles.push_back({0, i + 1, (i + 1) % kCount + 1});
    }
    const std::clock_t start = std::clock();
    const std::vector<TrianglePair> pairs = pairAll(geometry);
    EXPECT_LT(static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC, 1.0);
    EXPECT_LE(pairs.size(), kCount / 2 + 2);
    expectCorners(geometry, pairs);
    for (const TrianglePair& pair : pairs) {
        if (pair.isSingle()) continue;
        const std::uint32_t apart = (pair.second + kCount - pair.first) % kCount;
        EXPECT_TRUE(apart == 1 || apart == kCount - 1);
    }
}

TEST(Pairs, OfSomeTrianglesAreAmongThose) {
    const Geometry geometry = grid(2);
    const std::vector<std::uint32_t> some{1, 2, 3, 6};
    EXPECT_THAT(pairTriangles(geometry, some),
                ElementsAre(TrianglePair{1}, TrianglePair{2, 3}, TrianglePair{6}));
}

}  // namespace
}  // namespace duolux

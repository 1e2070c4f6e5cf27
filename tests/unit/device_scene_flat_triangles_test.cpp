#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <set>
#include <utility>

#include "host/device_scene/flat_triangles.h"

namespace duolux {
namespace {

using Corners = std::array<glm::dvec2, 3>;
using Pairs = std::set<std::pair<std::uint32_t, std::uint32_t>>;

double cross(const glm::dvec2& a, const glm::dvec2& b) {
    return a.x * b.y - a.y * b.x;
}

/// Area of the intersection, by clipping one triangle at the edges of the other (Sutherland and Hodgman
/// 1974).
double commonArea(const Corners& a, Corners b) {
    if (cross(b[1] - b[0], b[2] - b[0]) < 0.0) std::swap(b[1], b[2]);
    std::vector<glm::dvec2> polygon(a.begin(), a.end());
    for (std::size_t e = 0; e < 3; ++e) {
        const glm::dvec2 from = b[e], edge = b[(e + 1) % 3] - from;
        std::vector<glm::dvec2> inside;
        for (std::size_t i = 0; i < polygon.size(); ++i) {
            const glm::dvec2 p = polygon[i], q = polygon[(i + 1) % polygon.size()];
            const double leftP = cross(edge, p - from), leftQ = cross(edge, q - from);
            if (leftP >= 0.0) inside.push_back(p);
            if ((leftP < 0.0) != (leftQ < 0.0)) inside.push_back(p + (q - p) * (leftP / (leftP - leftQ)));
        }
        polygon = std::move(inside);
    }
    double doubled = 0.0;
    for (std::size_t i = 2; i < polygon.size(); ++i)
        doubled += cross(polygon[i - 1] - polygon[0], polygon[i] - polygon[0]);
    return 0.5 * std::abs(doubled);
}

class FlatTriangles : public testing::Test {
  protected:
    void add(const Corners& corners, double height = 0.0) {
        FlatTriangle f;
        f.corners = corners;
        f.lower = glm::min(corners[0], glm::min(corners[1], corners[2]));
        f.upper = glm::max(corners[0], glm::max(corners[1], corners[2]));
        f.lowest = f.highest = height;
        f.triangle = static_cast<std::uint32_t>(triangles_.size());
        f.doubleArea = std::abs(cross(corners[1] - corners[0], corners[2] - corners[0]));
        triangles_.push_back(f);
    }
    glm::dvec2 random(double size) {
        std::uniform_real_distribution<double> number(-size, size);
        const double x = number(generator_);
        return {x, number(generator_)};
    }
    static glm::dvec2 onCircle(double turns) {
        const double angle = 2.0 * std::numbers::pi * turns;
        return {std::cos(angle), std::sin(angle)};
    }
    /// The pairs that are compared, the smaller number first; unites those that overlap if `unite` is true.
    Pairs compared(bool unite) {
        DisjointSets sets(triangles_.size());
        Pairs pairs;
        compareOverlapping(triangles_, 1e-9, 1e-6, sets, [&](const FlatTriangle& a, const FlatTriangle& b) {
            EXPECT_GT(a.triangle, b.triangle);
            EXPECT_TRUE(pairs.emplace(b.triangle, a.triangle).second) << "compared twice";
            if (unite && a.lowest == b.lowest && commonArea(a.corners, b.corners) > 1e-12)
                sets.unite(a.triangle, b.triangle);
        });
        roots_.clear();
        for (std::uint32_t i = 0; i < triangles_.size(); ++i)
            roots_.insert(sets.rootOf(i));
        return pairs;
    }

    std::mt19937 generator_{7};
    std::vector<FlatTriangle> triangles_;
    std::set<std::uint32_t> roots_;  ///< of the sets, after compared()
};

TEST_F(FlatTriangles, EveryPairThatOverlapsIsCompared) {
    for (const double width : {0.002, 0.1, 1.0}) {  // needles to triangles as wide as long
        triangles_.clear();
        for (int i = 0; i < 600; ++i) {
            const glm::dvec2 at = random(1.0), along = random(0.3);
            add({at, at + along, at + 0.5 * along + width * random(0.3)});
        }
        const Pairs pairs = compared(false);
        std::size_t overlapping = 0;
        for (std::uint32_t i = 0; i < triangles_.size(); ++i) {
            for (std::uint32_t j = i + 1; j < triangles_.size(); ++j) {
                if (commonArea(triangles_[i].corners, triangles_[j].corners) <= 1e-12) continue;
                ++overlapping;
                EXPECT_TRUE(pairs.contains({i, j})) << width << ": " << i << ", " << j;
            }
        }
        EXPECT_GT(overlapping, 1000u);
        EXPECT_LT(pairs.size(), 20 * overlapping);
    }
}

TEST_F(FlatTriangles, FansAndSlicesOfAPolygonCompareOnlyNeighbours) {
    constexpr int kCorners = 20000;
    for (int i = 0; i < kCorners; ++i)
        add({glm::dvec2(0.0), onCircle(i / double(kCorners)), onCircle((i + 1) / double(kCorners))});
    EXPECT_LT(compared(false).size(), 20u * kCorners);
    // The same polygon in slices, all of which are as long as it is wide.
    triangles_.clear();
    for (int i = 1; i < kCorners / 2; ++i) {
        const glm::dvec2 above = onCircle(0.1 + i / double(kCorners)),
                         below = onCircle(0.1 - i / double(kCorners));
        add({above, below, onCircle(0.1 + (i + 1) / double(kCorners))});
        add({below, onCircle(0.1 + (i + 1) / double(kCorners)), onCircle(0.1 - (i + 1) / double(kCorners))});
    }
    EXPECT_LT(compared(false).size(), 20u * kCorners);
}

TEST_F(FlatTriangles, ThoseThatAreUnitedAreNotComparedAgain) {
    constexpr int kCount = 20000;
    for (int i = 0; i < kCount; ++i)
        add({random(1.0), random(1.0), random(1.0)});
    EXPECT_LT(compared(true).size(), 20u * kCount);
    EXPECT_EQ(roots_.size(), 1u);
}

TEST_F(FlatTriangles, ThoseAtOtherHeightsAreNotCompared) {
    constexpr int kCount = 3000;
    for (int i = 0; i < kCount; ++i)
        add({glm::dvec2(0.0), glm::dvec2(1.0, 0.0), glm::dvec2(0.0, 1.0)}, 1e-5 * (i % 1000));
    EXPECT_LT(compared(true).size(), 3u * kCount);
    EXPECT_EQ(roots_.size(), 1000u);
}

}  // namespace
}  // namespace duolux

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <random>

#include "host/bvh/binary_bvh.h"
#include "host/bvh/collapse.h"
#include "host/bvh/pairs.h"
#include "host/cli/temporary_folder.h"
#include "host/generators/two_spheres.h"
#include "host/view/load.h"
#include "shaders/shared/bvh_layout.h"

namespace duolux {
namespace {

using Refs = std::vector<PrimitiveRef>;

/// Exhaustive builder with the surface-area heuristic: tries every split between two centres along every axis
/// (MacDonald, Booth, "Heuristics for ray tracing using space subdivision", 1990).
class FullSweep {
  public:
    explicit FullSweep(Refs refs) : refs_(std::move(refs)) {
        bvh_.nodes.reserve(2 * refs_.size() - 1);
        build(0, refs_.size());
    }
    const BinaryBvh& bvh() const { return bvh_; }

  private:
    void sortAlong(int axis, std::size_t begin, std::size_t end) {
        const auto at = [this](std::size_t i) { return refs_.begin() + static_cast<std::ptrdiff_t>(i); };
        std::sort(at(begin), at(end), [axis](const PrimitiveRef& a, const PrimitiveRef& b) {
            const float ca = a.lower[axis] + a.upper[axis];
            const float cb = b.lower[axis] + b.upper[axis];
            return ca != cb ? ca < cb : a.primitive < b.primitive;
        });
    }

    /// The best number of primitives for the left side, and its cost.
    std::pair<std::size_t, double> bestSplit(std::size_t begin, std::size_t end) const {
        const std::size_t count = end - begin;
        std::vector<double> rightCost(count);
        Aabb right;
        for (std::size_t i = count; i-- > 1;) {
            right.grow({refs_[begin + i].lower, refs_[begin + i].upper});
            rightCost[i] = static_cast<double>(right.halfArea()) * static_cast<double>(count - i);
        }
        std::pair<std::size_t, double> best{0, std::numeric_limits<double>::max()};
        Aabb left;
        for (std::size_t i = 1; i < count; ++i) {
            left.grow({refs_[begin + i - 1].lower, refs_[begin + i - 1].upper});
            const double cost = static_cast<double>(left.halfArea()) * static_cast<double>(i) + rightCost[i];
            if (cost < best.second) best = {i, cost};
        }
        return best;
    }

    void build(std::size_t begin, std::size_t end) {
        const std::size_t node = bvh_.nodes.size();
        bvh_.nodes.emplace_back();
        for (std::size_t i = begin; i < end; ++i)
            bvh_.nodes[node].bounds.grow({refs_[i].lower, refs_[i].upper});
        bvh_.nodes[node].count = static_cast<std::uint32_t>(end - begin);
        bvh_.nodes[node].right = refs_[begin].primitive;
        if (end - begin == 1) return;
        std::pair<std::size_t, double> best{0, std::numeric_limits<double>::max()};
        int bestAxis = 0;
        for (int axis = 0; axis < 3; ++axis) {
            sortAlong(axis, begin, end);
            const auto split = bestSplit(begin, end);
            if (split.second >= best.second) continue;
            best = split;
            bestAxis = axis;
        }
        sortAlong(bestAxis, begin, end);
        build(begin, begin + best.first);
        bvh_.nodes[node].right = static_cast<std::uint32_t>(bvh_.nodes.size());
        build(begin + best.first, end);
    }

    Refs refs_;
    BinaryBvh bvh_;
};

/// Expected node visits and pair tests of a random ray that meets the root, in units of a visit, if subtrees
/// become leaves wherever that is cheaper.
double sahCost(const BinaryBvh& bvh) {
    const auto area = [&](std::uint32_t node) {
        return static_cast<double>(bvh.nodes[node].bounds.halfArea());
    };
    const auto pairCost = static_cast<double>(CollapsePlan::kPairCost);
    const std::function<double(std::uint32_t)> below = [&](std::uint32_t node) {
        const BinaryBvh::Node& n = bvh.nodes[node];
        const double leaf = n.count > shared::kMaxLeafPairs ? std::numeric_limits<double>::max()
                                                            : area(node) * pairCost * n.count;
        return n.count == 1 ? leaf : std::min(leaf, area(node) + below(node + 1) + below(n.right));
    };
    return below(0) / area(0);
}

/// The primitives over which a scene's tree is built.
Refs refsOf(const Geometry& geometry) {
    return boxesOf(geometry, pairTriangles(geometry, allTriangles(geometry)));
}

Refs trianglesOf(const Geometry& geometry) {
    std::vector<TrianglePair> singles;
    for (std::uint32_t i = 0; i < geometry.triangles.size(); ++i)
        singles.push_back({i});
    return boxesOf(geometry, singles);
}

/// Triangles at random points of a cube; `edges` makes two edges from two random points.
template <typename Edges>
Refs soup(int count, Edges&& edges) {
    std::mt19937 engine(11);
    std::uniform_real_distribution<float> uniform(-1.0f, 1.0f);
    const auto point = [&] { return glm::vec3(uniform(engine), uniform(engine), uniform(engine)); };
    Geometry geometry;
    for (int i = 0; i < count; ++i) {
        const glm::vec3 a = point();
        const auto [first, second] = edges(point(), point());
        geometry.positions.insert(geometry.positions.end(), {a, a + first, a + second});
        const auto base = static_cast<std::uint32_t>(3 * i);
        geometry.triangles.push_back({base, base + 1, base + 2});
    }
    return refsOf(geometry);
}

struct Ratios {
    double binary, wide;  ///< costs relative to a full sweep's; `wide`: the tree that is traversed
};

Ratios ratiosToFullSweep(const Refs& refs) {
    const FullSweep sweep(refs);
    Refs reordered = refs;
    const BinaryBvh ours = buildBinaryBvh(reordered, SplitMethod::kBinnedSah);
    return {sahCost(ours) / sahCost(sweep.bvh()),
            CollapsePlan(ours).sahCost() / CollapsePlan(sweep.bvh()).sahCost()};
}

void expectWithin5Percent(const Refs& refs) {
    const Ratios ratios = ratiosToFullSweep(refs);
    EXPECT_LE(ratios.binary, 1.05);
    EXPECT_LE(ratios.wide, 1.05);
}

TEST(SahCost, OfTwoSpheresIsWithin5PercentOfAFullSweep) {
    for (const std::size_t triangles : {3'000u, 20'000u}) {
        SCOPED_TRACE(triangles);
        const TemporaryFolder folder;
        writeTwoSpheres(folder.path(), triangles);
        expectWithin5Percent(refsOf(loadScene(folder / "two_spheres.json").geometry));
    }
}

TEST(SahCost, OfSpotIsWithin5PercentOfAFullSweep) {
    expectWithin5Percent(refsOf(loadScene(DUOLUX_ASSETS "/spot/spot.obj").geometry));
}

/// A sweep cannot separate the walls, which are as large as the room, from the room's contents.
TEST(SahCost, OfAModelInARoomIsLowerThanOfAFullSweep) {
    const Ratios ratios = ratiosToFullSweep(refsOf(loadScene(DUOLUX_ASSETS "/spot/spot.json").geometry));
    EXPECT_LE(ratios.binary, 0.9);
    EXPECT_LE(ratios.wide, 0.9);
}

TEST(SahCost, OfTheCornellBoxIsWithin5PercentOfAFullSweep) {
    expectWithin5Percent(refsOf(loadScene(DUOLUX_ASSETS "/cornell/cornell.json").geometry));
}

TEST(SahCost, OfRandomTrianglesIsWithin5PercentOfAFullSweep) {
    for (const float size : {0.01f, 0.1f, 1.0f}) {
        SCOPED_TRACE(size);
        expectWithin5Percent(
            soup(5000, [&](glm::vec3 u, glm::vec3 v) { return std::pair(size * u, size * v); }));
    }
}

TEST(SahCost, OfLongThinTrianglesIsWithin5PercentOfAFullSweep) {
    expectWithin5Percent(soup(5000, [](glm::vec3 u, glm::vec3 v) { return std::pair(u, u + 0.001f * v); }));
}

TEST(SahCost, OfTrianglesOfVeryDifferentSizesIsWithin5PercentOfAFullSweep) {
    expectWithin5Percent(soup(5000, [](glm::vec3 u, glm::vec3 v) {
        const float size = std::exp2(10.0f * (u.x - 1.0f));
        return std::pair(size * u, size * v);
    }));
}

/// The device only tests pairs, so a single triangle costs as much as a pair.
TEST(SahCost, OfPairsIsLowerThanOfTriangles) {
    const TemporaryFolder folder;
    writeTwoSpheres(folder.path(), 20'000);
    for (const std::filesystem::path& path :
         {folder / "two_spheres.json", std::filesystem::path(DUOLUX_ASSETS "/spot/spot.obj"),
          std::filesystem::path(DUOLUX_ASSETS "/cornell/cornell.json")}) {
        SCOPED_TRACE(path);
        const Geometry geometry = loadScene(path).geometry;
        Refs pairs = refsOf(geometry), triangles = trianglesOf(geometry);
        const BinaryBvh ofPairs = buildBinaryBvh(pairs, SplitMethod::kBinnedSah);
        const BinaryBvh ofTriangles = buildBinaryBvh(triangles, SplitMethod::kBinnedSah);
        EXPECT_LT(CollapsePlan(ofPairs).sahCost(), 0.95 * CollapsePlan(ofTriangles).sahCost());
        EXPECT_LT(pairs.size(), 0.6 * static_cast<double>(triangles.size()));
    }
}

}  // namespace
}  // namespace duolux

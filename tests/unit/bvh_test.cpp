#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "host/bvh/binary_bvh.h"
#include "host/bvh/wide_bvh.h"

namespace duolux {
namespace {

using testing::IsEmpty;

Geometry randomTriangles(int count, float size) {
    std::mt19937 engine(7);
    std::uniform_real_distribution<float> uniform(-1.0f, 1.0f);
    const auto point = [&] { return glm::vec3(uniform(engine), uniform(engine), uniform(engine)); };
    Geometry geometry;
    for (int i = 0; i < count; ++i) {
        const glm::vec3 a = 100.0f * point();
        geometry.positions.insert(geometry.positions.end(), {a, a + size * point(), a + size * point()});
        const auto base = static_cast<std::uint32_t>(3 * i);
        geometry.triangles.push_back({base, base + 1, base + 2});
        geometry.materials.push_back(0);
    }
    return geometry;
}

std::vector<std::string> auditAll(const WideBvh& bvh, const Geometry& geometry) {
    return auditWideBvh(bvh, geometry, allTriangles(geometry));
}

class WideBvhOfSize : public testing::TestWithParam<int> {};

TEST_P(WideBvhOfSize, KeepsItsInvariants) {
    for (float size : {0.0f, 0.01f, 1.0f, 100.0f}) {
        const Geometry geometry = randomTriangles(GetParam(), size);
        EXPECT_THAT(auditAll(buildWideBvh(geometry), geometry), IsEmpty()) << "triangle size " << size;
    }
}

INSTANTIATE_TEST_SUITE_P(Sizes, WideBvhOfSize, testing::Values(1, 2, 3, 4, 7, 8, 9, 64, 1000, 40000));

TEST(WideBvh, OverASubsetHoldsJustThat) {
    const Geometry geometry = randomTriangles(1000, 1.0f);
    const std::vector<std::uint32_t> subset{5, 17, 900, 901, 902, 999};
    const WideBvh bvh = buildWideBvh(geometry, subset);
    EXPECT_THAT(auditWideBvh(bvh, geometry, subset), IsEmpty());
    EXPECT_EQ(bvh.pairs.size(), subset.size()) << "neighbours that are none";
}

TEST(WideBvh, OfCoincidentTriangles) {
    Geometry geometry = randomTriangles(1, 1.0f);
    for (int i = 0; i < 5000; ++i) {
        geometry.triangles.push_back(geometry.triangles[0]);
        geometry.materials.push_back(0);
    }
    EXPECT_THAT(auditAll(buildWideBvh(geometry), geometry), IsEmpty());
}

/// With geometrically growing sizes, each SAH split separates a single triangle.
TEST(WideBvh, OfGeometricallyGrowingTrianglesStaysWithinTheDepthLimit) {
    Geometry geometry;
    for (int i = 0; i < 250; ++i) {
        const float x = std::ldexp(1.0f, i / 2 - 60);
        geometry.positions.insert(geometry.positions.end(), {{x, 0, 0}, {x, x, 0}, {x, 0, x}});
        const auto base = static_cast<std::uint32_t>(3 * i);
        geometry.triangles.push_back({base, base + 1, base + 2});
        geometry.materials.push_back(0);
    }
    const WideBvh bvh = buildWideBvh(geometry);
    EXPECT_THAT(auditAll(bvh, geometry), IsEmpty());
    EXPECT_LE(bvh.depth, shared::kMaxTreeDepth);
}

TEST(WideBvh, DoesNotDependOnHowThreadsInterleave) {
    const Geometry geometry = randomTriangles(60000, 1.0f);
    const WideBvh a = buildWideBvh(geometry);
    const WideBvh b = buildWideBvh(geometry);
    EXPECT_EQ(a.pairs, b.pairs);
    EXPECT_EQ(a.nodes.size(), b.nodes.size());
}

TEST(WideBvh, SahIsBetterThanMedianSplits) {
    // Clusters of very different density, for which the position of splits matters.
    Geometry geometry = randomTriangles(20000, 0.5f);
    for (std::size_t i = 0; i < 30000; ++i)
        geometry.positions[i] *= 0.01f;
    std::vector<PrimitiveRef> refs;
    for (std::uint32_t i = 0; i < geometry.triangles.size(); ++i) {
        const glm::vec3 a = geometry.positions[3 * i], b = geometry.positions[3 * i + 1],
                        c = geometry.positions[3 * i + 2];
        refs.push_back({glm::min(a, glm::min(b, c)), i, glm::max(a, glm::max(b, c)), 0});
    }
    const auto area = [](const BinaryBvh& bvh) {
        double sum = 0.0;
        for (const auto& node : bvh.nodes)
            sum += static_cast<double>(node.bounds.halfArea());
        return sum;
    };
    std::vector<PrimitiveRef> copy = refs;
    EXPECT_LT(area(buildBinaryBvh(refs, SplitMethod::kBinnedSah)),
              area(buildBinaryBvh(copy, SplitMethod::kMedian)));
}

/// The audit detects the errors of a broken builder.
class Audit : public testing::Test {
  protected:
    Geometry geometry_ = randomTriangles(200, 5.0f);
    WideBvh bvh_ = buildWideBvh(geometry_);
};

TEST_F(Audit, FindsAShrunkenBox) {
    for (auto& node : bvh_.nodes) {
        for (std::size_t slot = 0; slot < 8; ++slot) {
            if (node.meta[slot] != 0)
                node.lower[0][slot] = static_cast<std::uint8_t>(node.lower[0][slot] + 20);
        }
    }
    EXPECT_FALSE(auditAll(bvh_, geometry_).empty());
}

TEST_F(Audit, FindsATriangleThatIsMissing) {
    bvh_.pairs[3] = bvh_.pairs[4];
    EXPECT_FALSE(auditAll(bvh_, geometry_).empty());
}

TEST_F(Audit, FindsAWrongChild) {
    bvh_.nodes[0].childBase += 1;
    EXPECT_FALSE(auditAll(bvh_, geometry_).empty());
}

TEST_F(Audit, FindsAWrongMeta) {
    auto& node = bvh_.nodes[0];
    const auto slot =
        std::find_if(std::begin(node.meta), std::end(node.meta), [](std::uint8_t m) { return m != 0; });
    *slot = static_cast<std::uint8_t>(*slot ^ 1);
    EXPECT_FALSE(auditAll(bvh_, geometry_).empty());
}

}  // namespace
}  // namespace duolux

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <numeric>

#include "tests/shader/hand_made_node.h"
#include "tests/shader/oracles.h"
#include "tests/shader/test_meshes.h"
#include "tests/shader/traced_scene.h"
#include "tests/support/device.h"

// Traversal of hand-made trees, NaN, and both oracles.

namespace duolux::test {
namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinite = std::numeric_limits<float>::infinity();

shared::DevicePair single(glm::vec3 a, glm::vec3 b, glm::vec3 c, std::uint32_t primitive) {
    return {a, primitive, b, 0, c, 0, b, kNone};
}

shared::DevicePair planeAt(float z, std::uint32_t primitive) {
    return single({-1, -1, z}, {1, -1, z}, {0, 2, z}, primitive);
}

TEST(Traverse, AnEmptyNodeIsAnEmptyScene) {
    DeviceTree tree;
    tree.nodes.resize(1);
    tree.pairs.push_back(planeAt(1.0f, 0));
    const std::vector<TestRay> rays{{{0, 0, 0}, 0.0f, {0, 0, 1}, kFar},
                                    {{0, 0, 0}, 0.0f, glm::vec3(-0.57735f), kFar}};
    for (const TestHit& hit : trace(traversalOf(tree), rays)) {
        EXPECT_FALSE(hit.found());
        EXPECT_EQ(hit.nodes, 1u);
        EXPECT_EQ(hit.t, kFar);
    }
}

/// Counts the lanes of each subgroup that vote yes: by ballots, and by shuffles with 8 lanes.
TEST(Traverse, LanesAreCounted) {
    const std::uint32_t lanes = device().info().subgroupSize;
    Random random;
    std::vector<std::uint32_t> votes;
    for (std::uint32_t i = 0; i < 256 * lanes; ++i)
        votes.push_back(random.word() % 257 > i / lanes ? 1 : 0);  // from all of a subgroup to none
    DeviceTree tree;
    tree.nodes.resize(1);
    tree.pairs.resize(1);
    for (std::uint32_t byShuffle = 0; byShuffle <= (lanes == 8 ? 1u : 0u); ++byShuffle) {
        const std::vector<std::uint32_t> counts =
            traversalOf(tree)
                .constant(shared::kSpecVoteByShuffle, byShuffle)
                .evaluate<std::uint32_t>("result = laneCount(x0 != 0u);", votes);
        for (std::uint32_t first = 0; first < votes.size(); first += lanes) {
            const auto begin = votes.begin() + first;
            const auto yes = static_cast<std::uint32_t>(std::accumulate(begin, begin + lanes, 0u));
            for (std::uint32_t lane = 0; lane < lanes; ++lane)
                ASSERT_EQ(counts[first + lane], yes) << first << " " << lane << " " << byShuffle;
        }
    }
}

/// A chain of the maximum depth, with another node on the stack at every level and without pruning.
TEST(Traverse, AChainOfTheLargestDepthIsTraversed) {
    const glm::uvec3 lower(0), upper(255);
    DeviceTree tree;
    tree.nodes.resize(2 * shared::kMaxTreeDepth - 1);
    const std::size_t count = tree.nodes.size();
    for (std::uint32_t i = 0; i < count; ++i) {
        shared::WideNode& node = tree.nodes[i];
        for (int axis = 0; axis < 3; ++axis) {
            node.origin[axis] = -64.0f;
            node.exponent[axis] = 127;
        }
        const bool chain = i == 0 || (i % 2 == 1 && i + 2 < count);  // nodes 2k + 1 continue, 2k + 2 wait
        if (chain) {
            node.childBase = i == 0 ? 1 : i + 2;
            setChild(node, 0, innerMeta(0), lower, upper);
            setChild(node, 1, innerMeta(1), lower, upper);
        }
        node.pairBase = i;
        setChild(node, 5, leafMeta(1, 0), lower, upper);
        // Distances that do not grow with the order of visits.
        tree.pairs.push_back(planeAt(1.0f + static_cast<float>(i * 29 % count), i));
    }
    const std::vector<TestRay> rays{{{0.1f, 0.1f, 0.0f}, 0.0f, {0, 0, 1}, kFar},
                                    {{0.1f, 0.1f, 60.0f}, 0.0f, {0, 0, -1}, kFar}};
    const std::vector<TestHit> hits = trace(traversalOf(tree), rays);
    EXPECT_EQ(hits[0].t, 1.0f);
    EXPECT_EQ(hits[0].nodes, count);
    EXPECT_EQ(hits[1].t, 60.0f - static_cast<float>(count));
    EXPECT_EQ(hits[1].nodes, count);
    // Each hit is the first beyond some distance.
    std::vector<TestRay> beyond(count + 1, rays[0]);
    for (std::size_t i = 0; i <= count; ++i)
        beyond[i].tMin = 0.5f + static_cast<float>(i);
    const std::vector<TestHit> next = trace(traversalOf(tree), beyond, {.ordered = 1});
    for (std::size_t i = 0; i < count; ++i)
        EXPECT_FLOAT_EQ(next[i].t, 1.0f + static_cast<float>(i));
    EXPECT_FALSE(next[count].found());
}

/// Two chains of nodes in opposite octants: the farther one is pruned if the nearer one is visited first.
TEST(Traverse, TheNearerOctantIsVisitedFirst) {
    for (int s = 0; s < 8; ++s) {
        const glm::vec3 sign((s & 4) != 0 ? 1 : -1, (s & 2) != 0 ? 1 : -1, (s & 1) != 0 ? 1 : -1);
        DeviceTree tree;
        tree.nodes.resize(5);  // the root, its two children by slot, and a child of each
        for (shared::WideNode& node : tree.nodes) {
            for (int axis = 0; axis < 3; ++axis) {
                node.origin[axis] = -4.0f;
                node.exponent[axis] = 127 - 4;
            }
        }
        tree.nodes[0].childBase = 1;
        for (int slot : {std::min(s, 7 - s), std::max(s, 7 - s)}) {
            const glm::vec3 centre = (slot == s ? 2.0f : -2.0f) * sign;
            const glm::uvec3 lower(16.0f * (centre + 3.0f)), upper(16.0f * (centre + 5.0f));
            const std::uint32_t child = slot < 4 ? 1 : 2;
            setChild(tree.nodes[0], slot, innerMeta(slot), lower, upper);
            tree.nodes[child].childBase = child + 2;
            setChild(tree.nodes[child], 3, innerMeta(3), lower, upper);
            tree.nodes[child + 2].pairBase = child - 1;
            setChild(tree.nodes[child + 2], 6, leafMeta(1, 0), lower, upper);
            tree.pairs.push_back(single(centre + sign * glm::vec3(0.9f, -0.45f, -0.45f),
                                        centre + sign * glm::vec3(-0.45f, 0.9f, -0.45f),
                                        centre + sign * glm::vec3(-0.45f, -0.45f, 0.9f), child));
        }
        const TestRay ray{6.0f * sign, 0.0f, -sign / std::sqrt(3.0f), kFar};
        const TestHit hit = trace(traversalOf(tree), {ray})[0];
        EXPECT_NEAR(hit.t, 4.0f * std::sqrt(3.0f), 1e-5f) << s;
        EXPECT_EQ(hit.nodes, 4u) << s;  // not the child of the farther one
        EXPECT_EQ(trace(traversalOf(tree), {ray}, {.anyHit = 1})[0].nodes, 3u) << s;
    }
}

TEST(Traverse, RaysThatAreNotNumbersEndAndMeetNothing) {
    const TracedScene scene(soup(300, 1.0f));
    std::vector<TestRay> rays;
    for (float bad : {kNaN, -kNaN, kInfinite, -kInfinite}) {
        for (int axis = 0; axis < 3; ++axis) {
            const glm::vec3 d = glm::normalize(glm::vec3(0.3f, -0.5f, 0.7f));
            TestRay ray{{0.1f, 0.2f, 0.3f}, 0.0f, d, kFar};
            ray.origin[axis] = bad;
            rays.push_back(ray);
            ray = {{0.1f, 0.2f, 0.3f}, 0.0f, d, kFar};
            ray.direction[axis] = bad;
            rays.push_back(ray);
        }
    }
    rays.push_back({glm::vec3(kNaN), 0.0f, glm::vec3(kNaN), kFar});
    rays.push_back({glm::vec3(0.0f), 0.0f, glm::vec3(0.0f), kFar});
    for (std::uint32_t mode = 0; mode < 4; ++mode) {
        const std::vector<TestHit> hits = scene.trace(rays, {.anyHit = mode & 1, .ordered = mode >> 1});
        for (std::size_t i = 0; i < rays.size(); ++i) {
            EXPECT_TRUE(!hits[i].found() || std::isfinite(hits[i].t)) << i;
            EXPECT_FALSE(hits[i].found()) << i << " " << hits[i].t;
            EXPECT_LE(hits[i].nodes, scene.tree.nodes.size());
        }
    }
}

/// A triangle with a corner that is not a number is never hit, and hides none of its neighbours.
TEST(Traverse, TrianglesThatAreNotNumbersAreNotHit) {
    DeviceTree tree;
    tree.nodes.resize(1);
    shared::WideNode& node = tree.nodes[0];
    for (int axis = 0; axis < 3; ++axis) {
        node.origin[axis] = -8.0f;
        node.exponent[axis] = 127 - 4;
    }
    setChild(node, 2, leafMeta(3, 0), glm::uvec3(0), glm::uvec3(255));
    for (float bad : {kNaN, kInfinite, -kInfinite}) {
        tree.pairs = {planeAt(1.0f, 0), planeAt(2.0f, 1), planeAt(3.0f, 2)};
        tree.pairs[0].v1.z = bad;
        tree.pairs[2].v2.x = bad;
        for (std::uint32_t ordered = 0; ordered < 2; ++ordered) {
            const TestHit hit =
                trace(traversalOf(tree), {{{0.1f, 0.1f, 0}, 0.0f, {0, 0, 1}, kFar}}, {.ordered = ordered})[0];
            EXPECT_EQ(hit.primitive, 1u);
            EXPECT_FLOAT_EQ(hit.t, 2.0f);
        }
    }
}

}  // namespace

/// A hit as the oracles see it; `t` is in a scene of size 1.
inline std::vector<double> numbers(const TestHit& hit) {
    return numbers(hit.t < kFar ? hit.t : -1.0f, hit.primitive, hit.barycentric);
}
inline TestRay widen(const TestRay& ray) {
    return ray;
}

namespace {

/// Triangles are small relative to their distances, so that single and double precision hit the same ones.
TEST(TraverseOracles, NearestHits) {
    Random random(21);
    Geometry geometry;
    for (int i = 0; i < 200; ++i) {
        const glm::vec3 a = random.inBox(1.0f);
        addTriangle(geometry, a, a + 0.3f * random.direction(), a + 0.3f * random.direction());
        if (i % 2 == 0) addNeighbour(geometry, a + 0.3f * random.direction());
    }
    const TracedScene scene(geometry);
    mirror::Texels& texels = mirror::texels();
    texels.nodes.resize(scene.tree.nodes.size() * shared::kNodeTexels);
    std::memcpy(texels.nodes.data(), scene.tree.nodes.data(), texels.nodes.size() * 16);
    texels.pairs.resize(scene.tree.pairs.size() * shared::kPairTexels);
    std::memcpy(texels.pairs.data(), scene.tree.pairs.data(), texels.pairs.size() * 16);
    std::vector<TestRay> rays;
    for (int i = 0; i < 4000; ++i)
        rays.push_back({random.inBox(1.5f), 0.0f, random.direction(), kFar});
    const auto primitiveOf = [](std::uint32_t triangle) {
        return triangle == kNone ? kNone : mirror::single::fetchTriangle(triangle).primitive;
    };
    const auto single = [&](const TestRay& ray) {
        namespace m = mirror::single;
        m::Traversal r =
            m::traversalStart(0, ray.origin, ray.direction, ray.tMin, ray.afterOrder, ray.tMax, false);
        while (m::traversalAlive(r))
            m::traverse(r, false, 1, 1);
        return TestHit{r.t, r.triangle, primitiveOf(r.triangle), r.barycentric, 0};
    };
    const auto twice = [&](const TestRay& ray) {
        namespace m = mirror::twice;
        m::Traversal r = m::traversalStart(0, glm::dvec3(ray.origin), glm::dvec3(ray.direction),
                                           static_cast<double>(ray.tMin), ray.afterOrder,
                                           static_cast<double>(ray.tMax), false);
        while (m::traversalAlive(r))
            m::traverse(r, false, 1, 1);
        return TestHit{static_cast<float>(r.t), r.triangle, primitiveOf(r.triangle), glm::vec2(r.barycentric),
                       0};
    };
    EXPECT_WITHIN_ORACLES("traverse", scene.trace(rays), Budget{4, 1e-5}, single, twice, rays);
}

TEST(TraverseOracles, BitsAndBytes) {
    Random random;
    std::vector<float> a, b;
    std::vector<std::uint32_t> words;
    for (int i = 0; i < 4096; ++i) {
        a.push_back(std::exp2(random.uniform(-60.0f, 60.0f)));
        b.push_back((i % 3 == 0 ? -1.0f : 1.0f) * std::exp2(random.uniform(-60.0f, 60.0f)));
        words.push_back(random.word());
    }
    DeviceTree tree;
    tree.nodes.resize(1);
    tree.pairs.resize(1);
    const ShaderLibrary library = traversalOf(tree);
    EXPECT_ORACLES(library, bitsMin, (Budget{0, 0}), a, b);
    EXPECT_ORACLES(library, bitsMax, (Budget{0, 0}), a, b);
    EXPECT_ORACLES(library, unpackBytes, (Budget{0, 0}), words);
}

}  // namespace
}  // namespace duolux::test

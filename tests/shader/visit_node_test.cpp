#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "tests/shader/hand_made_node.h"
#include "tests/shader/test_meshes.h"
#include "tests/shader/traced_scene.h"

// Visits of random nodes by random rays, against a double-precision evaluation of the layout in bvh_layout.h.

namespace duolux::test {

/// A node is visited as the next of a group of siblings.
struct Visit {
    TestRay ray;
    std::uint32_t groupBase, groupMask;
};
struct AfterVisit {
    std::uint32_t groupBase, groupMask, pairBase, pairMask, stackSize, nodesLeft, stackBase, stackMask;
};

}  // namespace duolux::test

DUOLUX_GLSL_TYPE(duolux::test::Visit, "Visit",
                 "vec3 origin; float tMin; vec3 direction; float tMax; uint afterOrder; uint groupBase; "
                 "uint groupMask;");
DUOLUX_GLSL_TYPE(
    duolux::test::AfterVisit, "AfterVisit",
    "uint groupBase; uint groupMask; uint pairBase; uint pairMask; uint stackSize; uint nodesLeft; "
    "uint stackBase; uint stackMask;");

namespace duolux::test {
namespace {

shared::WideNode randomNode(Random& random, std::uint32_t index) {
    shared::WideNode node{};
    for (int axis = 0; axis < 3; ++axis) {
        node.origin[axis] = random.uniform(-1.0f, 0.0f);
        node.exponent[axis] = static_cast<std::uint8_t>(127 - 8 + random.word() % 3);
    }
    node.childBase = 1000000 + 8 * index;
    node.pairBase = 2000000 + 24 * index;
    std::uint32_t offset = 0;
    for (int slot = 0; slot < 8; ++slot) {
        glm::uvec3 lower, upper;
        for (int axis = 0; axis < 3; ++axis) {
            lower[axis] = random.word() % 256;
            upper[axis] = std::min(255u, lower[axis] + random.word() % 128);
        }
        const std::uint32_t kind = random.word() % 5;
        if (kind == 0) continue;
        if (kind <= 2) {
            setChild(node, slot, innerMeta(slot), lower, upper);
        } else {
            const std::uint32_t count = 1 + random.word() % shared::kMaxLeafPairs;
            setChild(node, slot, leafMeta(count, offset), lower, upper);
            offset += count;
        }
    }
    return node;
}

enum class Meets { kNo, kPerhaps, kYes };

/// Whether a ray meets a child's box between tMin and tMax. kPerhaps if rounding may decide: 8 roundings of
/// the node's and the ray's coordinates, along the ray, and the relative 6e-7 by which the library extends
/// the interval.
Meets meets(const shared::WideNode& node, int slot, const TestRay& ray) {
    double entry = static_cast<double>(ray.tMin), leave = static_cast<double>(ray.tMax);
    double entrySurely = entry, leaveSurely = leave;
    for (int axis = 0; axis < 3; ++axis) {
        const double unit = std::ldexp(1.0, node.exponent[axis] - 127);
        const double from = static_cast<double>(node.origin[axis]) - static_cast<double>(ray.origin[axis]);
        const double error = 8.0 * 0x1p-24 * (std::abs(from) + 255.0 * unit);
        const double d = static_cast<double>(ray.direction[axis]);
        double near = from + unit * node.lower[axis][slot], far = from + unit * node.upper[axis][slot];
        if (d < 0.0) {
            std::swap(near, far);
            near = -near, far = -far;
        }
        const double speed = std::max(std::abs(d), 1e-20);
        entry = std::max(entry, (near - error) / speed),
        entrySurely = std::max(entrySurely, (near + error) / speed);
        leave = std::min(leave, (far + error) / speed),
        leaveSurely = std::min(leaveSurely, (far - error) / speed);
    }
    if (entrySurely <= leaveSurely) return Meets::kYes;
    return leave < 0.0 || entry > leave * (1.0 + 1e-6) ? Meets::kNo : Meets::kPerhaps;
}

/// Rays from around a node, half of them aimed at one of its children, through all octants.
TestRay randomRay(Random& random, const shared::WideNode& node) {
    TestRay ray{random.inBox(2.0f), random.word() % 3 == 0 ? random.uniform(0.0f, 2.0f) : 0.0f,
                random.direction(), kFar};
    if (random.word() % 2 == 0) {
        glm::vec3 target;
        const int slot = static_cast<int>(random.word() % 8);
        for (int axis = 0; axis < 3; ++axis) {
            const float steps = random.uniform(node.lower[axis][slot], node.upper[axis][slot]);
            target[axis] = node.origin[axis] + std::ldexp(steps, node.exponent[axis] - 127);
        }
        ray.direction = glm::normalize(target - ray.origin);
    }
    if (random.word() % 4 == 0) {
        ray.direction[static_cast<int>(random.word() % 3)] = 0.0f;
        ray.direction = glm::normalize(ray.direction);
    }
    if (random.word() % 3 == 0) ray.tMax = random.uniform(0.5f, 3.0f);
    return ray;
}

TEST(VisitNode, FindsTheChildrenThatARayMeets) {
    constexpr std::uint32_t kNodes = 40000;
    Random random(11);
    DeviceTree tree;
    tree.pairs.resize(1);
    for (std::uint32_t i = 0; i < kNodes; ++i)
        tree.nodes.push_back(randomNode(random, i));
    std::vector<Visit> visits;
    std::vector<std::uint32_t> visited, rest;  // which node comes first, and the group without it
    for (std::uint32_t i = 8; i < kNodes; ++i) {
        const std::uint32_t slots = 1 + random.word() % 255;
        std::uint32_t left = slots & random.word();
        if (left == 0) left = slots;
        // The slot that is visited first has the bits that differ most from those of the ray's octant, the
        // highest bit counting most.
        const TestRay ray = randomRay(random, tree.nodes[i]);
        std::uint32_t octant = 0, best = 0, bestSlot = 0;
        for (int axis = 0; axis < 3; ++axis)
            octant |= ray.direction[axis] < 0.0f ? 0u : 4u >> axis;
        std::uint32_t mask = slots;
        for (std::uint32_t slot = 0; slot < 8; ++slot) {
            if ((left >> slot & 1) == 0) continue;
            const std::uint32_t rank = slot ^ octant;
            mask |= 1u << (24 + rank);
            if (rank >= best) best = rank, bestSlot = slot;
        }
        std::uint32_t before = 0;
        for (std::uint32_t slot = 0; slot < bestSlot; ++slot)
            before += slots >> slot & 1;
        visits.push_back({ray, i - before, mask});
        visited.push_back(i);
        rest.push_back(mask & ~(1u << (24 + best)));
    }
    const std::vector<AfterVisit> after = traversalOf(tree).evaluate<AfterVisit>(R"(
        Traversal r = traversalStart(77u, x0.origin, x0.direction, x0.tMin, x0.afterOrder, x0.tMax, false);
        r.groupBase = x0.groupBase;
        r.groupMask = x0.groupMask;
        visitNode(r);
        result = AfterVisit(r.groupBase, r.groupMask, r.pairBase, r.pairMask, uint(r.stackSize),
                            r.nodesLeft ? 1u : 0u, stackBase[0], stackMask[0]);)",
                                                                                 visits);
    std::array<int, 3> seen{};
    int childrenMet = 0;
    for (std::size_t i = 0; i < visits.size(); ++i) {
        const shared::WideNode& node = tree.nodes[visited[i]];
        const AfterVisit& a = after[i];
        ASSERT_EQ(a.pairBase, node.pairBase) << i;
        const std::uint32_t siblings = rest[i] >> 24;
        const bool descended = a.groupBase == node.childBase;
        std::uint32_t octant = 0;
        for (int axis = 0; axis < 3; ++axis)
            octant |= visits[i].ray.direction[axis] < 0.0f ? 0u : 4u >> axis;
        std::uint32_t pairs = 0, inner = 0;
        for (std::uint32_t slot = 0; slot < 8; ++slot) {
            if (node.meta[slot] == 0) continue;
            const Meets expected = meets(node, static_cast<int>(slot), visits[i].ray);
            ++seen[static_cast<std::size_t>(expected)];
            bool met = false;
            if ((node.innerMask >> slot & 1) != 0) {
                met = descended && (a.groupMask >> (24 + (slot ^ octant)) & 1) != 0;
                inner |= met ? 1u << (24 + (slot ^ octant)) : 0u;
            } else {
                const std::uint32_t count = static_cast<std::uint32_t>(std::popcount(node.meta[slot])) -
                                            static_cast<std::uint32_t>(std::popcount(node.meta[slot] & 31u));
                const std::uint32_t bits = ((1u << count) - 1) << (node.meta[slot] & 31);
                met = (a.pairMask & bits) == bits;
                ASSERT_TRUE(met || (a.pairMask & bits) == 0) << i;
                pairs |= met ? bits : 0u;
            }
            childrenMet += met ? 1 : 0;
            ASSERT_TRUE(expected == Meets::kPerhaps || met == (expected == Meets::kYes))
                << i << ", slot " << slot;
        }
        ASSERT_EQ(a.pairMask, pairs) << i;
        if (inner != 0) {  // descends; siblings wait
            ASSERT_EQ(a.groupMask, inner | node.innerMask) << i;
            ASSERT_EQ(a.stackSize, siblings != 0 ? 1u : 0u) << i;
            ASSERT_EQ(a.nodesLeft, 1u) << i;
            if (siblings != 0) {
                ASSERT_EQ(a.stackBase, visits[i].groupBase);
                ASSERT_EQ(a.stackMask, rest[i]);
            }
        } else {  // continues with siblings, if any remain
            ASSERT_FALSE(descended) << i;
            ASSERT_EQ(a.stackSize, 0u) << i;
            ASSERT_EQ(a.nodesLeft, siblings != 0 ? 1u : 0u) << i;
            if (siblings != 0) {
                ASSERT_EQ(a.groupBase, visits[i].groupBase) << i;
                ASSERT_EQ(a.groupMask, rest[i]) << i;
            }
        }
    }
    EXPECT_GT(childrenMet, 10000);
    EXPECT_GT(seen[static_cast<std::size_t>(Meets::kYes)], 10000);
    EXPECT_GT(seen[static_cast<std::size_t>(Meets::kNo)], 20000);
    EXPECT_LT(seen[static_cast<std::size_t>(Meets::kPerhaps)], 1000);
}

}  // namespace
}  // namespace duolux::test

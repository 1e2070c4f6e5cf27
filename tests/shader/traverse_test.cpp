#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

#include "tests/shader/oracles.h"
#include "tests/shader/test_meshes.h"
#include "tests/shader/traced_scene.h"

// Nodes made by hand or at random, against what the layout in bvh_layout.h says of them, in double precision;
// both oracles.

namespace duolux::test {

/// A node is visited as the next of a group of siblings.
struct Visit {
    TestRay ray;
    std::uint32_t groupBase, groupMask;
};
struct AfterVisit {
    std::uint32_t groupBase, groupMask, triangleBase, triangleMask, stackSize, nodesLeft, stackBase,
        stackMask;
};

}  // namespace duolux::test

DUOLUX_GLSL_TYPE(duolux::test::Visit, "Visit",
                 "vec3 origin; float tMin; vec3 direction; float tMax; uint afterPrimitive; uint groupBase; "
                 "uint groupMask;");
DUOLUX_GLSL_TYPE(
    duolux::test::AfterVisit, "AfterVisit",
    "uint groupBase; uint groupMask; uint triangleBase; uint triangleMask; uint stackSize; uint nodesLeft; "
    "uint stackBase; uint stackMask;");

namespace duolux::test {
namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinite = std::numeric_limits<float>::infinity();

void setChild(shared::WideNode& node, int slot, std::uint32_t meta, glm::uvec3 lower, glm::uvec3 upper) {
    node.meta[slot] = static_cast<std::uint8_t>(meta);
    if ((meta >> 5) == 1 && (meta & 31) >= 24)
        node.innerMask = static_cast<std::uint8_t>(node.innerMask | 1 << slot);
    for (int axis = 0; axis < 3; ++axis) {
        node.lower[axis][slot] = static_cast<std::uint8_t>(lower[axis]);
        node.upper[axis][slot] = static_cast<std::uint8_t>(upper[axis]);
    }
}

std::uint32_t innerMeta(int slot) {
    return shared::kMetaInner | (24u + static_cast<std::uint32_t>(slot));
}

std::uint32_t leafMeta(std::uint32_t count, std::uint32_t offset) {
    return ((1u << count) - 1) << 5 | offset;
}

shared::WideNode randomNode(Random& random, std::uint32_t index) {
    shared::WideNode node{};
    for (int axis = 0; axis < 3; ++axis) {
        node.origin[axis] = random.uniform(-1.0f, 0.0f);
        node.exponent[axis] = static_cast<std::uint8_t>(127 - 8 + random.word() % 3);
    }
    node.childBase = 1000000 + 8 * index;
    node.triangleBase = 2000000 + 24 * index;
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
            const std::uint32_t count = 1 + random.word() % shared::kMaxLeafTriangles;
            setChild(node, slot, leafMeta(count, offset), lower, upper);
            offset += count;
        }
    }
    return node;
}

enum class Meets { kNo, kPerhaps, kYes };

/// Whether a ray meets a child's box between tMin and tMax. What rounding may change is left open: 8
/// roundings of the node's and the ray's coordinates, seen along the ray, and the part of 6e-7 by which the
/// library lengthens a stay.
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

/// Rays from around a node, half of them at one of its children, through all octants.
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

TEST(Traverse, VisitsOfNodesFindTheChildrenThatARayMeets) {
    constexpr std::uint32_t kNodes = 40000;
    Random random(11);
    DeviceTree tree;
    tree.triangles.resize(1);
    for (std::uint32_t i = 0; i < kNodes; ++i)
        tree.nodes.push_back(randomNode(random, i));
    std::vector<Visit> visits;
    std::vector<std::uint32_t> visited, rest;  // which node comes first, and the group without it
    for (std::uint32_t i = 8; i < kNodes; ++i) {
        const std::uint32_t slots = 1 + random.word() % 255;
        std::uint32_t left = slots & random.word();
        if (left == 0) left = slots;
        // The first by visiting order is the one furthest against the ray: the slot whose bits differ most
        // from those of the octant the ray runs to, the highest bit counting most.
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
        Traversal r = traversalStart(77u, x0.origin, x0.direction, x0.tMin, x0.afterPrimitive, x0.tMax, false);
        r.groupBase = x0.groupBase;
        r.groupMask = x0.groupMask;
        visitNode(r);
        result = AfterVisit(r.groupBase, r.groupMask, r.triangleBase, r.triangleMask, uint(r.stackSize),
                            r.nodesLeft ? 1u : 0u, stackBase[0], stackMask[0]);)",
                                                                                 visits);
    std::array<int, 3> seen{};
    int childrenMet = 0;
    for (std::size_t i = 0; i < visits.size(); ++i) {
        const shared::WideNode& node = tree.nodes[visited[i]];
        const AfterVisit& a = after[i];
        ASSERT_EQ(a.triangleBase, node.triangleBase) << i;
        const std::uint32_t siblings = rest[i] >> 24;
        const bool descended = a.groupBase == node.childBase;
        std::uint32_t octant = 0;
        for (int axis = 0; axis < 3; ++axis)
            octant |= visits[i].ray.direction[axis] < 0.0f ? 0u : 4u >> axis;
        std::uint32_t triangles = 0, inner = 0;
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
                met = (a.triangleMask & bits) == bits;
                ASSERT_TRUE(met || (a.triangleMask & bits) == 0) << i;
                triangles |= met ? bits : 0u;
            }
            childrenMet += met ? 1 : 0;
            ASSERT_TRUE(expected == Meets::kPerhaps || met == (expected == Meets::kYes))
                << i << ", slot " << slot;
        }
        ASSERT_EQ(a.triangleMask, triangles) << i;
        if (inner != 0) {  // down; siblings wait
            ASSERT_EQ(a.groupMask, inner | node.innerMask) << i;
            ASSERT_EQ(a.stackSize, siblings != 0 ? 1u : 0u) << i;
            ASSERT_EQ(a.nodesLeft, 1u) << i;
            if (siblings != 0) {
                ASSERT_EQ(a.stackBase, visits[i].groupBase);
                ASSERT_EQ(a.stackMask, rest[i]);
            }
        } else {  // on with siblings, if any are left
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

shared::DeviceTriangle planeAt(float z, std::uint32_t primitive) {
    return {{-1, -1, z}, primitive, {1, -1, z}, 0, {0, 2, z}, 0};
}

TEST(Traverse, AnEmptyNodeIsAnEmptyScene) {
    DeviceTree tree;
    tree.nodes.resize(1);
    tree.triangles.push_back(planeAt(1.0f, 0));
    const std::vector<TestRay> rays{{{0, 0, 0}, 0.0f, {0, 0, 1}, kFar},
                                    {{0, 0, 0}, 0.0f, glm::vec3(-0.57735f), kFar}};
    for (const TestHit& hit : trace(traversalOf(tree), rays)) {
        EXPECT_FALSE(hit.found());
        EXPECT_EQ(hit.nodes, 1u);
        EXPECT_EQ(hit.t, kFar);
    }
}

/// A chain as deep as trees may be, at every level of which another node waits on the stack, nothing ever
/// pruned.
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
        const bool chain = i == 0 || (i % 2 == 1 && i + 2 < count);  // nodes 2k + 1 go on, 2k + 2 wait
        if (chain) {
            node.childBase = i == 0 ? 1 : i + 2;
            setChild(node, 0, innerMeta(0), lower, upper);
            setChild(node, 1, innerMeta(1), lower, upper);
        }
        node.triangleBase = i;
        setChild(node, 5, leafMeta(1, 0), lower, upper);
        // Distances that do not grow with the order of visits.
        tree.triangles.push_back(planeAt(1.0f + static_cast<float>(i * 29 % count), i));
    }
    const std::vector<TestRay> rays{{{0.1f, 0.1f, 0.0f}, 0.0f, {0, 0, 1}, kFar},
                                    {{0.1f, 0.1f, 60.0f}, 0.0f, {0, 0, -1}, kFar}};
    const std::vector<TestHit> hits = trace(traversalOf(tree), rays);
    EXPECT_EQ(hits[0].t, 1.0f);
    EXPECT_EQ(hits[0].nodes, count);
    EXPECT_EQ(hits[1].t, 60.0f - static_cast<float>(count));
    EXPECT_EQ(hits[1].nodes, count);
    // All of them, in the order of distance.
    TestRay ray = rays[0];
    for (std::size_t i = 0; i < count; ++i) {
        const TestHit hit = trace(traversalOf(tree), {ray}, {.ordered = 1})[0];
        ASSERT_FLOAT_EQ(hit.t, 1.0f + static_cast<float>(i));
        ray.tMin = hit.t, ray.afterPrimitive = hit.primitive;
    }
    EXPECT_FALSE(trace(traversalOf(tree), {ray}, {.ordered = 1})[0].found());
}

/// Two chains of nodes in opposite octants: what is behind a hit is pruned if the nearer comes first.
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
            tree.nodes[child + 2].triangleBase = child - 1;
            setChild(tree.nodes[child + 2], 6, leafMeta(1, 0), lower, upper);
            tree.triangles.push_back({centre + sign * glm::vec3(0.9f, -0.45f, -0.45f), child,
                                      centre + sign * glm::vec3(-0.45f, 0.9f, -0.45f), 0,
                                      centre + sign * glm::vec3(-0.45f, -0.45f, 0.9f), 0});
        }
        const TestRay ray{6.0f * sign, 0.0f, -sign / std::sqrt(3.0f), kFar};
        const TestHit hit = trace(traversalOf(tree), {ray})[0];
        EXPECT_NEAR(hit.t, 4.0f * std::sqrt(3.0f), 1e-5f) << s;
        EXPECT_EQ(hit.nodes, 4u) << s;  // not the child of the farther one
        EXPECT_EQ(trace(traversalOf(tree), {ray}, {.anyHit = 1})[0].nodes, 3u) << s;
    }
}

/// Mean visits on a scene of 1500 triangles: 10.42, or 11.27 if the order along x were the other one.
TEST(Traverse, FewNodesAreVisited) {
    const TracedScene scene(soup(1500, 1.0f));
    Random random(5);
    std::vector<TestRay> rays;
    for (int i = 0; i < 4000; ++i)
        rays.push_back({random.inBox(1.5f), 0.0f, random.direction(), kFar});
    double nodes = 0.0;
    for (const TestHit& hit : scene.trace(rays))
        nodes += hit.nodes;
    EXPECT_LT(nodes / static_cast<double>(rays.size()), 10.7);
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
        tree.triangles = {planeAt(1.0f, 0), planeAt(2.0f, 1), planeAt(3.0f, 2)};
        tree.triangles[0].v1.z = bad;
        tree.triangles[2].v2.x = bad;
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

/// Triangles far from each other in proportion to their size, so that single and double meet the same ones.
TEST(TraverseOracles, NearestHits) {
    Random random(21);
    Geometry geometry;
    for (int i = 0; i < 200; ++i) {
        const glm::vec3 a = random.inBox(1.0f);
        addTriangle(geometry, a, a + 0.3f * random.direction(), a + 0.3f * random.direction());
    }
    const TracedScene scene(geometry);
    mirror::Texels& texels = mirror::texels();
    texels.nodes.resize(scene.tree.nodes.size() * shared::kNodeTexels);
    std::memcpy(texels.nodes.data(), scene.tree.nodes.data(), texels.nodes.size() * 16);
    texels.triangles.resize(scene.tree.triangles.size() * shared::kTriangleTexels);
    std::memcpy(texels.triangles.data(), scene.tree.triangles.data(), texels.triangles.size() * 16);
    std::vector<TestRay> rays;
    for (int i = 0; i < 4000; ++i)
        rays.push_back({random.inBox(1.5f), 0.0f, random.direction(), kFar});
    const auto single = [](const TestRay& ray) {
        namespace m = mirror::single;
        m::Traversal r =
            m::traversalStart(0, ray.origin, ray.direction, ray.tMin, ray.afterPrimitive, ray.tMax, false);
        while (m::traversalAlive(r))
            m::traverse(r, false, 1, 1);
        return TestHit{r.t, r.triangle, r.primitive, r.barycentric, 0};
    };
    const auto twice = [](const TestRay& ray) {
        namespace m = mirror::twice;
        m::Traversal r = m::traversalStart(0, glm::dvec3(ray.origin), glm::dvec3(ray.direction),
                                           static_cast<double>(ray.tMin), ray.afterPrimitive,
                                           static_cast<double>(ray.tMax), false);
        while (m::traversalAlive(r))
            m::traverse(r, false, 1, 1);
        return TestHit{static_cast<float>(r.t), r.triangle, r.primitive, glm::vec2(r.barycentric), 0};
    };
    expectOracles("traverse", scene.trace(rays), Budget{4, 1e-5}, single, twice, rays);
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
    tree.triangles.resize(1);
    const ShaderLibrary library = traversalOf(tree);
    EXPECT_ORACLES(library, bitsMin, (Budget{0, 0}), a, b);
    EXPECT_ORACLES(library, bitsMax, (Budget{0, 0}), a, b);
    EXPECT_ORACLES(library, unpackBytes, (Budget{0, 0}), words);
}

}  // namespace
}  // namespace duolux::test

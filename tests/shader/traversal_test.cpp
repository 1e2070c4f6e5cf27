#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "tests/shader/test_meshes.h"
#include "tests/shader/traced_scene.h"

// Whole traversals against brute force: in double precision on the host, which determines the certain hits,
// and on the device with the same triangle test, which must be bitwise identical.

namespace duolux::test {
namespace {

/// Intersection in double precision (Moeller and Trumbore, 1997). `inside` is the smallest barycentric
/// coordinate: well above 0 the ray hits for certain, well below it misses.
struct ReferenceHit {
    double t, inside;
};

std::optional<ReferenceHit> referenceHit(const Geometry& geometry, std::size_t triangle, const TestRay& ray) {
    const glm::dvec3 a = geometry.positions[geometry.triangles[triangle].x];
    const glm::dvec3 e1 = glm::dvec3(geometry.positions[geometry.triangles[triangle].y]) - a;
    const glm::dvec3 e2 = glm::dvec3(geometry.positions[geometry.triangles[triangle].z]) - a;
    const glm::dvec3 d = ray.direction;
    const glm::dvec3 p = glm::cross(d, e2);
    const double det = glm::dot(e1, p);
    // Seen edge-on, or without area: neither a certain hit nor a certain miss.
    if (std::abs(det) <= 1e-5 * glm::length(e1) * glm::length(e2)) return std::nullopt;
    const glm::dvec3 s = glm::dvec3(ray.origin) - a;
    const double u = glm::dot(s, p) / det;
    const glm::dvec3 q = glm::cross(s, e1);
    const double v = glm::dot(d, q) / det;
    return ReferenceHit{glm::dot(e2, q) / det, std::min({u, v, 1.0 - u - v})};
}

constexpr double kEdge = 1e-4;      // barycentric coordinates nearer to 0 are uncertain
constexpr double kDistance = 1e-4;  // relative error of a distance, with the scene's size

/// Compares nearest hits with brute force. Returns how many rays hit for certain.
int compareNearest(const TracedScene& scene, const std::vector<TestRay>& rays,
                   const std::vector<TestHit>& hits) {
    int certainHits = 0;
    int failures = 0;
    const Geometry& geometry = scene.geometry;
    const Bounds bounds = boundsOf(geometry);
    const double size = glm::length(glm::dvec3(bounds.upper) - glm::dvec3(bounds.lower));
    for (std::size_t r = 0; r < rays.size() && failures < 10; ++r) {
        double nearestCertain = static_cast<double>(rays[r].tMax);
        for (std::size_t t = 0; t < geometry.triangles.size(); ++t) {
            const auto hit = referenceHit(geometry, t, rays[r]);
            if (hit && hit->inside > kEdge && hit->t > static_cast<double>(rays[r].tMin) + kDistance * size) {
                nearestCertain = std::min(nearestCertain, hit->t);
            }
        }
        const bool certain = nearestCertain < static_cast<double>(rays[r].tMax);
        certainHits += certain ? 1 : 0;
        const TestHit& hit = hits[r];
        const double tolerance = kDistance * (size + std::abs(nearestCertain));
        if (!hit.found()) {
            if (certain) ++failures, ADD_FAILURE() << "ray " << r << " missed a hit at " << nearestCertain;
            continue;
        }
        if (static_cast<double>(hit.t) > nearestCertain + tolerance) {
            ++failures;
            ADD_FAILURE() << "ray " << r << " hit at " << hit.t << ", behind " << nearestCertain;
        }
        // The hit must exist.
        const auto own = referenceHit(geometry, scene.triangleOf(hit.primitive), rays[r]);
        if (own && (own->inside < -kEdge || std::abs(own->t - static_cast<double>(hit.t)) > tolerance)) {
            ++failures;
            ADD_FAILURE() << "ray " << r << " hit at " << hit.t << " where there is nothing (" << own->t
                          << ", " << own->inside << ")";
        }
    }
    return certainHits;
}

std::vector<TestRay> randomRays(int count, float scale, glm::vec3 centre = glm::vec3(0.0f)) {
    Random random;
    std::vector<TestRay> rays;
    for (int i = 0; i < count; ++i) {
        glm::vec3 direction = random.direction();
        if (i % 4 == 1) {  // parallel to an axis
            direction = glm::vec3(0.0f);
            direction[i / 4 % 3] = i % 8 < 4 ? 1.0f : -1.0f;
        }
        if (i % 4 == 2) {  // parallel to a plane
            direction[i / 4 % 3] = 0.0f;
            direction = glm::normalize(direction);
        }
        rays.push_back({centre + scale * random.inBox(1.5f), 0.0f, direction, kFar});
    }
    return rays;
}

/// The smallest edges of a soup are a hundredth of its scale; floats must represent such areas.
class TraversalAtScale : public testing::TestWithParam<float> {};

TEST_P(TraversalAtScale, NearestHitsMatchBruteForce) {
    const float scale = GetParam();
    const TracedScene scene(soup(1500, scale));
    const std::vector<TestRay> rays = randomRays(4000, scale);
    const int hits = compareNearest(scene, rays, scene.trace(rays));
    EXPECT_GT(hits, 1000);  // the comparison must not be empty
}

INSTANTIATE_TEST_SUITE_P(Scales, TraversalAtScale,
                         testing::Values(1e-15f, 1e-12f, 1e-3f, 1.0f, 550.0f, 1e6f, 1e12f, 1e15f, 1e18f));

TEST(Traversal, NearestHitsMatchBruteForceFarFromTheOrigin) {
    const glm::vec3 centre(1000.0f, -2000.0f, 500.0f);
    const TracedScene scene(soup(1500, 10.0f, centre));
    const std::vector<TestRay> rays = randomRays(4000, 10.0f, centre);
    EXPECT_GT(compareNearest(scene, rays, scene.trace(rays)), 1000);
}

TEST(Traversal, TreesOfOneToNineTriangles) {
    for (int count = 1; count <= 9; ++count) {
        Geometry geometry;
        for (int i = 0; i < count; ++i) {
            const auto z = static_cast<float>(i);
            addTriangle(geometry, {-1, -1, z}, {1, -1, z}, {0, 1, z});
        }
        const std::vector<TestRay> rays{{{0.1f, 0.0f, -1.0f}, 0.0f, {0, 0, 1}, kFar},
                                        {{0.1f, 0.0f, 20.0f}, 0.0f, {0, 0, -1}, kFar},
                                        {{0.1f, 0.0f, 20.0f}, 0.0f, {0, 0, 1}, kFar}};
        const TracedScene scene(geometry);
        const std::vector<TestHit> hits = scene.trace(rays);
        EXPECT_FLOAT_EQ(hits[0].t, 1.0f);
        EXPECT_FLOAT_EQ(hits[1].t, 21.0f - static_cast<float>(count));
        EXPECT_FALSE(hits[2].found());
        const std::vector<Walk> walks = walk(scene, rays);
        EXPECT_EQ(walks[0].crossings, static_cast<std::uint32_t>(count));
        EXPECT_EQ(walks[1].crossings, static_cast<std::uint32_t>(count));
        EXPECT_EQ(walks[0].differences + walks[1].differences + walks[2].differences, 0u);
    }
}

TEST(Traversal, RaysThatStartOnASurfaceDoNotHitItWhenItsDistanceIsZero) {
    Geometry geometry;
    addTriangle(geometry, {-1, -1, 0}, {1, -1, 0}, {0, 1, 0});
    addTriangle(geometry, {-1, -1, 1}, {1, -1, 1}, {0, 1, 1});
    const std::vector<TestRay> rays{{{0, 0, 0}, 0.0f, {0, 0, 1}, kFar}, {{0, 0, 1}, 0.0f, {0, 0, 1}, kFar}};
    const std::vector<TestHit> hits = TracedScene(geometry).trace(rays);
    EXPECT_FLOAT_EQ(hits[0].t, 1.0f);
    EXPECT_FALSE(hits[1].found());
}

TEST(Traversal, AnyHitAgreesWithNearestHitAndTheLargestDistance) {
    const TracedScene scene(soup(1500, 1.0f));
    std::vector<TestRay> rays = randomRays(4000, 1.0f);
    const std::vector<TestHit> nearest = scene.trace(rays);
    const std::vector<TestHit> any = scene.trace(rays, {.anyHit = 1});
    std::uint64_t nodes = 0, nodesOfAny = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        EXPECT_EQ(nearest[i].found(), any[i].found()) << i;
        EXPECT_LE(nearest[i].t, any[i].t) << i;
        nodes += nearest[i].nodes;
        nodesOfAny += any[i].nodes;
        if (nearest[i].found()) rays[i].tMax = nearest[i].t * (i % 2 == 0 ? 0.999f : 1.001f);
    }
    EXPECT_LT(nodesOfAny, nodes);  // the first hit ends the traversal
    const std::vector<TestHit> shortened = scene.trace(rays, {.anyHit = 1});
    for (std::size_t i = 0; i < rays.size(); ++i) {
        if (nearest[i].found()) {
            EXPECT_EQ(shortened[i].found(), i % 2 != 0) << i;
        }
    }
}

/// A ray crosses every surface along it exactly once, including coincident ones.
TEST(Traversal, AllCrossingsAreMetOnce) {
    const TracedScene scene(soup(400, 1.0f));
    const std::vector<TestRay> rays = randomRays(2000, 1.0f);
    const std::vector<Walk> walks = walk(scene, rays);
    std::uint32_t crossings = 0;
    for (std::size_t r = 0; r < rays.size(); ++r) {
        std::uint32_t certain = 0;
        std::uint32_t possible = 0;
        for (std::size_t t = 0; t < scene.geometry.triangles.size(); ++t) {
            const auto hit = referenceHit(scene.geometry, t, rays[r]);
            if (!hit) {
                ++possible;
            } else if (hit->t > -kDistance && hit->inside > -kEdge) {
                ++possible;
                if (hit->t > kDistance && hit->inside > kEdge) ++certain;
            }
        }
        EXPECT_GE(walks[r].crossings, certain) << r;
        EXPECT_LE(walks[r].crossings, possible) << r;
        crossings += certain;
    }
    EXPECT_GT(crossings, 500u);
}

// Scenes that are difficult for trees.

Geometry coincident() {
    Geometry geometry;
    for (int i = 0; i < 100; ++i)
        addTriangle(geometry, {-1, -1, 0.25f}, {1, -0.5f, 0.0f}, {0, 1, -0.5f});
    return geometry;
}

/// Grids in three axis-parallel planes: boxes without volume.
Geometry flat() {
    Geometry geometry;
    for (int axis = 0; axis < 3; ++axis) {
        for (int i = 0; i < 100; ++i) {
            glm::vec3 corner(0.125f * static_cast<float>(axis));
            glm::vec3 edge1(0.0f), edge2(0.0f);
            corner[(axis + 1) % 3] = 0.25f * static_cast<float>(i % 10) - 1.25f;
            corner[(axis + 2) % 3] = 0.25f * static_cast<float>(i / 10) - 1.25f;
            edge1[(axis + 1) % 3] = edge2[(axis + 2) % 3] = 0.25f;
            addTriangle(geometry, corner, corner + edge1, corner + edge2);
        }
    }
    return geometry;
}

Geometry needles() {
    Random random;
    Geometry geometry;
    for (int i = 0; i < 300; ++i) {
        const glm::vec3 a = random.inBox(1.5f), b = random.inBox(1.5f);
        addTriangle(geometry, a, b, 0.5f * (a + b) + 1e-3f * random.inBox(1.0f));
    }
    return geometry;
}

/// Triangles of sizes from 2^-12 to 2^47 about one corner: each split separates a single triangle.
Geometry growing() {
    Geometry geometry;
    for (int i = 0; i < 120; ++i) {
        const float x = std::ldexp(1.0f, i / 2 - 12);
        addTriangle(geometry, {x, 0, 0}, {0, x, 0}, {0, 0, x * (1.0f + 0.1f * static_cast<float>(i % 2))});
    }
    return geometry;
}

Geometry single() {
    Geometry geometry;
    addTriangle(geometry, {-1, -1, 0}, {1, -1, 0.5f}, {0, 1, -0.5f});
    return geometry;
}

struct HardScene {
    const char* name;
    Geometry (*geometry)();
    float size;
    glm::vec3 centre{0.0f};
    std::uint32_t fewestCrossings = 500;
};

std::ostream& operator<<(std::ostream& out, const HardScene& scene) {
    return out << scene.name;
}

class TraversalOf : public testing::TestWithParam<HardScene> {};

/// All crossings in order, and the state of a ray without crossings, must be bitwise identical.
TEST_P(TraversalOf, AllTrianglesAgreesToTheBit) {
    const HardScene& hard = GetParam();
    const TracedScene scene(hard.geometry());
    std::vector<TestRay> rays = randomRays(2000, hard.size, hard.centre);
    for (std::size_t i = 0; i < rays.size(); i += 5) {  // aimed at a triangle
        const glm::uvec3 t = scene.geometry.triangles[i % scene.geometry.triangles.size()];
        const glm::vec3 target =
            (scene.geometry.positions[t.x] + scene.geometry.positions[t.y] + scene.geometry.positions[t.z]) /
            3.0f;
        rays[i].direction = glm::normalize(target - rays[i].origin);
    }
    std::uint32_t crossings = 0, differences = 0;
    for (const Walk& w : walk(scene, rays)) {
        crossings += w.crossings;
        differences += w.differences;
    }
    EXPECT_EQ(differences, 0u);
    EXPECT_GT(crossings, hard.fewestCrossings);
}

INSTANTIATE_TEST_SUITE_P(
    Scenes, TraversalOf,
    testing::Values(HardScene{"Soup", [] { return soup(400, 1.0f); }, 1.0f},
                    HardScene{"FarSoup", [] { return soup(400, 1e6f, glm::vec3(-3e7f, 2e7f, 1e7f)); }, 1e6f,
                              glm::vec3(-3e7f, 2e7f, 1e7f)},
                    HardScene{"Coincident", coincident, 1.0f}, HardScene{"Flat", flat, 1.5f},
                    HardScene{"Needles", needles, 1.5f, glm::vec3(0.0f), 50},
                    HardScene{"Growing", growing, 2.0f}, HardScene{"Single", single, 1.0f}),
    [](const auto& scene) { return scene.param.name; });

/// Lanes leave the traversal and resume it when others are done: all thresholds give the same hits.
TEST(Traversal, LeavingAndResumingChangesNothing) {
    const TracedScene scene(soup(400, 1.0f));
    const std::vector<TestRay> rays = randomRays(3000, 1.0f);
    for (std::uint32_t ordered = 0; ordered < 2; ++ordered) {
        const std::vector<TestHit> expected = scene.trace(rays, {.ordered = ordered});
        for (const auto& [leaveTraversal, leaveNodes] : {std::pair{0u, 0u}, {1u, 8u}, {8u, 1u}, {99u, 99u}}) {
            const std::vector<TestHit> hits = scene.trace(
                rays, {.ordered = ordered, .leaveTraversal = leaveTraversal, .leaveNodes = leaveNodes});
            for (std::size_t i = 0; i < rays.size(); ++i) {
                ASSERT_EQ(hits[i].t, expected[i].t) << i << ": " << leaveTraversal << ", " << leaveNodes;
                ASSERT_TRUE(ordered == 0 || hits[i].primitive == expected[i].primitive) << i;
                ASSERT_EQ(hits[i].triangle, hits[i].primitive);
            }
        }
    }
}

/// The tree over emitters follows the other tree, and its triangles are copies with the same primitives.
TEST(Traversal, ASecondTreeIsTracedFromItsOwnRoot) {
    const Geometry geometry = soup(600, 1.0f);
    TracedScene scene(geometry);
    std::vector<std::uint32_t> some, entryOf(geometry.triangles.size());
    for (std::uint32_t i = 0; i < geometry.triangles.size(); i += 3)
        some.push_back(i);
    for (std::uint32_t i = 0; i < scene.tree.triangles(); ++i) {
        if (scene.triangleOf(i) != kNone) entryOf[scene.triangleOf(i)] = i;
    }
    const WideBvh second = buildWideBvh(geometry, some);
    std::vector<std::uint32_t> primitives;
    for (const TrianglePair& pair : second.pairs) {
        primitives.push_back(entryOf[pair.first]);
        primitives.push_back(pair.isSingle() ? kNone : entryOf[pair.second]);
    }
    const auto root = static_cast<std::uint32_t>(scene.tree.nodes.size());
    const std::uint32_t firstCopy = scene.tree.triangles();
    append(scene.tree, geometry, second, primitives);
    DeviceTree alone;
    append(alone, geometry, second, primitives);

    const std::vector<TestRay> rays = randomRays(3000, 1.0f);
    const std::vector<TestHit> hits = scene.trace(rays, {.ordered = 1, .root = root});
    const std::vector<TestHit> expected = trace(traversalOf(alone), rays, {.ordered = 1});
    int found = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        ASSERT_EQ(hits[i].t, expected[i].t);
        ASSERT_EQ(hits[i].primitive, expected[i].primitive);
        ASSERT_EQ(hits[i].found(), expected[i].found());
        if (!hits[i].found()) continue;
        ++found;
        ASSERT_EQ(hits[i].triangle, expected[i].triangle + firstCopy);
        const TrianglePair& pair = second.pairs[expected[i].triangle / 2];
        ASSERT_EQ(scene.triangleOf(hits[i].primitive),
                  expected[i].triangle % 2 == 0 ? pair.first : pair.second);
    }
    EXPECT_GT(found, 300);
}

}  // namespace
}  // namespace duolux::test

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <random>

#include "host/bvh/wide_bvh.h"
#include "tests/shader/trace_layout.h"
#include "tests/support/run_kernel.h"

namespace duolux::spirv {
extern const std::span<const std::uint32_t> kTraceTest;
}

namespace duolux::test {
namespace {

using shared::TestHit;
using shared::TestRay;

struct Traced {
    WideBvh bvh;
    std::vector<TestHit> hits;
};

Traced trace(const Geometry& geometry, const std::vector<TestRay>& rays, std::uint32_t mode) {
    Traced out{buildWideBvh(geometry), {}};
    std::vector<shared::DeviceTriangle> triangles;
    for (std::uint32_t i = 0; i < out.bvh.triangles.size(); ++i) {
        const glm::uvec3 index = geometry.triangles[out.bvh.triangles[i]];
        triangles.push_back(
            {geometry.positions[index.x], i, geometry.positions[index.y], 0, geometry.positions[index.z], 0});
    }
    const Buffer nodes =
        Buffer::upload<shared::WideNode>(device(), BufferUse::kTexels, out.bvh.nodes, "nodes");
    const Buffer triangleBuffer =
        Buffer::upload<shared::DeviceTriangle>(device(), BufferUse::kTexels, triangles, "triangles");
    const Buffer rayBuffer = Buffer::upload<TestRay>(device(), BufferUse::kStorage, rays, "rays");
    const auto count = static_cast<std::uint32_t>(rays.size());
    out.hits = runKernel<TestHit>(spirv::kTraceTest, {{0, &nodes}, {1, &triangleBuffer}, {2, &rayBuffer}}, 3,
                                  shared::TestPush{count, mode, 0}, count);
    return out;
}

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
    if (std::abs(det) < 1e-5 * glm::length(e1) * glm::length(e2)) return std::nullopt;
    const glm::dvec3 s = glm::dvec3(ray.origin) - a;
    const double u = glm::dot(s, p) / det;
    const glm::dvec3 q = glm::cross(s, e1);
    const double v = glm::dot(d, q) / det;
    return ReferenceHit{glm::dot(e2, q) / det, std::min({u, v, 1.0 - u - v})};
}

constexpr double kEdge = 1e-4;      // barycentric coordinates nearer to 0 are uncertain
constexpr double kDistance = 1e-4;  // relative error of a distance, with the scene's size

/// Compares nearest hits with brute force. Returns how many rays hit for certain.
int compareNearest(const Geometry& geometry, const std::vector<TestRay>& rays, const Traced& traced) {
    int certainHits = 0;
    int failures = 0;
    const Bounds bounds = boundsOf(geometry);
    const double size = glm::length(glm::dvec3(bounds.upper) - glm::dvec3(bounds.lower));
    for (std::size_t r = 0; r < rays.size() && failures < 10; ++r) {
        double nearestCertain = rays[r].tMax;
        for (std::size_t t = 0; t < geometry.triangles.size(); ++t) {
            const auto hit = referenceHit(geometry, t, rays[r]);
            if (hit && hit->inside > kEdge && hit->t > static_cast<double>(rays[r].tMin) + kDistance * size) {
                nearestCertain = std::min(nearestCertain, hit->t);
            }
        }
        const bool certain = nearestCertain < static_cast<double>(rays[r].tMax);
        certainHits += certain ? 1 : 0;
        const TestHit& hit = traced.hits[r];
        const double tolerance = kDistance * (size + std::abs(nearestCertain));
        if (hit.t < 0.0f) {
            if (certain) ++failures, ADD_FAILURE() << "ray " << r << " missed a hit at " << nearestCertain;
            continue;
        }
        if (static_cast<double>(hit.t) > nearestCertain + tolerance) {
            ++failures;
            ADD_FAILURE() << "ray " << r << " hit at " << hit.t << ", behind " << nearestCertain;
        }
        // What it did hit must be there.
        const auto own = referenceHit(geometry, traced.bvh.triangles[hit.primitive], rays[r]);
        if (own && (own->inside < -kEdge || std::abs(own->t - static_cast<double>(hit.t)) > tolerance)) {
            ++failures;
            ADD_FAILURE() << "ray " << r << " hit at " << hit.t << " where there is nothing (" << own->t
                          << ", " << own->inside << ")";
        }
    }
    return certainHits;
}

class Random {
  public:
    float uniform(float lower, float upper) {
        return std::uniform_real_distribution<float>(lower, upper)(engine_);
    }
    glm::vec3 inBox(float size) { return {uniform(-size, size), uniform(-size, size), uniform(-size, size)}; }
    glm::vec3 direction() {
        glm::vec3 d;
        do {
            d = inBox(1.0f);
        } while (glm::dot(d, d) > 1.0f || glm::dot(d, d) < 0.01f);
        return glm::normalize(d);
    }

  private:
    std::mt19937 engine_{12345};
};

void addTriangle(Geometry& geometry, glm::vec3 a, glm::vec3 b, glm::vec3 c) {
    const auto base = static_cast<std::uint32_t>(geometry.positions.size());
    geometry.positions.insert(geometry.positions.end(), {a, b, c});
    geometry.triangles.push_back({base, base + 1, base + 2});
    geometry.materials.push_back(0);
}

/// Triangles of very different sizes, some of them degenerate or coincident.
Geometry soup(int count, float scale, glm::vec3 centre = glm::vec3(0.0f)) {
    Random random;
    Geometry geometry;
    for (int i = 0; i < count; ++i) {
        const glm::vec3 a = centre + scale * random.inBox(1.0f);
        const float size = scale * (i % 10 == 0 ? 1.0f : (i % 3 == 0 ? 0.01f : 0.1f));
        const glm::vec3 b = a + size * random.inBox(1.0f);
        const glm::vec3 c = a + size * random.inBox(1.0f);
        addTriangle(geometry, a, b, c);
        if (i % 17 == 0) addTriangle(geometry, a, a, a);                              // a point
        if (i % 19 == 0) addTriangle(geometry, a, b, a + 0.5f * (b - a));             // a line
        if (i % 23 == 0) addTriangle(geometry, a, b, c);                              // twice the same
        if (i % 29 == 0) addTriangle(geometry, a, {b.x, a.y, a.z}, {b.x, b.y, a.z});  // flat along an axis
    }
    return geometry;
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
        rays.push_back({centre + scale * random.inBox(1.5f), 0.0f, direction, 1e30f});
    }
    return rays;
}

class TraversalAtScale : public testing::TestWithParam<float> {};

TEST_P(TraversalAtScale, NearestHitsMatchBruteForce) {
    const float scale = GetParam();
    const Geometry geometry = soup(1500, scale);
    const std::vector<TestRay> rays = randomRays(4000, scale);
    const int hits = compareNearest(geometry, rays, trace(geometry, rays, shared::kTestNearest));
    EXPECT_GT(hits, 1000);  // the comparison must have had something to compare
}

INSTANTIATE_TEST_SUITE_P(Scales, TraversalAtScale, testing::Values(1e-3f, 1.0f, 550.0f, 1e6f));

TEST(Traversal, NearestHitsMatchBruteForceFarFromTheOrigin) {
    const glm::vec3 centre(1000.0f, -2000.0f, 500.0f);
    const Geometry geometry = soup(1500, 10.0f, centre);
    const std::vector<TestRay> rays = randomRays(4000, 10.0f, centre);
    EXPECT_GT(compareNearest(geometry, rays, trace(geometry, rays, shared::kTestNearest)), 1000);
}

TEST(Traversal, TreesOfOneToNineTriangles) {
    for (int count = 1; count <= 9; ++count) {
        Geometry geometry;
        for (int i = 0; i < count; ++i) {
            const auto z = static_cast<float>(i);
            addTriangle(geometry, {-1, -1, z}, {1, -1, z}, {0, 1, z});
        }
        const std::vector<TestRay> rays{{{0.1f, 0.0f, -1.0f}, 0.0f, {0, 0, 1}, 1e30f},
                                        {{0.1f, 0.0f, 20.0f}, 0.0f, {0, 0, -1}, 1e30f},
                                        {{0.1f, 0.0f, 20.0f}, 0.0f, {0, 0, 1}, 1e30f}};
        const Traced traced = trace(geometry, rays, shared::kTestAllCrossings);
        EXPECT_FLOAT_EQ(traced.hits[0].t, 1.0f);
        EXPECT_FLOAT_EQ(traced.hits[1].t, 21.0f - static_cast<float>(count));
        EXPECT_EQ(traced.hits[2].t, -1.0f);
        EXPECT_EQ(traced.hits[0].crossings, static_cast<std::uint32_t>(count));
        EXPECT_EQ(traced.hits[1].crossings, static_cast<std::uint32_t>(count));
    }
}

TEST(Traversal, RaysThatStartOnASurfaceDoNotHitItWhenItsDistanceIsZero) {
    Geometry geometry;
    addTriangle(geometry, {-1, -1, 0}, {1, -1, 0}, {0, 1, 0});
    addTriangle(geometry, {-1, -1, 1}, {1, -1, 1}, {0, 1, 1});
    const std::vector<TestRay> rays{{{0, 0, 0}, 0.0f, {0, 0, 1}, 1e30f}, {{0, 0, 1}, 0.0f, {0, 0, 1}, 1e30f}};
    const Traced traced = trace(geometry, rays, shared::kTestNearest);
    EXPECT_FLOAT_EQ(traced.hits[0].t, 1.0f);
    EXPECT_EQ(traced.hits[1].t, -1.0f);
}

TEST(Traversal, AnyHitAgreesWithNearestHitAndTheLargestDistance) {
    const Geometry geometry = soup(1500, 1.0f);
    std::vector<TestRay> rays = randomRays(4000, 1.0f);
    const Traced nearest = trace(geometry, rays, shared::kTestNearest);
    const Traced any = trace(geometry, rays, shared::kTestAnyHit);
    for (std::size_t i = 0; i < rays.size(); ++i) {
        EXPECT_EQ(nearest.hits[i].t < 0.0f, any.hits[i].t < 0.0f) << i;
        if (nearest.hits[i].t > 0.0f) rays[i].tMax = nearest.hits[i].t * (i % 2 == 0 ? 0.999f : 1.001f);
    }
    const Traced shortened = trace(geometry, rays, shared::kTestAnyHit);
    for (std::size_t i = 0; i < rays.size(); ++i) {
        if (nearest.hits[i].t > 0.0f) {
            EXPECT_EQ(shortened.hits[i].t < 0.0f, i % 2 == 0) << i;
        }
    }
}

/// Every surface along a ray is met exactly once, coincident ones included.
TEST(Traversal, AllCrossingsAreMetOnce) {
    const Geometry geometry = soup(400, 1.0f);
    const std::vector<TestRay> rays = randomRays(2000, 1.0f);
    const Traced traced = trace(geometry, rays, shared::kTestAllCrossings);
    int crossings = 0;
    for (std::size_t r = 0; r < rays.size(); ++r) {
        std::uint32_t certain = 0;
        std::uint32_t possible = 0;
        for (std::size_t t = 0; t < geometry.triangles.size(); ++t) {
            const auto hit = referenceHit(geometry, t, rays[r]);
            if (!hit) {
                ++possible;
            } else if (hit->t > -kDistance && hit->inside > -kEdge) {
                ++possible;
                if (hit->t > kDistance && hit->inside > kEdge) ++certain;
            }
        }
        EXPECT_GE(traced.hits[r].crossings, certain) << r;
        EXPECT_LE(traced.hits[r].crossings, possible) << r;
        crossings += static_cast<int>(certain);
    }
    EXPECT_GT(crossings, 500);
}

/// Rays at the edges and vertices of a closed mesh from inside never get out.
TEST(Traversal, ClosedMeshDoesNotLeakAtItsEdges) {
    // A closed latitude-longitude sphere.
    constexpr int kRings = 24;
    constexpr int kSegments = 48;
    Geometry geometry;
    const auto vertex = [](int ring, int segment) {
        const double theta = M_PI * ring / kRings;
        const double phi = 2.0 * M_PI * (segment % kSegments) / kSegments;
        const double radius = ring == 0 || ring == kRings ? 0.0 : std::sin(theta);
        return glm::vec3(radius * std::cos(phi), std::cos(theta), radius * std::sin(phi));
    };
    for (int ring = 0; ring < kRings; ++ring) {
        for (int segment = 0; segment < kSegments; ++segment) {
            const glm::vec3 a = vertex(ring, segment), b = vertex(ring, segment + 1);
            const glm::vec3 c = vertex(ring + 1, segment), d = vertex(ring + 1, segment + 1);
            if (ring > 0) addTriangle(geometry, a, b, c);
            if (ring < kRings - 1) addTriangle(geometry, b, d, c);
        }
    }
    Random random;
    std::vector<TestRay> rays;
    for (int i = 0; i < 200000; ++i) {
        const glm::uvec3 tri = geometry.triangles[static_cast<std::size_t>(i) % geometry.triangles.size()];
        const float s = i % 5 == 0 ? 0.0f : random.uniform(0.0f, 1.0f);
        const glm::vec3 target = glm::mix(geometry.positions[tri.x], geometry.positions[tri.y], s);
        const glm::vec3 origin = random.inBox(0.3f);
        rays.push_back({origin, 0.0f, glm::normalize(target - origin), 1e30f});
    }
    const Traced traced = trace(geometry, rays, shared::kTestNearest);
    const auto leaks =
        std::count_if(traced.hits.begin(), traced.hits.end(), [](const TestHit& h) { return h.t < 0.0f; });
    EXPECT_EQ(leaks, 0);
}

}  // namespace
}  // namespace duolux::test

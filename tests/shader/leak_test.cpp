#include <gtest/gtest.h>

#include <numeric>

#include "tests/shader/test_meshes.h"
#include "tests/shader/traced_scene.h"

// Closed meshes traced through the tree: no ray escapes, whether it is aimed at edges and corners or starts
// on a surface with the ray offset. Each invocation generates 64 rays on the device.

namespace duolux::test {

struct Leaks {
    std::uint32_t rays, leaks, selfHits;
    glm::vec3 origin, direction;  ///< of the last that leaked
};

}  // namespace duolux::test

DUOLUX_GLSL_TYPE(duolux::test::Leaks, "Leaks",
                 "uint rays; uint leaks; uint selfHits; vec3 origin; vec3 direction;");

namespace duolux::test {
namespace {

constexpr std::uint32_t kRaysPerInvocation = 64;

struct Mesh {
    const char* name;
    Geometry (*geometry)();
    std::uint32_t rays;
    float scale = 1.0f;
    glm::vec3 offset{0.0f};
    /// Radius, relative to the scale, of a ball around the centre that is well inside.
    float inner = 0.3f;
};

std::ostream& operator<<(std::ostream& out, const Mesh& mesh) {
    return out << mesh.name;
}

/// Random rays like the harness's, without its loops, because drivers limit the number of iterations.
constexpr const char* kRays = R"(
#include "tests/shader/harness/random.glsl"
    vec3 uniformDirection() {
        float z = 2.0 * randomFloat() - 1.0;
        float phi = 6.2831853 * randomFloat();
        return vec3(sqrt(max(0.0, 1.0 - z * z)) * vec2(cos(phi), sin(phi)), z);
    }
    bool meetsSomething(inout Traversal r) {
        while (traversalAlive(r)) traverse(r, false, 6u, 4u);
        return r.triangle != kNoTriangle;
    })";

Leaks sum(const std::vector<Leaks>& parts) {
    Leaks all{};
    for (const Leaks& part : parts) {
        all.rays += part.rays;
        all.leaks += part.leaks;
        all.selfHits += part.selfHits;
        if (part.leaks > 0) all.origin = part.origin, all.direction = part.direction;
    }
    return all;
}

class ClosedMesh : public testing::TestWithParam<Mesh> {
  protected:
    /// Runs the statements for each ray; x1: triangles, x2: (offset, scale), x3: radius of the inner ball.
    static Leaks run(const Mesh& mesh, const std::string& statements, std::uint32_t rays) {
        const TracedScene scene(moved(mesh.geometry(), mesh.scale, mesh.offset));
        ShaderLibrary library = traversalOf(scene.tree);
        library.define(kRays);
        std::vector<std::uint32_t> seeds(rays / kRaysPerInvocation);
        std::iota(seeds.begin(), seeds.end(), 1u);
        return sum(library.evaluate<Leaks>(
            "result = Leaks(0u, 0u, 0u, vec3(0.0), vec3(0.0));\nseedRandom(1u, x0);\n"
            "for (uint i = 0u; i < 64u; i++) {" +
                statements + "}",
            seeds, scene.tree.triangles(), glm::vec4(mesh.offset, mesh.scale), mesh.inner * mesh.scale));
    }
};

TEST_P(ClosedMesh, DoesNotLeakAtItsEdges) {
    const Leaks leaks = run(GetParam(), R"(
        Triangle tri = fetchTriangle(presentTriangle(randomUint() % x1));
        uint kind = randomUint() % 4u;
        float s = kind == 0u ? 0.0 : randomFloat();
        vec3 target = tri.v0 * (1.0 - s) + tri.v1 * s;
        if (kind == 3u) target = mix(target, tri.v2, exp2(-24.0 * randomFloat()));
        vec3 origin = x2.xyz + uniformDirection() * (randomFloat() * x3);
        vec3 d = normalize(target - origin);
        Traversal r = traversalStart(0u, origin, d, 0.0, kNoTriangle, 1e30, false);
        bool hit = meetsSomething(r);
        result.rays += 1u;
        result.leaks += hit ? 0u : 1u;
        if (!hit) result.origin = origin, result.direction = d;)",
                            GetParam().rays);
    EXPECT_EQ(leaks.leaks, 0u) << leaks.origin.x << " " << leaks.origin.y << " " << leaks.origin.z
                               << " towards " << leaks.direction.x << " " << leaks.direction.y << " "
                               << leaks.direction.z;
    EXPECT_EQ(leaks.rays, GetParam().rays / 64 * 64);
}

// 10^7 rays in all.
INSTANTIATE_TEST_SUITE_P(Meshes, ClosedMesh,
                         testing::Values(Mesh{"Latitudes", [] { return latitudeSphere(24, 48); }, 2500000},
                                         Mesh{"Slivers", [] { return latitudeSphere(16, 1000); }, 1500000},
                                         Mesh{"Icosphere", [] { return icosphere(4); }, 2000000},
                                         Mesh{"LargeGridCube", [] { return gridCube(16); }, 2000000, 1e6f},
                                         Mesh{"FarDisplaced", [] { return displaced(icosphere(4), 0.2f); },
                                              2000000, 1.0f, glm::vec3(577.0f, -612.0f, 541.0f)}),
                         [](const auto& mesh) { return mesh.param.name; });

/// Rays from far outside. The rounding of a triangle test grows with the distance, so a node's box must be
/// wide enough for the triangles that such a ray hits. `slant`: components of the ray's direction along the
/// face at which it is aimed.
struct Afar {
    float distance;  ///< in edges of the mesh
    float leastSlant, mostSlant;
};

std::ostream& operator<<(std::ostream& out, const Afar& afar) {
    return out << afar.distance << " edges away, slant " << afar.leastSlant << " to " << afar.mostSlant;
}

class SeenFromAfar : public testing::TestWithParam<Afar> {};

TEST_P(SeenFromAfar, MeshesAreMetAtTheirEdges) {
    const TracedScene scene(gridCube(4));
    ShaderLibrary library = traversalOf(scene.tree);
    library.define(kRays);
    std::vector<std::uint32_t> seeds(200000 / kRaysPerInvocation);
    std::iota(seeds.begin(), seeds.end(), 1u);
    const Leaks leaks = sum(
        library.evaluate<Leaks>(R"(
        result = Leaks(0u, 0u, 0u, vec3(0.0), vec3(0.0));
        seedRandom(1u, x0);
        for (uint i = 0u; i < 64u; i++) {
            Triangle tri = fetchTriangle(presentTriangle(randomUint() % x1));
            float s = (randomUint() & 3u) == 0u ? 0.0 : randomFloat();
            vec3 target = tri.v0 * (1.0 - s) + tri.v1 * s;
            vec3 outwards = normalize(cross(tri.v1 - tri.v0, tri.v2 - tri.v0));
            for (int axis = 0; axis < 3; axis++) {
                float slant = mix(x2.y, x2.z, randomFloat()) * ((randomUint() & 1u) == 0u ? -1.0 : 1.0);
                outwards[axis] = abs(outwards[axis]) < 0.5 ? slant : outwards[axis];
            }
            vec3 origin = target + normalize(outwards) * (0.5 * x2.x);
            Traversal r = traversalStart(0u, origin, normalize(target - origin), 0.0, kNoTriangle, 1e30, false);
            Traversal all = r;
            closestOfAll(x1, all);
            while (traversalAlive(r)) traverse(r, true, 6u, 4u);
            bool leak = r.triangle != all.triangle;
            result.rays += all.triangle != kNoTriangle ? 1u : 0u;
            result.leaks += leak ? 1u : 0u;
            if (leak) result.origin = origin, result.direction = r.direction;
        })",
                                seeds, scene.tree.triangles(),
                                glm::vec3(GetParam().distance, GetParam().leastSlant, GetParam().mostSlant)));
    EXPECT_GT(leaks.rays, 160000u);
    EXPECT_EQ(leaks.leaks, 0u) << leaks.origin.x << " " << leaks.origin.y << " " << leaks.origin.z
                               << " towards " << leaks.direction.x << " " << leaks.direction.y << " "
                               << leaks.direction.z;
}

/// Nearly along an axis, boxes are wide enough up to a few thousand edges (at 2e5 edges, 0.4 % of these rays
/// miss); for slanted rays, the relative margin of the slab test suffices at any distance.
INSTANTIATE_TEST_SUITE_P(Distances, SeenFromAfar,
                         testing::Values(Afar{10.0f, 0.0f, 0.1f}, Afar{1e3f, 0.0f, 0.1f},
                                         Afar{1e5f, 0.5f, 1.0f}, Afar{1e6f, 0.5f, 1.0f}));

/// Scales with the mesh at the origin, and with the mesh far away.
struct Place {
    float scale;
    glm::vec3 offset;  ///< in units of the scale
};

std::ostream& operator<<(std::ostream& out, const Place& place) {
    return out << "scale " << place.scale << ", at " << place.offset.x << " " << place.offset.y << " "
               << place.offset.z;
}

class RayOffset : public testing::TestWithParam<Place> {
  protected:
    /// Rays from points of the mesh to the inside, half of them at grazing angles. `margin`: distance from
    /// edges, in barycentric coordinates. selfHits: rays whose first hit is in the plane of their own
    /// triangle.
    static Leaks run(const Geometry& mesh, float margin, std::uint32_t rays) {
        const Place& place = GetParam();
        const TracedScene scene(moved(mesh, place.scale, place.scale * place.offset));
        ShaderLibrary library = traversalOf(scene.tree);
        library.define(
            "#include \"shaders/lib/surface.glsl\"\nuvec4 fetchNormalTexel(uint i) { return uvec4(0u); }");
        library.define(kNoVertexRecords).define(kRays);
        std::vector<std::uint32_t> seeds(rays / kRaysPerInvocation);
        std::iota(seeds.begin(), seeds.end(), 1u);
        return sum(library.evaluate<Leaks>(R"(
            result = Leaks(0u, 0u, 0u, vec3(0.0), vec3(0.0));
            seedRandom(1u, x0);
            for (uint i = 0u; i < 64u; i++) {
                uint index = presentTriangle(randomUint() % x1);
                Triangle tri = fetchTriangle(index);
                vec2 b = vec2(randomFloat(), randomFloat());
                b = x3 + (1.0 - 3.0 * x3) * (b.x + b.y > 1.0 ? 1.0 - b : b);
                vec3 normal = normalize(cross(tri.v1 - tri.v0, tri.v2 - tri.v0));
                SurfacePoint point = surfacePoint(tri, index, b, normal, tri.v0 - x2.xyz, false);
                vec3 d = uniformDirection();
                float cosine = dot(d, point.geometricNormal);
                if ((randomUint() & 1u) == 0u) d -= point.geometricNormal * (cosine * (1.0 - exp2(-20.0 * randomFloat())));
                d = normalize(cosine < 0.0 ? d - 2.0 * dot(d, point.geometricNormal) * point.geometricNormal : d);
                Traversal r = traversalStart(0u, point.position, d, 0.0, kNoTriangle, 1e30, false);
                bool hit = meetsSomething(r);
                result.rays += 1u;
                result.leaks += hit ? 0u : 1u;
                if (!hit) result.origin = point.position, result.direction = d;
                Triangle other = fetchTriangle(hit ? r.triangle : index);
                vec3 off = vec3(dot(other.v0 - tri.v0, normal), dot(other.v1 - tri.v0, normal),
                                dot(other.v2 - tri.v0, normal));
                float plane = max(abs(off.x), max(abs(off.y), abs(off.z)));
                result.selfHits += hit && plane <= 0.1 * pointError(tri) ? 1u : 0u;
            })",
                                           seeds, scene.tree.triangles(),
                                           glm::vec4(place.scale * place.offset, place.scale), margin));
    }
};

/// All dihedral angles are obtuse: an offset from one triangle does not approach another.
TEST_P(RayOffset, KeepsRaysInsideASphere) {
    const Leaks leaks = run(icosphere(3), 0.0f, 200000);
    EXPECT_EQ(leaks.leaks, 0u) << leaks.origin.x << " " << leaks.origin.y << " " << leaks.origin.z;
    EXPECT_EQ(leaks.selfHits, 0u);
}

/// Right angles, and faces of many triangles in one plane. Points keep off edges, because only rounding
/// decides on which side of the adjacent face a point on an edge is.
TEST_P(RayOffset, KeepsRaysInsideACubeAndOffCoplanarNeighbours) {
    const Leaks leaks = run(gridCube(8), 0.01f, 200000);
    EXPECT_EQ(leaks.leaks, 0u) << leaks.origin.x << " " << leaks.origin.y << " " << leaks.origin.z;
    EXPECT_EQ(leaks.selfHits, 0u);
}

INSTANTIATE_TEST_SUITE_P(ScalesAndPlaces, RayOffset,
                         testing::Values(Place{1e-3f, glm::vec3(0.0f)}, Place{1.0f, glm::vec3(0.0f)},
                                         Place{550.0f, glm::vec3(0.5f, 3.0f, -1.0f)},
                                         Place{1e6f, glm::vec3(0.0f)},
                                         Place{1e-3f, glm::vec3(577.0f, -612.0f, 541.0f)},
                                         Place{1e6f, glm::vec3(-1000.0f, 30.0f, 0.1f)}));

}  // namespace
}  // namespace duolux::test

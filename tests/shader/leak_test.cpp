#include <gtest/gtest.h>

#include <numeric>

#include "tests/shader/test_meshes.h"
#include "tests/shader/traced_scene.h"

// Closed meshes through the tree: no ray gets out, neither one aimed at edges and corners nor one that leaves
// a surface by the ray offset. Rays are made on the device, 64 an invocation.

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
    /// A ball around the middle that is inside with a good margin, of the scale.
    float inner = 0.3f;
};

std::ostream& operator<<(std::ostream& out, const Mesh& mesh) {
    return out << mesh.name;
}

/// A generator of their own, so that the library's would not test itself: RXS-M-XS of O'Neill's PCG, 2014.
constexpr const char* kRandom = R"(
    uint state;
    uint word() {
        state = state * 747796405u + 2891336453u;
        uint w = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
        return (w >> 22u) ^ w;
    }
    float uniform01() { return float(word() >> 8u) * (1.0 / 16777216.0); }
    vec3 uniformDirection() {
        float z = 2.0 * uniform01() - 1.0;
        float phi = 6.2831853 * uniform01();
        return vec3(sqrt(max(0.0, 1.0 - z * z)) * vec2(cos(phi), sin(phi)), z);
    }
    bool meetsSomething(Traversal r) {
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
    /// Runs statements for ray after ray; x1: triangles, x2: (offset, scale), x3: radius of the inner ball.
    static Leaks run(const Mesh& mesh, const std::string& statements, std::uint32_t rays) {
        const TracedScene scene(moved(mesh.geometry(), mesh.scale, mesh.offset));
        ShaderLibrary library = traversalOf(scene.tree);
        library.define(kRandom);
        std::vector<std::uint32_t> seeds(rays / kRaysPerInvocation);
        std::iota(seeds.begin(), seeds.end(), 1u);
        return sum(library.evaluate<Leaks>(
            "result = Leaks(0u, 0u, 0u, vec3(0.0), vec3(0.0));\nstate = x0 * 2654435769u;\n"
            "for (uint i = 0u; i < 64u; i++) {" +
                statements + "}",
            seeds, static_cast<std::uint32_t>(scene.tree.triangles.size()),
            glm::vec4(mesh.offset, mesh.scale), mesh.inner * mesh.scale));
    }
};

TEST_P(ClosedMesh, DoesNotLeakAtItsEdges) {
    const Leaks leaks = run(GetParam(), R"(
        Triangle tri = fetchTriangle(word() % x1);
        uint kind = word() % 4u;
        float s = kind == 0u ? 0.0 : uniform01();
        vec3 target = tri.v0 * (1.0 - s) + tri.v1 * s;
        if (kind == 3u) target = mix(target, tri.v2, exp2(-24.0 * uniform01()));
        vec3 origin = x2.xyz + uniformDirection() * (uniform01() * x3);
        vec3 d = normalize(target - origin);
        bool hit = meetsSomething(traversalStart(0u, origin, d, 0.0, kNoTriangle, 1e30, false));
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

}  // namespace
}  // namespace duolux::test

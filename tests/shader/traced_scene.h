#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "host/bvh/wide_bvh.h"
#include "host/scene/scene.h"
#include "tests/shader/harness/shader_function.h"

// The traversal on the device through the tree of a scene, and a test of every triangle without the tree.

namespace duolux::test {

inline constexpr std::uint32_t kNone = 0xffffffffu;
inline constexpr float kFar = 1e30f;

struct TestRay {
    glm::vec3 origin;
    float tMin;
    glm::vec3 direction;
    float tMax;
    std::uint32_t afterOrder = kNone;
};

struct TestHit {
    float t;  ///< the ray's tMax if there is none
    std::uint32_t triangle, primitive;
    glm::vec2 barycentric;
    std::uint32_t nodes;  ///< visited

    bool found() const { return triangle != kNone; }
};

struct TraceOptions {
    std::uint32_t anyHit = 0, ordered = 0;
    std::uint32_t leaveTraversal = 6, leaveNodes = 4;
    std::uint32_t root = 0;
};

}  // namespace duolux::test

DUOLUX_GLSL_TYPE(duolux::test::TestRay, "TestRay",
                 "vec3 origin; float tMin; vec3 direction; float tMax; uint afterOrder;");
DUOLUX_GLSL_TYPE(duolux::test::TestHit, "TestHit",
                 "float t; uint triangle; uint primitive; vec2 barycentric; uint nodes;");
DUOLUX_GLSL_TYPE(duolux::test::TraceOptions, "TraceOptions",
                 "uint anyHit; uint ordered; uint leaveTraversal; uint leaveNodes; uint root;");

namespace duolux::test {

/// The data of a scene on the device.
struct DeviceTree {
    std::vector<shared::WideNode> nodes;
    std::vector<shared::DevicePair> pairs;

    /// Includes the missing second triangles of pairs.
    std::uint32_t triangles() const { return 2 * static_cast<std::uint32_t>(pairs.size()); }
};

/// `primitives`: of the triangles, two per pair; consecutive numbers if empty.
inline void append(DeviceTree& tree, const Geometry& geometry, const WideBvh& bvh,
                   const std::vector<std::uint32_t>& primitives = {}) {
    const auto firstNode = static_cast<std::uint32_t>(tree.nodes.size());
    const auto firstPair = static_cast<std::uint32_t>(tree.pairs.size());
    for (shared::WideNode node : bvh.nodes) {
        node.childBase += firstNode;
        node.pairBase += firstPair;
        tree.nodes.push_back(node);
    }
    for (std::uint32_t i = 0; i < bvh.pairs.size(); ++i) {
        const std::array<std::uint32_t, 4> corners = cornersOf(geometry, bvh.pairs[i]).value().positions;
        const auto primitive = [&](std::uint32_t k) { return primitives.empty() ? k : primitives[k]; };
        tree.pairs.push_back({geometry.positions[corners[0]], primitive(2 * i),
                              geometry.positions[corners[1]], 0, geometry.positions[corners[2]], 0,
                              geometry.positions[corners[3]],
                              bvh.pairs[i].isSingle() ? kNone : primitive(2 * i + 1)});
    }
}

/// Functions of the traversal for this tree; nodesFetched counts visits. closestOfAll tests a ray against all
/// triangles without the tree, in the order of (distance, order).
inline ShaderLibrary traversalOf(const DeviceTree& tree) {
    ShaderLibrary library("shaders/lib/traverse.glsl");
    library.define(R"(
        uvec4 fetchPlaneTexel(uint index) { return uvec4(0u); }
        uint nodesFetched = 0u;
        uvec4 storedNodeTexel(uint index);
        uvec4 fetchNodeTexel(uint index) {
            nodesFetched += index % kNodeTexels == 0u ? 1u : 0u;
            return storedNodeTexel(index);
        }
        // A triangle's index, or its neighbour's if the pair lacks it.
        uint presentTriangle(uint index) {
            return fetchTriangle(index).primitive == kNoTriangle ? index ^ 1u : index;
        }
        void closestOfAll(uint count, inout Traversal r) {
            for (uint i = 0u; i < count; i++) {
                Triangle tri = fetchTriangle(i);
                TriangleHit h = intersectTriangle(tri, r.origin, r.direction, r.axisU, r.axisV, true);
                uint order = orderOfSurface(tri.primitive, h.front);
                bool after = h.t > r.tMin || (h.t == r.tMin && order > r.afterOrder);
                if (h.hit && after && (h.t < r.t || (h.t == r.t && order < r.order))) {
                    r.t = h.t;
                    r.triangle = i;
                    r.order = order;
                    r.barycentric = h.barycentric;
                }
            }
        })");
    library.texels<shared::WideNode>("storedNodeTexel", tree.nodes);
    library.texels<shared::DevicePair>("fetchPairTexel", tree.pairs);
    return library;
}

inline std::vector<TestHit> trace(const ShaderLibrary& traversal, const std::vector<TestRay>& rays,
                                  const TraceOptions& options = {}) {
    return traversal.evaluate<TestHit>(R"(
        Traversal r = traversalStart(x1.root, x0.origin, x0.direction, x0.tMin, x0.afterOrder, x0.tMax,
                                     x1.anyHit != 0u);
        while (traversalAlive(r)) traverse(r, x1.ordered != 0u, x1.leaveTraversal, x1.leaveNodes);
        uint primitive = r.triangle == kNoTriangle ? kNoTriangle : fetchTriangle(r.triangle).primitive;
        result = TestHit(r.t, r.triangle, primitive, r.barycentric, nodesFetched);)",
                                       rays, options);
}

/// A scene with a tree built by the library. Primitives are the indices of triangles on the device.
struct TracedScene {
    explicit TracedScene(Geometry mesh) : geometry(std::move(mesh)), bvh(buildWideBvh(geometry)) {
        append(tree, geometry, bvh);
    }
    std::vector<TestHit> trace(const std::vector<TestRay>& rays, const TraceOptions& options = {}) const {
        return test::trace(traversalOf(tree), rays, options);
    }

    /// Index in the geometry.
    std::uint32_t triangleOf(std::uint32_t primitive) const {
        const TrianglePair& pair = bvh.pairs.at(primitive / 2);
        return primitive % 2 == 0 ? pair.first : pair.second;
    }

    Geometry geometry;
    WideBvh bvh;
    DeviceTree tree;
};

/// Follows a ray through all its crossings, by the tree and by closestOfAll. (Lavapipe silently ends all
/// loops of an invocation after 65,535 iterations: crossings times triangles must stay well below that.)
struct Walk {
    std::uint32_t crossings;
    std::uint32_t differences;  ///< steps at which the two are not bitwise identical
};

}  // namespace duolux::test

DUOLUX_GLSL_TYPE(duolux::test::Walk, "Walk", "uint crossings; uint differences;");

namespace duolux::test {

inline std::vector<Walk> walk(const TracedScene& scene, const std::vector<TestRay>& rays,
                              const TraceOptions& options = {}) {
    const std::uint32_t count = scene.tree.triangles();
    return traversalOf(scene.tree)
        .evaluate<Walk>(R"(
        result = Walk(0u, 0u);
        float tMin = x0.tMin;
        uint after = x0.afterOrder;
        bool again = true;
        while (again) {
            Traversal all = traversalStart(0u, x0.origin, x0.direction, tMin, after, x0.tMax, false);
            Traversal r = all;
            while (traversalAlive(r)) traverse(r, true, x1.leaveTraversal, x1.leaveNodes);
            closestOfAll(x2, all);
            bool same = floatBitsToUint(r.t) == floatBitsToUint(all.t) && r.triangle == all.triangle &&
                        r.order == all.order && r.barycentric == all.barycentric;
            result.differences += same ? 0u : 1u;
            again = all.triangle != kNoTriangle && same;
            result.crossings += again ? 1u : 0u;
            tMin = all.t;
            after = all.order;
        })",
                        rays, options, count);
}

}  // namespace duolux::test

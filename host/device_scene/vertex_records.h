#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "host/bvh/pairs.h"
#include "host/scene/scene.h"
#include "shaders/shared/texture_layout.h"

namespace duolux {

/// What kernels need to know of the vertices of a scene beyond positions and colours.
struct VertexNeeds {
    bool records = false;        ///< texture coordinates or tangents: triangles have DeviceCorners
    bool secondUvs = false;      ///< the second set of texture coordinates
    std::vector<bool> tangents;  ///< per material: whether it depends on tangents

    bool operator==(const VertexNeeds&) const = default;
};

/// Materials without triangles, and those of triangles without texture coordinates, need nothing.
VertexNeeds vertexNeeds(const Scene& scene);

struct VertexRecords {
    std::vector<shared::DeviceCorners> corners;  ///< two for each pair, as TriangleRecords
    std::vector<shared::DeviceVertex> vertices;  ///< each combination of normal, uv and tangent once
    std::vector<glm::vec4> secondUvs;            ///< each of two vertices; empty if not needed
};

/// In the order of `pairs`, which are pairs of the geometry's triangles. Empty if `needs.records` is false.
/// Computes the tangents that are needed and not known.
VertexRecords makeVertexRecords(const Geometry& geometry, std::span<const TrianglePair> pairs,
                                const VertexNeeds& needs);

}  // namespace duolux

#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "host/bvh/pairs.h"
#include "host/device_scene/emitter_table.h"
#include "host/device_scene/surface_planes.h"
#include "host/scene/scene.h"
#include "shaders/shared/bvh_layout.h"
#include "shaders/shared/path_tracer_layout.h"

namespace duolux {

/// The records of triangles, two for each pair but in `pairs`. What no triangle of the scene needs is empty.
struct TriangleRecords {
    std::vector<shared::DevicePair> pairs;
    std::vector<shared::DeviceNormals> normals;
    std::vector<shared::DeviceColours> colours;
    std::vector<glm::vec4> planes;
};

/// In the order of `pairs`, which are pairs of the geometry's triangles. `vertexRecords`: normals are those
/// of vertices (VertexRecords), so that triangles have none.
TriangleRecords makeTriangleRecords(const Geometry& geometry, std::span<const TrianglePair> pairs,
                                    const TriangleRanks& ranks, const SurfacePlanes& surfaces,
                                    bool vertexRecords = false);

}  // namespace duolux

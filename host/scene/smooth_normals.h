#pragma once

#include <cstdint>
#include <span>

#include "host/scene/scene.h"

namespace duolux {

/// Gives shading normals to the triangles of smoothing groups: at each vertex the mean of the normals of the
/// triangles of the same group that meet there, weighted by their angles (Thürmer and Wüthrich 1998,
/// "Computing Vertex Normals from Polygonal Facets"). `groups` holds the group of each triangle, 0 for none;
/// triangles that have normals already keep them. Geometry::normalIndices must have one entry a triangle.
void addSmoothNormals(Geometry& geometry, std::span<const std::uint32_t> groups);

}  // namespace duolux

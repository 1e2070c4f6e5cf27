#pragma once

#include <cstdint>
#include <span>

#include "host/scene/scene.h"

namespace duolux {

/// Computes shading normals for the triangles of smoothing groups: at each vertex the mean of the normals of
/// the group's triangles, weighted by their angles (Thürmer and Wüthrich 1998, "Computing Vertex Normals from
/// Polygonal Facets"). `groups` holds the group of each triangle, 0 for none. Existing normals are kept.
/// Geometry::normalIndices must have one entry per triangle.
void addSmoothNormals(Geometry& geometry, std::span<const std::uint32_t> groups);

/// Computes shading normals for all triangles, smooth across edges where the normals of both triangles differ
/// by less than `crease` degrees: at each vertex the mean, weighted as above, over the triangles around it
/// that such edges connect. Triangles that stand alone at all their corners stay flat. There must be no
/// normals yet.
void addNormalsByAngle(Geometry& geometry, double crease);

}  // namespace duolux

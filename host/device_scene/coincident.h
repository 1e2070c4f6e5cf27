#pragma once

#include <cstdint>
#include <vector>

#include "host/scene/scene.h"

namespace duolux {

/// Finds groups of triangles that lie in one plane and overlap at least in part: two faces of a lamp, a
/// decal, a lamp in the plane of a ceiling. Returns for each triangle the largest triangle of its group,
/// whose plane the group shares, or the triangle itself if it has no group. Empty if there are no groups.
///
/// Triangles lie in one plane if the corners of the smaller one are within a few single-precision rounding
/// errors of the plane of the larger one. Neighbours that only share an edge or a corner do not overlap.
std::vector<std::uint32_t> coincidentGroups(const Geometry& geometry);

}  // namespace duolux

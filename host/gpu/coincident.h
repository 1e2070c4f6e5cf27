#pragma once

#include <cstdint>
#include <vector>

#include "host/scene/scene.h"

namespace duolux {

/// The groups of triangles that lie in one plane and cover the same area of it, at least in part: two faces
/// of a lamp, a decal, a lamp in the plane of a ceiling. Of each triangle the one whose plane its group
/// shares, the largest; the triangle itself if it has no group. Empty if there are no groups at all.
///
/// What counts as one plane: corners of the smaller triangle within some rounding errors of single precision
/// of the plane of the larger one. Neighbours that share an edge or a corner do not cover the same area.
std::vector<std::uint32_t> coincidentGroups(const Geometry& geometry);

}  // namespace duolux

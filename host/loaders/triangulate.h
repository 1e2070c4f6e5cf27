#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace duolux {

/// Triangulates a polygon of n >= 3 corners into exactly n - 2 triangles with its winding, appended to
/// `triangles` as indices into `corners`. Concave and slightly non-planar polygons are triangulated by ear
/// clipping. A quadrilateral is divided along the diagonal that keeps both halves on its front, or the
/// shorter one if both do. A polygon that intersects itself has no correct triangulation and gives an
/// arbitrary one. Deterministic.
void triangulate(std::span<const glm::vec3> corners, std::vector<std::array<std::uint32_t, 3>>& triangles);

}  // namespace duolux

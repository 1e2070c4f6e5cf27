#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace duolux {

/// Cuts a polygon of n >= 3 corners into exactly n - 2 triangles that keep its winding, appended to
/// `triangles` as indices into `corners`. Concave polygons and those a little out of plane are cut by ear
/// clipping; a quadrilateral along the diagonal that keeps both halves on its front, the shorter one if both
/// do. A polygon that crosses itself becomes some fan: there is no right answer. Deterministic.
void triangulate(std::span<const glm::vec3> corners, std::vector<std::array<std::uint32_t, 3>>& triangles);

}  // namespace duolux

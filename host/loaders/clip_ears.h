#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace duolux {

/// Twice the signed area of a triangle; positive: counter-clockwise.
inline double turnAt(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// Triangulates a counter-clockwise polygon into n - 2 triangles by ear clipping (Meisters 1975). Each step
/// cuts the first ear behind the previous one. If there is none (the polygon intersects itself), it cuts the
/// first straight corner, otherwise the next corner. Each corner stores the corner that prevents it from
/// being an ear, which a k-d tree finds, so that the time for n corners is about n log n.
void clipEars(const std::vector<glm::dvec2>& points, std::vector<std::array<std::uint32_t, 3>>& triangles);

}  // namespace duolux

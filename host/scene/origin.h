#pragma once

#include <glm/glm.hpp>
#include <limits>

namespace duolux {

/// Axis-aligned bounds in double precision, as coordinates in files may need it.
struct WideBounds {
    glm::dvec3 lower{std::numeric_limits<double>::infinity()};
    glm::dvec3 upper{-std::numeric_limits<double>::infinity()};

    void add(const glm::dvec3& position) {
        lower = glm::min(lower, position);
        upper = glm::max(upper, position);
    }
    bool empty() const { return lower.x > upper.x; }
    /// The largest side.
    double extent() const;
    /// The largest coordinate in magnitude.
    double reach() const;
};

/// Coordinates beyond this many times the extent of what they describe would lose too much of it as floats.
inline constexpr double kFarAway = 100.0;

/// What to take off coordinates before they become floats: nothing, unless they are far from the origin for
/// their extent, as georeferenced ones are; then a place in their middle in round numbers, which are whole
/// from an extent of 1 on.
glm::dvec3 originFor(const WideBounds& bounds);

}  // namespace duolux

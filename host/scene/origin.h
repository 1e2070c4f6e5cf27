#pragma once

#include <glm/glm.hpp>
#include <limits>
#include <span>
#include <vector>

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

/// Coordinates beyond this many times the extent of what they describe lose too much of it as floats.
inline constexpr double kFarAway = 8.0;

/// The part of a typical edge by which rounding to floats may move a vertex without notice.
inline constexpr double kUnnoticed = 1e-3;

/// How far rounding to floats moves a place, along the axis where it is most.
double roundingError(const glm::dvec3& place);

/// No rounding error of coordinates up to `reach` is larger.
double largestRoundingError(double reach);

/// 0 if there are none.
double medianOf(std::vector<double> values);

/// What to take off coordinates before they become floats: nothing, unless they are far from the origin for
/// their extent, as georeferenced ones are; then a place in their middle in round numbers, which are whole
/// from an extent of 1 on.
glm::dvec3 originFor(const WideBounds& bounds);

/// A place of a scene and how far rounding may move it.
struct OriginSample {
    glm::dvec3 place;
    double tolerance;
};

/// The same, but where rounding would move samples too far, as when a stray triangle lies far from all
/// others, a place among most of them, if at most half as many suffer there.
glm::dvec3 originFor(const WideBounds& bounds, std::span<const OriginSample> samples);

}  // namespace duolux

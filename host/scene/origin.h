#pragma once

#include <glm/glm.hpp>
#include <limits>
#include <span>
#include <vector>

namespace duolux {

/// Axis-aligned bounds in double precision, which coordinates in files may require.
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

/// Coordinates larger than this many times the extent of their object are too inaccurate as floats.
inline constexpr double kFarAway = 8.0;

/// The fraction of a typical edge by which rounding to floats may move a vertex without a warning.
inline constexpr double kUnnoticed = 1e-3;

/// The distance by which rounding to floats moves a point: the maximum over the axes.
double roundingError(const glm::dvec3& place);

/// Bound on the rounding error of coordinates up to `reach`.
double largestRoundingError(double reach);

/// 0 if there are none.
double medianOf(std::vector<double> values);

/// The origin to subtract from coordinates before they are converted to floats: 0, unless they are far from
/// the origin for their extent, as georeferenced ones are. Then it is a point in their middle, rounded (to
/// whole numbers if the extent is 1 or more).
glm::dvec3 originFor(const WideBounds& bounds);

/// A point of a scene, and the distance by which rounding may move it.
struct OriginSample {
    glm::dvec3 place;
    double tolerance;
};

/// The same, but if rounding would move samples too far (for example because a stray triangle is far from all
/// others), a point among most of the samples, if it at least halves the number of samples that move too far.
glm::dvec3 originFor(const WideBounds& bounds, std::span<const OriginSample> samples);

}  // namespace duolux

#pragma once

#include <cmath>
#include <glm/glm.hpp>
#include <limits>

namespace duolux {

/// Larger texture coordinates have no precision left.
inline constexpr double kLargestUv = 1e6;

/// Of texture coordinates that are not finite or too large.
inline constexpr glm::vec2 kBadUv{std::numeric_limits<float>::infinity()};

/// Texture coordinates of a file whose v points up the image, or kBadUv.
inline glm::vec2 uvFromBelow(double u, double v) {
    const bool isGood = std::abs(u) <= kLargestUv && std::abs(v) <= kLargestUv;
    return isGood ? glm::vec2(u, 1.0 - v) : kBadUv;
}

}  // namespace duolux

#pragma once

#include <cstdint>
#include <vector>

namespace duolux {

/// All pixels of an image (row-major indices) in the order in which they are traced: tiles of 16x16, within a
/// tile along a Morton curve, so that neighbouring lanes trace neighbouring pixels; the tiles in a scattered
/// order, so that the parts of a dispatch that different cores take cost about the same.
std::vector<std::uint32_t> pixelOrder(std::uint32_t width, std::uint32_t height);

}  // namespace duolux

#pragma once

#include <cstdint>
#include <vector>

namespace duolux {

/// All pixels of an image (row-major indices) in the order in which they are traced. Within tiles of 16x16
/// they follow a Morton curve, so that neighbouring lanes trace neighbouring pixels. The tiles are in a
/// scattered order, so that the parts of a dispatch on different cores have similar costs.
std::vector<std::uint32_t> pixelOrder(std::uint32_t width, std::uint32_t height);

}  // namespace duolux

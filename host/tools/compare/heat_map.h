#pragma once

#include <cstdint>
#include <vector>

#include "host/film/image.h"

namespace duolux {

/// An image of values from 0 (black) through blue, red and yellow to `largest` and above (white; green: not
/// finite), as the visible component, for writing as PNG.
RadianceImage heatMap(const std::vector<float>& values, std::uint32_t width, std::uint32_t height,
                      float largest);

}  // namespace duolux

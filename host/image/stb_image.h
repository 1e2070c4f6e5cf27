#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace duolux {

/// Four values per pixel, rows from the top.
struct StbPixels {
    std::uint32_t width = 0, height = 0;
    std::vector<std::uint16_t> values;
};

/// Decodes a PNG with 16 bits per channel, with stb_image. Throws InputError naming `file`.
StbPixels decodePng16(std::string_view bytes, const std::string& file);

}  // namespace duolux

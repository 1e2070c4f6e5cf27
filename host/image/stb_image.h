#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace duolux {

/// Four values per pixel, rows from the top.
template <typename Value>
struct StbPixels {
    std::uint32_t width = 0, height = 0;
    std::vector<Value> values;
};

/// Decode a JPEG, or a PNG with 16 bits per channel, with stb_image. Throw InputError naming `file`.
StbPixels<std::uint8_t> decodeJpeg(std::string_view bytes, const std::string& file);
StbPixels<std::uint16_t> decodePng16(std::string_view bytes, const std::string& file);

}  // namespace duolux

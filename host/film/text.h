#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

namespace duolux {

/// One line of text as coverage (0 to 255) per pixel; rows from the top.
struct TextBitmap {
    std::uint32_t width = 0, height = 0;
    std::vector<std::uint8_t> coverage;
};

/// Renders a line of UTF-8 text in DejaVu Sans. All lines of one `pixelHeight` (ascent to descent) have the
/// same height and baseline. Bytes that are not UTF-8 appear as replacement characters.
TextBitmap setText(std::string_view text, float pixelHeight);

/// Width of the bitmap that setText returns, in pixels.
std::uint32_t textWidth(std::string_view text, float pixelHeight);

}  // namespace duolux

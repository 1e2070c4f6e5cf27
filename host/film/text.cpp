#include "host/film/text.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "host/base/utf8.h"
#include "host/film/font.h"

#define STB_TRUETYPE_IMPLEMENTATION
#define STBTT_STATIC
#include <stb/stb_truetype.h>

namespace duolux {

namespace {

const stbtt_fontinfo& font() {
    static const stbtt_fontinfo info = [] {
        stbtt_fontinfo result{};
        stbtt_InitFont(&result, fontFile().data(), 0);
        return result;
    }();
    return info;
}

/// Calls place(codepoint, x) for each character, x in pixels; returns where the line ends.
template <typename Place>
float layOut(std::string_view text, float scale, Place place) {
    float x = 0.0f;
    const std::u32string characters = decodeUtf8(text);
    for (std::size_t i = 0; i < characters.size(); ++i) {
        const int character = static_cast<int>(characters[i]);
        place(character, x);
        int advance = 0, bearing = 0;
        stbtt_GetCodepointHMetrics(&font(), character, &advance, &bearing);
        if (i + 1 < characters.size()) {
            advance += stbtt_GetCodepointKernAdvance(&font(), character, static_cast<int>(characters[i + 1]));
        }
        x += scale * static_cast<float>(advance);
    }
    return x;
}

/// Adds one character whose origin is at (x, baseline).
void drawCharacter(TextBitmap& line, int character, float x, int baseline, float scale) {
    const float whole = std::floor(x);
    int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
    stbtt_GetCodepointBitmapBoxSubpixel(&font(), character, scale, scale, x - whole, 0.0f, &x0, &y0, &x1,
                                        &y1);
    const int width = x1 - x0, height = y1 - y0;
    if (width <= 0 || height <= 0) return;  // a space
    std::vector<std::uint8_t> glyph(static_cast<std::size_t>(width) * height);
    stbtt_MakeCodepointBitmapSubpixel(&font(), glyph.data(), width, height, width, scale, scale, x - whole,
                                      0.0f, character);
    for (int row = 0; row < height; ++row) {
        const int y = baseline + y0 + row;
        if (y < 0 || y >= static_cast<int>(line.height)) continue;
        for (int column = 0; column < width; ++column) {
            const int target = static_cast<int>(whole) + x0 + column;
            if (target < 0 || target >= static_cast<int>(line.width)) continue;
            std::uint8_t& pixel = line.coverage[static_cast<std::size_t>(y) * line.width + target];
            pixel = static_cast<std::uint8_t>(
                std::min(255, pixel + glyph[static_cast<std::size_t>(row) * width + column]));
        }
    }
}

}  // namespace

std::uint32_t textWidth(std::string_view text, float pixelHeight) {
    const float scale = stbtt_ScaleForPixelHeight(&font(), pixelHeight);
    return static_cast<std::uint32_t>(std::ceil(layOut(text, scale, [](int, float) {})));
}

TextBitmap setText(std::string_view text, float pixelHeight) {
    const float scale = stbtt_ScaleForPixelHeight(&font(), pixelHeight);
    int ascent = 0, descent = 0, gap = 0;
    stbtt_GetFontVMetrics(&font(), &ascent, &descent, &gap);
    TextBitmap line{textWidth(text, pixelHeight), static_cast<std::uint32_t>(std::ceil(pixelHeight)), {}};
    line.coverage.resize(std::size_t{line.width} * line.height);
    const int baseline = static_cast<int>(std::round(scale * static_cast<float>(ascent)));
    layOut(text, scale, [&](int character, float x) { drawCharacter(line, character, x, baseline, scale); });
    return line;
}

}  // namespace duolux

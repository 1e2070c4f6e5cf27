#include "host/film/sheet.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "host/base/srgb.h"
#include "host/base/utf8.h"
#include "host/film/codec.h"
#include "host/film/text.h"

namespace duolux {

namespace {

constexpr std::uint32_t kFrame = 1;        // pixels of the line around an image
constexpr double kFrameGrey = 0.8;         // sRGB-encoded, 0 to 1
constexpr double kInk = 0.1;               // grey of the captions, sRGB-encoded
constexpr float kSmallestCaption = 11.0f;  // pixels, ascent to descent
constexpr float kLargestCaption = 40.0f;
constexpr const char* kEllipsis = "\u2026";

struct Layout {
    std::uint32_t imageWidth, imageHeight;
    std::uint32_t columns, rows;
    std::uint32_t gap;            // around and between images
    float captionSize;            // pixels, ascent to descent
    std::uint32_t captionHeight;  // captionSize in whole pixels

    std::uint32_t cellWidth() const { return imageWidth + gap; }
    std::uint32_t cellHeight() const { return imageHeight + captionGap() + captionHeight + gap; }
    std::uint32_t captionGap() const { return gap / 2; }
    std::uint32_t width() const { return gap + columns * cellWidth(); }
    std::uint32_t height() const { return gap + rows * cellHeight(); }
};

/// The size at which the widest caption fits below its image, limited to kSmallestCaption..kLargestCaption.
float captionSizeFor(std::span<const SheetCell> cells, std::uint32_t imageWidth) {
    const float wanted =
        std::clamp(static_cast<float>(imageWidth) / 14.0f, kSmallestCaption, kLargestCaption);
    std::uint32_t widest = 1;
    for (const SheetCell& cell : cells)
        widest = std::max(widest, textWidth(cell.caption, wanted));
    const float fits = wanted * static_cast<float>(imageWidth) / static_cast<float>(widest);
    return std::max(kSmallestCaption, std::floor(std::min(wanted, fits)));
}

Layout layOut(std::span<const SheetCell> cells, std::uint32_t columns) {
    const RadianceImage& first = cells.front().image;
    const auto count = static_cast<std::uint32_t>(cells.size());
    Layout layout{};
    layout.imageWidth = first.width;
    layout.imageHeight = first.height;
    layout.columns = std::min(columns, count);
    layout.rows = (count + layout.columns - 1) / layout.columns;
    layout.gap = std::clamp(first.width / 20, 8u, 48u);
    layout.captionSize = captionSizeFor(cells, first.width);
    layout.captionHeight = static_cast<std::uint32_t>(std::ceil(layout.captionSize));
    return layout;
}

/// The text, or the part of its beginning that fits with an ellipsis.
std::string shorten(std::string text, float size, std::uint32_t width) {
    if (textWidth(text, size) <= width) return text;
    while (!text.empty() && textWidth(text + kEllipsis, size) > width) {
        while (text.size() > 1 && continuesUtf8(text.back()))
            text.pop_back();
        text.pop_back();
    }
    return text + kEllipsis;
}

void fill(RadianceImage& sheet, std::uint32_t x0, std::uint32_t y0, std::uint32_t width, std::uint32_t height,
          float value) {
    for (std::uint32_t y = y0; y < y0 + height; ++y) {
        std::fill_n(sheet.visible.begin() + static_cast<std::ptrdiff_t>(std::size_t{y} * sheet.width + x0),
                    width, glm::vec3(value));
    }
}

void paste(RadianceImage& sheet, const RadianceImage& image, std::uint32_t x0, std::uint32_t y0) {
    for (std::uint32_t y = 0; y < image.height; ++y) {
        std::copy_n(
            image.visible.begin() + static_cast<std::ptrdiff_t>(std::size_t{y} * image.width), image.width,
            sheet.visible.begin() + static_cast<std::ptrdiff_t>(std::size_t{y0 + y} * sheet.width + x0));
    }
}

/// Draws dark text on the white sheet, clipped at its right edge. Blending encoded values keeps thin strokes
/// dark.
void drawText(RadianceImage& sheet, const TextBitmap& text, std::uint32_t x0, std::uint32_t y0) {
    for (std::uint32_t y = 0; y < text.height; ++y) {
        for (std::uint32_t x = 0; x < std::min(text.width, sheet.width - x0); ++x) {
            const double coverage = text.coverage[std::size_t{y} * text.width + x] / 255.0;
            sheet.visible[std::size_t{y0 + y} * sheet.width + x0 + x] =
                glm::vec3(static_cast<float>(srgbDecode(1.0 + coverage * (kInk - 1.0))));
        }
    }
}

}  // namespace

RadianceImage makeSheet(std::span<const SheetCell> cells, std::uint32_t columns) {
    assert(!cells.empty() && columns > 0);
    const Layout layout = layOut(cells, columns);
    RadianceImage sheet = makeImage(layout.width(), layout.height());
    fill(sheet, 0, 0, sheet.width, sheet.height, 1.0f);
    for (std::uint32_t i = 0; i < cells.size(); ++i) {
        const SheetCell& cell = cells[i];
        assert(cell.image.width == layout.imageWidth && cell.image.height == layout.imageHeight);
        const std::uint32_t x = layout.gap + i % layout.columns * layout.cellWidth();
        const std::uint32_t y = layout.gap + i / layout.columns * layout.cellHeight();
        fill(sheet, x - kFrame, y - kFrame, layout.imageWidth + 2 * kFrame, layout.imageHeight + 2 * kFrame,
             static_cast<float>(srgbDecode(kFrameGrey)));
        paste(sheet, cell.image, x, y);
        const TextBitmap text =
            setText(shorten(cell.caption, layout.captionSize, layout.imageWidth), layout.captionSize);
        // The image may be too narrow even for the ellipsis.
        const std::uint32_t left = x + layout.imageWidth / 2 - std::min(text.width, layout.imageWidth) / 2;
        drawText(sheet, text, left, y + layout.imageHeight + layout.captionGap());
    }
    return sheet;
}

}  // namespace duolux

#include <gtest/gtest.h>

#include <algorithm>

#include "host/film/sheet.h"
#include "host/film/text.h"
#include "tests/unit/film_samples.h"

namespace duolux {
namespace {

using test::plainImage;

const glm::vec3 kRed{1.0f, 0.0f, 0.0f};
const glm::vec3 kGreen{0.0f, 1.0f, 0.0f};
const glm::vec3 kBlue{0.0f, 0.0f, 1.0f};

struct Box {
    std::uint32_t left = ~0u, top = ~0u, right = 0, bottom = 0;  ///< inclusive
    std::uint64_t pixels = 0;
};

template <typename Predicate>
Box boxOf(const RadianceImage& image, Predicate predicate) {
    Box box;
    for (std::uint32_t y = 0; y < image.height; ++y) {
        for (std::uint32_t x = 0; x < image.width; ++x) {
            if (!predicate(image.visible[y * image.width + x], x, y)) continue;
            box.left = std::min(box.left, x);
            box.right = std::max(box.right, x);
            box.top = std::min(box.top, y);
            box.bottom = std::max(box.bottom, y);
            ++box.pixels;
        }
    }
    return box;
}

Box boxOfColour(const RadianceImage& image, glm::vec3 colour) {
    return boxOf(image, [&](glm::vec3 value, std::uint32_t, std::uint32_t) { return value == colour; });
}

/// Where there is dark grey ink below row `top`.
Box inkBelow(const RadianceImage& image, std::uint32_t top) {
    return boxOf(image, [&](glm::vec3 v, std::uint32_t, std::uint32_t y) {
        return y > top && v.r < 0.4f && v.r == v.g && v.g == v.b;
    });
}

TEST(Sheet, KeepsEveryPixelInRowsOfTheGivenLength) {
    const SheetCell cells[] = {
        {plainImage(64, 32, kRed), "r"}, {plainImage(64, 32, kGreen), "g"}, {plainImage(64, 32, kBlue), "b"}};
    const RadianceImage sheet = makeSheet(cells, 2);
    const Box red = boxOfColour(sheet, kRed), green = boxOfColour(sheet, kGreen),
              blue = boxOfColour(sheet, kBlue);
    for (const Box& box : {red, green, blue}) {
        EXPECT_EQ(box.pixels, 64u * 32u);
        EXPECT_EQ(box.right - box.left + 1, 64u);
        EXPECT_EQ(box.bottom - box.top + 1, 32u);
    }
    EXPECT_EQ(red.top, green.top);
    EXPECT_GT(green.left, red.right);
    EXPECT_EQ(blue.left, red.left);
    EXPECT_GT(blue.top, red.bottom);
    // Margins are even: the same at the left and at the right.
    EXPECT_EQ(red.left, sheet.width - 1 - green.right);
}

TEST(Sheet, HasNoMoreColumnsThanImages) {
    const SheetCell cells[] = {{plainImage(16, 16, kRed), ""}, {plainImage(16, 16, kGreen), ""}};
    const RadianceImage wide = makeSheet(cells, 100), two = makeSheet(cells, 2);
    EXPECT_EQ(wide.width, two.width);
    EXPECT_EQ(wide.height, two.height);
}

TEST(Sheet, CentresTheCaptionBelowItsImage) {
    const SheetCell cells[] = {{plainImage(200, 40, kRed), "(a) global"}};
    const RadianceImage sheet = makeSheet(cells, 1);
    const Box image = boxOfColour(sheet, kRed);
    const Box ink = inkBelow(sheet, image.bottom);
    ASSERT_GT(ink.pixels, 50u);
    EXPECT_GT(ink.top, image.bottom + 2);
    EXPECT_LT(ink.bottom, sheet.height - 2);
    EXPECT_NEAR((ink.left + ink.right) / 2.0, (image.left + image.right) / 2.0, 2.0);
}

TEST(Sheet, ShortensACaptionThatDoesNotFit) {
    const SheetCell cells[] = {{plainImage(48, 16, kRed), "a caption far too long for so small an image"}};
    const RadianceImage sheet = makeSheet(cells, 1);
    const Box image = boxOfColour(sheet, kRed);
    const Box ink = inkBelow(sheet, image.bottom);
    EXPECT_GE(ink.left, image.left);
    EXPECT_LE(ink.right, image.right);
    EXPECT_GT(ink.right - ink.left, 24u);
}

TEST(Sheet, TakesImagesOfOnePixel) {
    const SheetCell cells[] = {{plainImage(1, 1, kRed), "caption"}, {plainImage(1, 1, kGreen), ""}};
    const RadianceImage sheet = makeSheet(cells, 2);
    EXPECT_EQ(boxOfColour(sheet, kRed).pixels, 1u);
    EXPECT_EQ(boxOfColour(sheet, kGreen).pixels, 1u);
}

TEST(Text, GrowsWithTheTextAndTheSize) {
    EXPECT_EQ(textWidth("", 20.0f), 0u);
    EXPECT_LT(textWidth("i", 20.0f), textWidth("m", 20.0f));
    EXPECT_LT(textWidth("one", 20.0f), textWidth("one-bounce", 20.0f));
    EXPECT_NEAR(textWidth("one-bounce", 40.0f), 2.0 * textWidth("one-bounce", 20.0f), 2.0);
    const TextBitmap text = setText("one-bounce", 20.0f);
    EXPECT_EQ(text.width, textWidth("one-bounce", 20.0f));
    EXPECT_EQ(text.height, 20u);
    EXPECT_EQ(text.coverage.size(), std::size_t{text.width} * text.height);
    EXPECT_GT(*std::ranges::max_element(text.coverage), 200);
}

TEST(Text, TakesAnyBytes) {
    EXPECT_GT(setText("\xFF\xC3(\n\x01", 20.0f).width, 0u);
    EXPECT_GT(setText("\xCF\x81 = \xC2\xBD", 20.0f).width, 0u);
}

}  // namespace
}  // namespace duolux

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <png.h>

#include <cmath>
#include <cstdint>
#include <functional>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "host/image/convert.h"
#include "host/image/decode.h"
#include "tests/unit/image_files.h"

// Images of other quantities than the textures that they become.

namespace duolux::test {
namespace {

using testing::ElementsAre;
using Kind = ImageConversion::Kind;

/// Grey, of floats; `height`: of u and v at the centres of pixels, v down the image.
Image heights(std::uint32_t width, std::uint32_t height, const std::function<double(double, double)>& at) {
    Image image;
    image.width = width;
    image.height = height;
    for (std::uint32_t y = 0; y < height; ++y) {
        for (std::uint32_t x = 0; x < width; ++x) {
            const auto h = static_cast<float>(at((x + 0.5) / width, (y + 0.5) / height));
            image.floats.insert(image.floats.end(), {h, h, h, 1.0f});
        }
    }
    return image;
}

glm::dvec3 normalAt(const Image& image, std::uint32_t x, std::uint32_t y) {
    const float* const pixel = &image.floats[4 * (std::size_t{y} * image.width + x)];
    EXPECT_EQ(pixel[3], 1.0f);
    return {2.0 * static_cast<double>(pixel[0]) - 1.0, 2.0 * static_cast<double>(pixel[1]) - 1.0,
            2.0 * static_cast<double>(pixel[2]) - 1.0};
}

/// A surface 1 wide and high whose points are raised by 0.02 h has the normal along the cross product of its
/// tangents.
TEST(ImageConvert, HeightsBecomeNormalsOfTheRaisedSurface) {
    constexpr double kTurn = 2.0 * std::numbers::pi;
    const auto wave = [&](double u, double v) {
        return 0.5 + 0.3 * std::sin(kTurn * u) + 0.2 * std::cos(2.0 * kTurn * v);
    };
    Image image = heights(256, 512, wave);
    convert(image, {.kind = Kind::kHeights, .channel = ImageConversion::kLuminance});
    ASSERT_EQ(image.floats.size(), 4u * 256 * 512);
    for (const std::uint32_t x : {0u, 17u, 100u, 255u}) {
        for (const std::uint32_t y : {0u, 5u, 300u, 511u}) {
            const double u = (x + 0.5) / 256, v = (y + 0.5) / 512;
            // In the axes (u, -v, up).
            const glm::dvec3 alongU(1.0, 0.0, 0.02 * 0.3 * kTurn * std::cos(kTurn * u));
            const glm::dvec3 alongV(0.0, -1.0, -0.02 * 0.2 * 2.0 * kTurn * std::sin(2.0 * kTurn * v));
            const glm::dvec3 expected = glm::normalize(glm::cross(alongV, alongU));
            EXPECT_LT(glm::length(normalAt(image, x, y) - expected), 1e-3) << x << " " << y;
        }
    }
}

TEST(ImageConvert, EdgesRepeatOrEnd) {
    // A ramp, whose ends differ where it repeats.
    const auto ramp = [](double u, double) { return u; };
    Image repeated = heights(64, 1, ramp), ended = repeated;
    convert(repeated, {.kind = Kind::kHeights});
    convert(ended, {.kind = Kind::kHeights, .repeats = false});
    const glm::dvec3 slope = glm::normalize(glm::dvec3(-0.02, 0.0, 1.0));
    for (const std::uint32_t x : {0u, 1u, 62u, 63u})
        EXPECT_LT(glm::length(normalAt(ended, x, 0) - slope), 1e-6) << x;
    EXPECT_LT(glm::length(normalAt(repeated, 30, 0) - slope), 1e-6);
    EXPECT_GT(normalAt(repeated, 0, 0).x, 0.1) << "falls from 1 to 0";
    Image pixel = heights(1, 1, ramp);
    convert(pixel, {.kind = Kind::kHeights});
    EXPECT_EQ(normalAt(pixel, 0, 0), glm::dvec3(0, 0, 1));
}

TEST(ImageConvert, HeightsAreInTheirChannel) {
    const auto decoded = [](std::uint32_t channel, int type, const std::vector<std::uint16_t>& values) {
        ImageSource source{"a.png", {}, std::make_shared<const std::string>(pngOf(2, 1, 8, type, values))};
        source.conversion = {.kind = Kind::kHeights, .channel = channel, .repeats = false};
        return normalAt(*decodeImage(source).image, 0, 0);
    };
    const std::vector<std::uint16_t> values{0, 0, 0, 255, 255, 51, 0, 102};
    const auto slope = [](double s) {
        return glm::normalize(glm::dvec3(-0.04 * s, 0, 1));
    };  // over half a unit
    const auto expect = [&](std::uint32_t channel, double s) {
        EXPECT_LT(glm::length(decoded(channel, PNG_COLOR_TYPE_RGB_ALPHA, values) - slope(s)), 1e-6)
            << channel;
    };
    expect(0, 1.0);
    expect(1, 0.2);
    expect(2, 0.0);
    expect(3, -0.6);
    expect(ImageConversion::kLuminance, 0.2126 + 0.2 * 0.7152);
}

TEST(ImageConvert, ImagesOfNormalsStayAsTheyAre) {
    Image normals;
    normals.width = 40;
    normals.height = 1;
    for (int i = 0; i < 40; ++i) {
        const double angle = 0.02 * i;
        const auto byte = [](double n) { return static_cast<std::uint8_t>(std::lround(127.5 * (n + 1.0))); };
        normals.bytes.insert(normals.bytes.end(),
                             {byte(std::sin(angle)), byte(0), byte(std::cos(angle)), 255});
    }
    EXPECT_TRUE(hasNormals(normals));
    const std::vector<std::uint8_t> before = normals.bytes;
    convert(normals, {.kind = Kind::kHeights});
    EXPECT_EQ(normals.bytes, before);
    EXPECT_TRUE(normals.floats.empty());
    // Grey of this brightness has the length of a unit vector, too.
    EXPECT_FALSE(hasNormals(heights(4, 4, [](double, double) { return 0.5 + 0.5 / std::sqrt(3.0); })));
    EXPECT_FALSE(hasNormals(heights(4, 4, [](double u, double) { return u; })));
    Image blue = normals;
    for (std::size_t i = 0; i < blue.bytes.size(); i += 4)
        blue.bytes[i] = 0, blue.bytes[i + 1] = 0;
    EXPECT_FALSE(hasNormals(blue));
}

/// Kinds of pixels of one image of bytes: red is the quantity.
std::vector<std::uint8_t> convertedReds(const std::vector<std::uint16_t>& reds,
                                        const ImageConversion& conversion) {
    std::vector<std::uint16_t> values;
    for (const std::uint16_t red : reds)
        values.insert(values.end(), {red, 0, 99});
    ImageSource source{"a.png", {}, nullptr};
    source.bytes = std::make_shared<const std::string>(
        pngOf(static_cast<std::uint32_t>(reds.size()), 1, 8, PNG_COLOR_TYPE_RGB, values));
    source.conversion = conversion;
    const DecodedImage decoded = decodeImage(source);
    std::vector<std::uint8_t> result;
    for (std::size_t i = 0; i < decoded.image->bytes.size(); i += 4)
        result.push_back(decoded.image->bytes[i]);
    return result;
}

TEST(ImageConvert, ExponentsBecomeRoughness) {
    const auto expected = [](double exponent) {
        return static_cast<std::uint8_t>(std::lround(255.0 * std::sqrt(std::sqrt(2.0 / (exponent + 2.0)))));
    };
    ImageConversion conversion{.kind = Kind::kExponents, .factor = 250.0f};
    EXPECT_THAT(convertedReds({0, 51, 255}, conversion), ElementsAre(255, expected(50), expected(250)));
    conversion.mirrorFrom = 100.0f;
    EXPECT_THAT(convertedReds({0, 51, 102, 255}, conversion), ElementsAre(255, expected(50), 0, 0));
}

TEST(ImageConvert, GlossinessBecomesRoughness) {
    EXPECT_THAT(convertedReds({0, 51, 255}, {.kind = Kind::kGlossiness, .factor = 0.5f}),
                ElementsAre(255, 230, 128));
}

TEST(ImageConvert, BaseAndGainComeFirst) {
    EXPECT_THAT(convertedReds({0, 51, 255}, {.base = 0.2f, .gain = 2.0f}), ElementsAre(51, 153, 255));
    EXPECT_THAT(convertedReds({0, 255}, {.base = 1.0f, .gain = -1.0f}), ElementsAre(255, 0));
    EXPECT_THAT(convertedReds({255}, {.kind = Kind::kGlossiness, .gain = 0.4f}), ElementsAre(153));
}

}  // namespace
}  // namespace duolux::test

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <png.h>

#include <array>
#include <cmath>
#include <limits>

#include "host/base/error.h"
#include "host/base/file.h"
#include "host/cli/temporary_folder.h"
#include "host/image/decode.h"
#include "tests/unit/image_files.h"

// Images that the test itself writes, of every format and depth; damaged ones; and headers that lie.

namespace duolux::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

ImageSource embedded(std::string bytes) {
    return {"model.glb: image 3", {}, std::make_shared<const std::string>(std::move(bytes))};
}

Image decode(std::string bytes) {
    return *decodeImage(embedded(std::move(bytes))).image;
}

std::string failureOf(std::string bytes) {
    try {
        decodeImage(embedded(std::move(bytes)));
    } catch (const InputError& error) {
        return error.what();
    }
    return "none";
}

TEST(ImageDecode, Png8) {
    const std::vector<std::uint16_t> rgba{1, 2, 3, 4, 250, 251, 252, 253};
    const Image image = decode(pngOf(2, 1, 8, PNG_COLOR_TYPE_RGB_ALPHA, rgba));
    EXPECT_EQ(image.width, 2u);
    EXPECT_EQ(image.height, 1u);
    EXPECT_EQ(image.name, "model.glb: image 3");
    EXPECT_TRUE(image.floats.empty());
    EXPECT_THAT(image.bytes, ElementsAre(1, 2, 3, 4, 250, 251, 252, 253));
    EXPECT_THAT(decode(pngOf(1, 2, 8, PNG_COLOR_TYPE_RGB, {9, 8, 7, 6, 5, 4})).bytes,
                ElementsAre(9, 8, 7, 255, 6, 5, 4, 255));
    EXPECT_THAT(decode(pngOf(2, 1, 8, PNG_COLOR_TYPE_GRAY, {9, 200})).bytes,
                ElementsAre(9, 9, 9, 255, 200, 200, 200, 255));
    EXPECT_THAT(decode(pngOf(1, 1, 8, PNG_COLOR_TYPE_GRAY_ALPHA, {9, 77})).bytes, ElementsAre(9, 9, 9, 77));
    EXPECT_THAT(decode(pngOf(3, 1, 8, PNG_COLOR_TYPE_PALETTE, {0, 1, 2})).bytes,
                ElementsAre(10, 20, 30, 255, 40, 50, 60, 128, 70, 80, 90, 255));
}

TEST(ImageDecode, Png16IsInFractions) {
    const DecodedImage decoded =
        decodeImage(embedded(pngOf(1, 2, 16, PNG_COLOR_TYPE_RGB, {0, 1, 65535, 256, 32768, 255})));
    EXPECT_FALSE(decoded.linear);
    EXPECT_TRUE(decoded.image->bytes.empty());
    const auto fraction = [](float value) { return value / 65535.0f; };
    EXPECT_THAT(decoded.image->floats, ElementsAre(0.0f, fraction(1), 1.0f, 1.0f, fraction(256),
                                                   fraction(32768), fraction(255), 1.0f));
    EXPECT_THAT(decode(pngOf(1, 1, 16, PNG_COLOR_TYPE_GRAY, {4660})).floats,
                ElementsAre(fraction(4660), fraction(4660), fraction(4660), 1.0f));
}

TEST(ImageDecode, Jpeg) {
    // Blocks of one colour each, so that compression changes little.
    std::vector<std::uint8_t> rgb;
    for (int y = 0; y < 16; ++y) {
        for (int x = 0; x < 32; ++x) {
            const bool left = x < 16;
            rgb.insert(rgb.end(), {static_cast<std::uint8_t>(left ? 200 : 30), 100,
                                   static_cast<std::uint8_t>(left ? 40 : 220)});
        }
    }
    const Image image = decode(jpegOf(32, 16, rgb));
    ASSERT_EQ(image.bytes.size(), 4u * 32 * 16);
    for (std::size_t i = 0; i < rgb.size() / 3; ++i) {
        for (std::size_t c = 0; c < 3; ++c)
            ASSERT_NEAR(image.bytes[4 * i + c], rgb[3 * i + c], 3) << i;
        ASSERT_EQ(image.bytes[4 * i + 3], 255);
    }
}

TEST(ImageDecode, JpegOfInks) {
    // Cyan, magenta, yellow and black as fractions of 255: light is what each lets through.
    const Image image = decode(cmykJpegOf(8, 8, {0, 51, 102, 51}));
    ASSERT_EQ(image.bytes.size(), 4u * 64);
    EXPECT_NEAR(image.bytes[0], 255 * 1.0 * 0.8, 2);
    EXPECT_NEAR(image.bytes[1], 255 * 0.8 * 0.8, 2);
    EXPECT_NEAR(image.bytes[2], 255 * 0.6 * 0.8, 2);
    EXPECT_EQ(image.bytes[3], 255);
}

TEST(ImageDecode, DamagedJpegs) {
    std::vector<std::uint8_t> noise(std::size_t{3} * 64 * 64);
    for (std::size_t i = 0; i < noise.size(); ++i)
        noise[i] = static_cast<std::uint8_t>(i * i * 31 >> 5);
    const std::string jpeg = jpegOf(64, 64, noise);
    EXPECT_EQ(failureOf(jpeg.substr(0, jpeg.size() - 2)), "none") << "only the marker of the end is missing";
    for (std::size_t size = 2; size < jpeg.size() - 100; size += 53)
        EXPECT_THAT(failureOf(jpeg.substr(0, size)), HasSubstr("is not a readable JPEG image")) << size;
    // A table of codes that lists more than there are: 255 of each length.
    std::string table = jpeg;
    const std::size_t at = table.find("\xff\xc4");
    ASSERT_NE(at, std::string::npos);
    table.replace(at + 5, 16, std::string(16, '\xff'));
    EXPECT_THAT(failureOf(table), HasSubstr("Bogus Huffman table"));
}

TEST(ImageDecode, HdrIsLinear) {
    // Mantissas over 256 times 2^(exponent - 128).
    const DecodedImage decoded = decodeImage(embedded(hdrOf(2, 1, {128, 64, 32, 129, 255, 0, 1, 138})));
    EXPECT_TRUE(decoded.linear);
    EXPECT_THAT(decoded.image->floats, ElementsAre(1.0f, 0.5f, 0.25f, 1.0f, 1020.0f, 0.0f, 4.0f, 1.0f));
}

/// Rows compressed by channel, and runs of pixels as in older files.
TEST(ImageDecode, HdrRowsMayBeCompressed) {
    const std::uint8_t run = 128 + 7;
    const Image image = decode(hdrOf(
        8, 2, {2, 2, 0, 8,   run, 128, 1, 64, 8, 1, 2, 3,  4, 5, 6, 7, 8, 128 + 8, 0, run, 129, 1, 130,  //
               9, 9, 9, 136, 1,   1,   1, 6,  0, 0, 5, 136}));
    ASSERT_EQ(image.floats.size(), 4u * 16);
    for (std::size_t x = 0; x < 8; ++x) {
        const float unit = x < 7 ? 2.0f / 256.0f : 4.0f / 256.0f;
        EXPECT_EQ(image.floats[4 * x], (x < 7 ? 128.0f : 64.0f) * unit) << x;
        EXPECT_EQ(image.floats[4 * x + 1], static_cast<float>(x + 1) * unit) << x;
        EXPECT_EQ(image.floats[4 * x + 2], 0.0f) << x;
        EXPECT_EQ(image.floats[4 * (8 + x)], x < 7 ? 9.0f : 0.0f) << x;
        EXPECT_EQ(image.floats[4 * (8 + x) + 2], x < 7 ? 9.0f : 5.0f) << x;
    }
    EXPECT_THAT(failureOf(hdrOf(8, 1, {2, 2, 0, 8, 128 + 9, 1})), HasSubstr("a run beyond the end of a row"));
    EXPECT_THAT(failureOf(hdrOf(8, 1, {1, 1, 1, 3})), HasSubstr("a run beyond the end of a row"));
    EXPECT_THAT(failureOf(hdrOf(8, 1, {2, 2, 0, 9})), HasSubstr("has a row of another width"));
}

TEST(ImageDecode, ExrIsLinear) {
    for (const bool half : {false, true}) {
        const DecodedImage rgb = decodeImage(embedded(exrOf(2, 1, "BGR", half, {3, 2, 1, -6, 0.5f, 4})));
        EXPECT_TRUE(rgb.linear);
        EXPECT_THAT(rgb.image->floats, ElementsAre(1, 2, 3, 1, 4, 0.5f, -6, 1));
        EXPECT_THAT(decode(exrOf(1, 2, "ABGR", half, {0.25f, 3, 2, 1, 0.75f, 6, 5, 4})).floats,
                    ElementsAre(1, 2, 3, 0.25f, 4, 5, 6, 0.75f));
        EXPECT_THAT(decode(exrOf(1, 1, "Y", half, {7})).floats, ElementsAre(7, 7, 7, 1));
        EXPECT_THAT(decode(exrOf(1, 1, "AY", half, {0.5f, 7})).floats, ElementsAre(7, 7, 7, 0.5f));
    }
    EXPECT_THAT(failureOf(exrOf(1, 1, "Z", false, {7})),
                HasSubstr("model.glb: image 3: has no colour channels; expected R, G, B, or Y"));
}

TEST(ImageDecode, NonFiniteValuesAreZero) {
    const float infinity = std::numeric_limits<float>::infinity();
    const DecodedImage decoded =
        decodeImage(embedded(exrOf(1, 1, "BGR", false, {infinity, std::nanf(""), 1.0f})));
    EXPECT_EQ(decoded.nonFinite, 2u);
    EXPECT_THAT(decoded.image->floats, ElementsAre(1, 0, 0, 1));
}

TEST(ImageDecode, FilesAreReadWhateverTheirNames) {
    const TemporaryFolder folder;
    writeFile(folder / "a.jpg", pngOf(1, 1, 8, PNG_COLOR_TYPE_RGB, {1, 2, 3}));
    EXPECT_THAT(decodeImage({"a.jpg", folder / "a.jpg", nullptr}).image->bytes, ElementsAre(1, 2, 3, 255));
    EXPECT_THROW(decodeImage({"b.png", folder / "b.png", nullptr}), InputError);
}

TEST(ImageDecode, WhatIsNoImageIsRefused) {
    EXPECT_THAT(failureOf("GIF89a..."),
                HasSubstr("model.glb: image 3: is not an image of a known format; expected PNG, JPEG"));
    EXPECT_THAT(failureOf(""), HasSubstr("model.glb: image 3: is empty"));
}

/// Any beginning of a file is refused, or, of formats that allow it, completed.
TEST(ImageDecode, TruncatedFilesAreRefused) {
    const std::vector<std::uint16_t> values(4 * 8 * 8, 77);
    for (const std::string& whole :
         {pngOf(8, 8, 8, PNG_COLOR_TYPE_RGB_ALPHA, values), pngOf(8, 8, 16, PNG_COLOR_TYPE_RGB_ALPHA, values),
          exrOf(8, 8, "BGR", true, std::vector<float>(3 * 8 * 8, 0.5f))}) {
        for (std::size_t size = 4; size < whole.size() - 12; size += 3)
            EXPECT_NE(failureOf(whole.substr(0, size)), "none") << size;
    }
    const std::string hdr = hdrOf(8, 8, std::vector<std::uint8_t>(4 * 8 * 8, 77));
    for (std::size_t size = 2; size < hdr.size(); ++size)
        EXPECT_NE(failureOf(hdr.substr(0, size)), "none") << size;
}

/// Headers of 60000 x 60000 pixels on small files.
TEST(ImageDecode, HeadersThatLieAreRefused) {
    std::string png16 = pngOf(8, 8, 16, PNG_COLOR_TYPE_RGB, std::vector<std::uint16_t>(3 * 8 * 8, 5));
    for (std::size_t side : {16u, 20u})
        png16.replace(side, 4, std::string("\0\0\xea\x60", 4));
    EXPECT_THAT(failureOf(png16), HasSubstr("claims 60000 x 60000 pixels"));
    std::string jpeg = jpegOf(8, 8, std::vector<std::uint8_t>(3 * 8 * 8, 5));
    const std::size_t frame = jpeg.find("\xff\xc0");
    ASSERT_NE(frame, std::string::npos);
    jpeg.replace(frame + 5, 4, "\xea\x60\xea\x60");
    EXPECT_THAT(failureOf(jpeg), HasSubstr("claims 60000 x 60000 pixels"));
    EXPECT_THAT(failureOf(hdrOf(60000, 60000, {1, 2, 3, 4})), HasSubstr("claims 60000 x 60000 pixels"));
}

}  // namespace
}  // namespace duolux::test

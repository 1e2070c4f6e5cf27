// Round trips through the image formats, and the contents of the files as other programs read them.
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <png.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "host/base/file.h"
#include "host/base/srgb.h"
#include "host/film/codec.h"
#include "host/film/image.h"
#include "tests/unit/film_samples.h"

namespace duolux {
namespace {

using test::encoded;
using test::plainImage;
using test::sameBits;
using test::variedImage;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

TEST(Srgb, HasTheStandardsValues) {
    // IEC 61966-2-1: the linear segment, the join, and points computed with 30 digits.
    EXPECT_DOUBLE_EQ(srgbEncode(0.0), 0.0);
    EXPECT_NEAR(srgbEncode(0.001), 0.01292, 1e-15);
    EXPECT_NEAR(srgbEncode(0.0031308), 0.040449936, 1e-9);
    EXPECT_NEAR(srgbEncode(0.18), 0.461356129500442, 1e-12);
    EXPECT_NEAR(srgbEncode(0.5), 0.735356983052450, 1e-12);
    EXPECT_DOUBLE_EQ(srgbEncode(1.0), 1.0);
    EXPECT_NEAR(srgbDecode(0.5), 0.214041140482233, 1e-12);
    EXPECT_NEAR(srgbDecode(0.04), 0.04 / 12.92, 1e-15);
}

TEST(Srgb, RoundsToTheNearestCode) {
    EXPECT_EQ(toSrgb8(0.5), 188);   // 187.516
    EXPECT_EQ(toSrgb8(0.18), 118);  // 117.646
    EXPECT_EQ(toSrgb8(0.001), 3);   // 3.295
    for (int code = 0; code < 256; ++code)
        EXPECT_EQ(toSrgb8(fromSrgb8(static_cast<std::uint8_t>(code))), code);
    for (int code = 0; code < 255; ++code) {
        const double halfway = srgbDecode((code + 0.5) / 255.0);
        EXPECT_EQ(toSrgb8(halfway * (1.0 - 1e-9)), code);
        EXPECT_EQ(toSrgb8(halfway * (1.0 + 1e-9)), code + 1);
    }
}

TEST(Srgb, ClampsAndTakesNanAsBlack) {
    EXPECT_EQ(toSrgb8(-1.0), 0);
    EXPECT_EQ(toSrgb8(1.0), 255);
    EXPECT_EQ(toSrgb8(7.0), 255);
    EXPECT_EQ(toSrgb8(static_cast<double>(kInfinity)), 255);
    EXPECT_EQ(toSrgb8(-static_cast<double>(kInfinity)), 0);
    EXPECT_EQ(toSrgb8(static_cast<double>(kNan)), 0);
}

TEST(Image, DisplayedIsTheInnerProduct) {
    RadianceImage image = plainImage(1, 1, {1.0f, 2.0f, 3.0f});
    image.invisible[0] = {10.0f, 20.0f, 30.0f};
    EXPECT_EQ(image.displayed({0.0f, 1.0f})[0], glm::vec3(1.0f, 2.0f, 3.0f));
    EXPECT_EQ(image.displayed({0.5f, 2.0f})[0], glm::vec3(7.0f, 14.0f, 21.0f));
}

TEST(Image, KnowsItsExtensionsInAnyCase) {
    for (const char* name : {"a.exr", "a.EXR", "dir.x/a.Png", ".hidden.pfm"})
        EXPECT_TRUE(isImagePath(name)) << name;
    for (const char* name : {"a", "a.jpg", "exr", ".exr", "a.exr.gz", ""})
        EXPECT_FALSE(isImagePath(name)) << name;
}

TEST(Exr, RoundTripKeepsEveryBitOfBothComponents) {
    const TemporaryFolder folder;
    RadianceImage image = variedImage(37, 53);
    image.visible[5] = {kNan, kInfinity, -kInfinity};
    image.invisible[6] = {-0.0f, std::numeric_limits<float>::denorm_min(), std::numeric_limits<float>::max()};
    writeImage(folder / "a.exr", image, {});
    const RadianceImage back = readImage(folder / "a.exr");
    EXPECT_EQ(back.width, 37u);
    EXPECT_EQ(back.height, 53u);
    EXPECT_TRUE(sameBits(back.visible, image.visible));
    EXPECT_TRUE(sameBits(back.invisible, image.invisible));
}

TEST(Exr, HoldsTheDisplayedValuesAndMetadata) {
    const TemporaryFolder folder;
    const RadianceImage image = variedImage(8, 4);
    ImageOptions options;
    options.display = {0.25f, 1.0f};
    options.exposure = 3.0f;  // must not matter: the file is scene-referred
    options.metadata = {{"duolux:preset", "one-bounce"}, {"duolux:note", "caf\xC3\xA9"}};
    writeImage(folder / "a.exr", image, options);

    Imf::InputFile file((folder / "a.exr").c_str());
    const Imf::Header& header = file.header();
    EXPECT_EQ(header.typedAttribute<Imf::StringAttribute>("duolux:preset").value(), "one-bounce");
    EXPECT_EQ(header.typedAttribute<Imf::StringAttribute>("duolux:note").value(), "caf\xC3\xA9");
    EXPECT_EQ(header.compression(), Imf::ZIP_COMPRESSION);
    std::vector<std::string> names;
    for (auto it = header.channels().begin(); it != header.channels().end(); ++it) {
        names.emplace_back(it.name());
        EXPECT_EQ(it.channel().type, Imf::FLOAT);
    }
    EXPECT_THAT(names, testing::UnorderedElementsAre("R", "G", "B", "invisible.R", "invisible.G",
                                                     "invisible.B", "visible.R", "visible.G", "visible.B"));
    std::vector<float> green(32);
    Imf::FrameBuffer frame;
    frame.insert("G", Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(green.data()), 4, 4 * 8));
    file.setFrameBuffer(frame);
    file.readPixels(0, 3);
    const auto displayed = image.displayed({0.25f, 1.0f});
    for (int i = 0; i < 32; ++i)
        EXPECT_EQ(green[i], displayed[i].g);
}

TEST(Exr, ReadsForeignFilesAsVisible) {
    const TemporaryFolder folder;
    // Half floats, and a data window that does not start at the origin.
    const Imath::Box2i window({-2, 3}, {1, 4});
    Imf::Header header(window, window);
    std::vector<Imath::half> values(8);
    for (int i = 0; i < 8; ++i)
        values[i] = static_cast<float>(i) * 0.5f;
    Imf::FrameBuffer frame;
    for (const char* name : {"R", "G", "B"}) {
        header.channels().insert(name, Imf::Channel(Imf::HALF));
        frame.insert(name,
                     Imf::Slice(Imf::HALF, reinterpret_cast<char*>(values.data() + 2 - 3 * 4), 2, 2 * 4));
    }
    {
        Imf::OutputFile file((folder / "half.exr").c_str(), header);
        file.setFrameBuffer(frame);
        file.writePixels(2);
    }
    const RadianceImage image = readImage(folder / "half.exr");
    ASSERT_EQ(image.width, 4u);
    ASSERT_EQ(image.height, 2u);
    for (int i = 0; i < 8; ++i) {
        EXPECT_EQ(image.visible[i], glm::vec3(static_cast<float>(i) * 0.5f));
        EXPECT_EQ(image.invisible[i], glm::vec3(0.0f));
    }
}

TEST(Pfm, RoundTripKeepsEveryBitOfWhatIsDisplayed) {
    const TemporaryFolder folder;
    RadianceImage image = variedImage(19, 41);  // several bands
    image.visible[5] = {kNan, kInfinity, -kInfinity};
    writeImage(folder / "a.pfm", image, {});
    const RadianceImage back = readImage(folder / "a.pfm");
    EXPECT_EQ(back.width, 19u);
    EXPECT_EQ(back.height, 41u);
    EXPECT_TRUE(sameBits(back.visible, image.displayed({0.0f, 1.0f})));
    EXPECT_TRUE(sameBits(back.invisible, plainImage(19, 41, {}).invisible));
}

TEST(Pfm, HasTheBottomRowFirst) {
    RadianceImage image = plainImage(1, 2, {});
    image.visible[0] = {1.0f, 2.0f, 3.0f};  // the top
    image.visible[1] = {4.0f, 5.0f, 6.0f};
    const std::string bytes = encoded(encodePfm, image);
    const std::string header = "PF\n1 2\n-1.0\n";
    ASSERT_EQ(bytes.substr(0, header.size()), header);
    float values[6];
    ASSERT_EQ(bytes.size(), header.size() + sizeof values);
    std::memcpy(values, bytes.data() + header.size(), sizeof values);
    EXPECT_THAT(values, testing::ElementsAre(4.0f, 5.0f, 6.0f, 1.0f, 2.0f, 3.0f));
}

TEST(Pfm, ReadsBigEndianAndGrey) {
    const std::string big = std::string("PF 1 1 1\n") + std::string("\x3F\x80\0\0\x40\0\0\0\xBF\0\0\0", 12);
    EXPECT_EQ(decodePfm(big, "big.pfm").visible[0], glm::vec3(1.0f, 2.0f, -0.5f));
    const std::string grey = std::string("Pf\n2 1\n-2.5\n") + std::string("\0\0\x80\x3F\0\0\0\x40", 8);
    const RadianceImage image = decodePfm(grey, "grey.pfm");
    EXPECT_EQ(image.visible[0], glm::vec3(1.0f));
    EXPECT_EQ(image.visible[1], glm::vec3(2.0f));
}

TEST(Png, EveryCodeSurvivesARoundTrip) {
    const TemporaryFolder folder;
    RadianceImage image = plainImage(16, 16, {});
    for (int i = 0; i < 256; ++i) {
        image.visible[i] = {fromSrgb8(static_cast<std::uint8_t>(i)),
                            fromSrgb8(static_cast<std::uint8_t>(255 - i)), 0.5f};
    }
    writeImage(folder / "a.png", image, {});
    const RadianceImage back = readImage(folder / "a.png");
    for (int i = 0; i < 256; ++i) {
        EXPECT_EQ(back.visible[i].r, image.visible[i].r);
        EXPECT_EQ(back.visible[i].g, image.visible[i].g);
        EXPECT_EQ(back.visible[i].b, fromSrgb8(188));
    }
    writeImage(folder / "b.png", back, {});
    EXPECT_EQ(readFile(folder / "a.png"), readFile(folder / "b.png"));
}

TEST(Png, KeepsTheOrderOfRows) {
    RadianceImage image = plainImage(3, 40, {});
    for (std::size_t i = 0; i < image.visible.size(); ++i)
        image.visible[i] = glm::vec3(fromSrgb8(static_cast<std::uint8_t>(i)));
    EXPECT_EQ(decodePng(encoded(encodePng, image), "a.png").visible, image.visible);
}

TEST(Png, AppliesExposureAndDisplayThenClamps) {
    RadianceImage image = plainImage(2, 1, {0.25f, 0.75f, -1.0f});
    image.invisible[0] = {0.25f, 0.0f, 0.0f};
    image.visible[1] = {kNan, kInfinity, -kInfinity};
    ImageOptions options;
    options.display = {1.0f, 1.0f};
    options.exposure = 1.0f;
    const RadianceImage back = decodePng(encoded(encodePng, image, options), "a.png");
    EXPECT_EQ(back.visible[0], glm::vec3(1.0f, 1.0f, 0.0f));
    options.exposure = -1.0f;
    const RadianceImage dark = decodePng(encoded(encodePng, image, options), "a.png");
    EXPECT_EQ(dark.visible[0], glm::vec3(fromSrgb8(toSrgb8(0.25)), fromSrgb8(toSrgb8(0.375)), 0.0f));
    EXPECT_EQ(dark.visible[1], glm::vec3(0.0f, 1.0f, 0.0f));
}

TEST(Png, IsMarkedAsSrgbAndHoldsMetadata) {
    const TemporaryFolder folder;
    ImageOptions options;
    options.metadata = {{"Software", "duolux"}, {"Comment", "caf\xC3\xA9"}};
    writeImage(folder / "a.png", plainImage(3, 5, glm::vec3(0.5f)), options);

    const std::string path = (folder / "a.png").string();
    std::FILE* file = std::fopen(path.c_str(), "rb");
    ASSERT_NE(file, nullptr);
    png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
    png_infop info = png_create_info_struct(png);
    png_init_io(png, file);
    png_read_info(png, info);
    EXPECT_EQ(png_get_image_width(png, info), 3u);
    EXPECT_EQ(png_get_image_height(png, info), 5u);
    EXPECT_EQ(png_get_bit_depth(png, info), 8);
    EXPECT_EQ(png_get_color_type(png, info), PNG_COLOR_TYPE_RGB);
    int intent = -1;
    EXPECT_EQ(png_get_sRGB(png, info, &intent), PNG_INFO_sRGB);
    png_textp texts = nullptr;
    int count = 0;
    png_get_text(png, info, &texts, &count);
    std::vector<std::pair<std::string, std::string>> found;
    for (int i = 0; i < count; ++i)
        found.emplace_back(texts[i].key, texts[i].text);
    EXPECT_EQ(found, options.metadata);
    png_destroy_read_struct(&png, &info, nullptr);
    std::fclose(file);
}

}  // namespace
}  // namespace duolux

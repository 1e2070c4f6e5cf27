// For any contents of an image file, reading either succeeds or throws InputError with one line that names
// the file.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <initializer_list>
#include <optional>
#include <random>
#include <tuple>

#include "host/base/error.h"
#include "host/base/file.h"
#include "host/film/codec.h"
#include "host/film/image.h"
#include "tests/support/address_space.h"
#include "tests/unit/film_samples.h"

namespace duolux {
namespace {

using test::AddressSpaceLimit;
using test::encoded;
using test::plainImage;
using test::variedImage;
using test::writeText;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

struct Codec {
    const char* extension;
    test::Encode* encode;
    RadianceImage (*decode)(std::string_view, const std::string&);
};

std::ostream& operator<<(std::ostream& out, const Codec& codec) {
    return out << codec.extension;
}

class MalformedImage : public testing::TestWithParam<Codec> {};

INSTANTIATE_TEST_SUITE_P(Formats, MalformedImage,
                         testing::Values(Codec{"exr", encodeExr, decodeExr},
                                         Codec{"png", encodePng, decodePng},
                                         Codec{"pfm", encodePfm, decodePfm}),
                         [](const auto& codec) { return std::string(codec.param.extension); });

template <typename Read>
std::string inputErrorOf(Read read) {
    try {
        read();
    } catch (const InputError& e) {
        return e.what();
    }
    ADD_FAILURE() << "expected InputError";
    return {};
}

TEST_P(MalformedImage, TruncatedAnywhereIsAnInputError) {
    const std::string whole = encoded(GetParam().encode, variedImage(9, 5));
    for (std::size_t length = 0; length < whole.size(); ++length) {
        // Some formats end in bytes that no reader needs, so that an image missing only those is complete.
        try {
            const RadianceImage image =
                GetParam().decode(std::string_view(whole).substr(0, length), "cut.img");
            EXPECT_EQ(image.width, 9u);
            EXPECT_EQ(image.height, 5u);
            EXPECT_GT(length + 16, whole.size());
        } catch (const InputError& e) {
            EXPECT_THAT(e.what(), StartsWith("cut.img: "));
            EXPECT_THAT(e.what(), Not(HasSubstr("\n")));
        }
    }
}

TEST_P(MalformedImage, DamagedBytesNeverCrash) {
    const std::string whole = encoded(GetParam().encode, variedImage(9, 5));
    std::mt19937 random(7);
    for (int round = 0; round < 2000; ++round) {
        std::string bytes = whole;
        const int changes = 1 + static_cast<int>(random() % 4);
        for (int i = 0; i < changes; ++i)
            bytes[random() % bytes.size()] = static_cast<char>(random());
        try {
            const RadianceImage image = GetParam().decode(bytes, "damaged.img");
            EXPECT_EQ(image.visible.size(), std::size_t{image.width} * image.height);
        } catch (const InputError& e) {
            EXPECT_THAT(e.what(), StartsWith("damaged.img: "));
        }
    }
}

TEST_P(MalformedImage, OtherContentIsAnInputError) {
    for (const std::string& bytes : {std::string(), std::string("hello\n"), std::string(1000, '\0')}) {
        EXPECT_THAT(inputErrorOf([&] { GetParam().decode(bytes, "other.img"); }), StartsWith("other.img: "));
    }
}

TEST(MalformedPfm, HeadersAreChecked) {
    for (const char* header :
         {"PF\n", "PF\n1\n", "PF\n1 1\n", "PF\n0 1\n-1\n", "PF\n-1 1\n-1\n", "PF\n1 1\n0\n", "PF\n1 1\nnan\n",
          "PF\n1 1\ninf\n", "PF\nx 1\n-1\n", "PF\n1.5 1\n-1\n", "PF\n99999999999999999999 1\n-1\n",
          "PF\n65537 1\n-1\n", "PF\n60000 60000\n-1\n", "P6\n1 1\n255\n", "PF\n1 1\n-1"}) {
        EXPECT_THAT(inputErrorOf([&] { decodePfm(header, "h.pfm"); }), StartsWith("h.pfm: ")) << header;
    }
}

TEST(MalformedPfm, TruncationTellsHowMuchIsThere) {
    EXPECT_EQ(inputErrorOf([] { decodePfm("PF\n1 2\n-1\n0123", "h.pfm"); }),
              "h.pfm: is truncated: 4 of 24 bytes of pixels; expected a complete image");
}

/// A chunk of a PNG file without a valid checksum; `length`: the length that it claims.
std::string pngChunk(std::uint32_t length, const std::string& type, const std::string& data) {
    std::string out;
    for (int shift = 24; shift >= 0; shift -= 8)
        out += static_cast<char>(length >> shift);
    return out + type + data + std::string(4, '\0');
}

std::string pngHeader(std::uint32_t width, std::uint32_t height) {
    std::string size;
    for (const std::uint32_t side : {width, height}) {
        for (int shift = 24; shift >= 0; shift -= 8)
            size += static_cast<char>(side >> shift);
    }
    return "\x89PNG\r\n\x1A\n" + pngChunk(13, "IHDR", size + std::string("\x08\x02\0\0\0", 5));
}

TEST(MalformedPng, ClaimsAreHeldAgainstTheSizeOfTheFile) {
    const AddressSpaceLimit limit(std::size_t{32} << 20);
    EXPECT_EQ(
        inputErrorOf([] { decodePng(pngHeader(13, 9) + pngChunk(0x7fffffff, "tEXt", "abc"), "a.png"); }),
        "a.png: is not a readable PNG image: a chunk at byte 33 claims 2147483647 bytes where 3 are left; "
        "expected a complete file");
    EXPECT_EQ(
        inputErrorOf([] { decodePng(pngHeader(600, 600) + pngChunk(9, "IDAT", "123456789"), "a.png"); }),
        "a.png: claims 600 x 600 pixels but has only 9 bytes of them; expected a complete file");
}

/// The beginning of an EXR file: attributes, each with the size that it claims.
std::string exrHeader(
    const std::vector<std::tuple<std::string, std::string, std::int32_t, std::string>>& attributes) {
    std::string out("\x76\x2f\x31\x01\x02\0\0\0", 8);
    for (const auto& [name, type, size, value] : attributes) {
        out += name + '\0' + type + '\0';
        out.append(reinterpret_cast<const char*>(&size), sizeof size);
        out += value;
    }
    return out + '\0';
}

std::string words(std::initializer_list<std::int32_t> values) {
    return {reinterpret_cast<const char*>(std::data(values)), values.size() * sizeof(std::int32_t)};
}

TEST(MalformedExr, ClaimsAreHeldAgainstTheSizeOfTheFile) {
    const AddressSpaceLimit limit(std::size_t{32} << 20);
    EXPECT_EQ(
        inputErrorOf([] {
            decodeExr(exrHeader({{"comments", "string", 0x7fffffff, "abc"}}), "a.exr");
        }),
        "a.exr: is not a readable OpenEXR image: it claims 2147483647 bytes for the attribute 'comments' "
        "where 4 are left; expected a complete file");
    std::string channels;
    for (const char* name : {"B", "G", "R"})
        channels += std::string(name) + '\0' + words({2, 0, 1, 1});
    channels += '\0';
    const auto image = [&](std::int32_t width, std::int32_t height, char compression,
                           std::optional<std::string> tiles) {
        std::vector<std::tuple<std::string, std::string, std::int32_t, std::string>> attributes{
            {"channels", "chlist", static_cast<std::int32_t>(channels.size()), channels},
            {"compression", "compression", 1, {compression}},
            {"dataWindow", "box2i", 16, words({0, 0, width - 1, height - 1})}};
        if (tiles) attributes.emplace_back("tiles", "tiledesc", 9, *tiles + '\0');
        return inputErrorOf([&] { decodeExr(exrHeader(attributes), "a.exr"); });
    };
    for (const std::string& message :
         {image(5000, 5000, 3, std::nullopt), image(65536, 1, 9, std::nullopt),
          image(65536, 65536, 0, std::nullopt), image(100, 100, 3, words({65536, 65536})),
          image(100, 100, 3, words({1, 1}))}) {
        EXPECT_THAT(message,
                    testing::MatchesRegex(
                        "a.exr: .*claims [0-9]+ x [0-9]+ pixels .*but is only [0-9]+ bytes long; .*"));
    }
}

/// OpenEXR would take the rest for the next attribute, whose size may then be anything.
TEST(MalformedExr, AttributesHaveTheSizeOfTheirType) {
    const AddressSpaceLimit limit(std::size_t{32} << 20);
    const std::string opaque = std::string("b\0x\0", 4) + words({0x7ffffff0});
    const std::string list = "R" + std::string(1, '\0') + words({2, 0, 1, 1}) + '\0';
    const auto sizeOf = [](const std::string& text) { return static_cast<std::int32_t>(text.size()); };
    EXPECT_EQ(
        inputErrorOf([&] {
            decodeExr(exrHeader({{"a", "int", 4 + sizeOf(opaque), words({1}) + opaque}}), "a.exr");
        }),
        "a.exr: is not a readable OpenEXR image: it claims 12 bytes for the attribute 'a', whose type has 4; "
        "expected a complete file");
    EXPECT_EQ(
        inputErrorOf([&] {
            decodeExr(exrHeader({{"channels", "chlist", sizeOf(list + opaque), list + opaque}}), "a.exr");
        }),
        "a.exr: is not a readable OpenEXR image: it has 8 bytes after the list of the attribute 'channels'; "
        "expected a complete file");
}

TEST(ImageSize, IsLimited) {
    EXPECT_NO_THROW(checkImageSize(65536, 65536, std::size_t{1} << 40, "a"));
    EXPECT_NO_THROW(checkImageSize(1, 1, 1, "a"));
    EXPECT_THROW(checkImageSize(0, 1, 100, "a"), InputError);
    EXPECT_THROW(checkImageSize(1, -1, 100, "a"), InputError);
    EXPECT_THROW(checkImageSize(65537, 1, 1 << 30, "a"), InputError);
    EXPECT_THROW(checkImageSize(65536, 65536, 1000, "a"), InputError);
}

TEST(ReadImage, NamesWhatIsWrongWithThePath) {
    const TemporaryFolder folder;
    EXPECT_THAT(inputErrorOf([&] { readImage(folder / "none.exr"); }), HasSubstr("none.exr: cannot open"));
    EXPECT_THAT(inputErrorOf([&] { readImage(folder / "a.jpg"); }),
                HasSubstr("a.jpg: unknown image format; expected .exr, .png or .pfm"));
    std::filesystem::create_directory(folder / "dir.png");
    EXPECT_THAT(inputErrorOf([&] { readImage(folder / "dir.png"); }), HasSubstr("is a directory"));
    writeText(folder / "png.exr", encoded(encodePng, plainImage(2, 2, {})));
    EXPECT_THAT(inputErrorOf([&] { readImage(folder / "png.exr"); }),
                HasSubstr("png.exr: is not a readable OpenEXR"));
}

}  // namespace
}  // namespace duolux

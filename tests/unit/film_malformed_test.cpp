// Whatever the bytes of an image file, reading it either works or throws InputError with one line that names
// the file.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <random>

#include "host/base/error.h"
#include "host/base/file.h"
#include "host/film/codec.h"
#include "host/film/image.h"
#include "tests/unit/film_samples.h"

namespace duolux {
namespace {

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

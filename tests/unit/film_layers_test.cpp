// The optional layers of a film: their sums, and their channels in EXR files.
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numeric>
#include <random>
#include <set>

#include "host/base/error.h"
#include "host/base/file.h"
#include "host/cli/temporary_folder.h"
#include "host/film/film.h"
#include "tests/unit/film_samples.h"

namespace duolux {
namespace {

constexpr FilmLayerSet kAll = (FilmLayerSet{1} << kFilmLayers.size()) - 1;
constexpr std::int64_t kOne = std::int64_t{1} << 30;  // 1 in quanta of the normals

TEST(FilmLayers, HaveNamesOfTheirOwn) {
    std::set<std::string> names{"R", "G", "B", "A", "invisible", "visible"};
    for (std::size_t i = 0; i < kFilmLayers.size(); ++i) {
        const std::string name(kFilmLayers[i].name);
        EXPECT_TRUE(names.insert(name).second) << name;
        EXPECT_EQ(layerNamed(name), FilmLayerSet{1} << i);
        EXPECT_EQ(layersOf(FilmLayerSet{1} << i), std::vector{&kFilmLayers[i]});
    }
    EXPECT_EQ(layerNamed("normals"), std::nullopt);
    EXPECT_EQ(layerNamed(""), std::nullopt);
    EXPECT_EQ(layerNamed("normal"), kLayerNormal);
    EXPECT_EQ(channelsOf(kLayerNormal), 3u);
    EXPECT_EQ(channelsOf(0), 0u);
    EXPECT_EQ(namesOf(kAll).size(), kFilmLayers.size());
}

TEST(FilmLayers, AreMeansOverSamples) {
    Film film(2, 2, 0.25f, kLayerNormal);
    const std::array<Film::PixelSum, 2> dark{};
    const std::array<std::uint32_t, 2> pixels{3, 1};
    film.add(pixels, dark, 2, std::array<std::int64_t, 6>{2 * kOne, -kOne, 0, kOne / 2, 0, -2 * kOne});
    film.add(std::span(pixels).first(1), std::span(dark).first(1), 2,
             std::array<std::int64_t, 3>{-2 * kOne, -kOne, 1});
    const std::vector<float> expected{0, 0, 0, 0.25f, 0, -1, 0, 0, 0, 0, -0.5f, 0x1p-32f};
    EXPECT_EQ(film.resolve(kLayerNormal), expected);
    EXPECT_THROW(film.resolve(0), UsageError);
    EXPECT_THROW(film.resolve(kLayerNormal | FilmLayerSet{1} << 31), UsageError);
    EXPECT_THROW(Film(2, 2, 0.25f).resolve(kLayerNormal), UsageError);

    const ImageRows rows = film.rows();
    ASSERT_EQ(rows.layers.size(), 1u);
    EXPECT_EQ(rows.layers[0].name, "normal");
    EXPECT_EQ(rows.layers[0].channels, "XYZ");
    std::vector<float> second(6);
    rows.layers[0].read(1, second);
    EXPECT_EQ(second, std::vector<float>(expected.begin() + 6, expected.end()));
    EXPECT_TRUE(Film(2, 2, 0.25f).rows().layers.empty());
}

TEST(FilmLayers, TakeNoMemoryUnlessAskedFor) {
    EXPECT_TRUE(Film(8, 8, 1.0f).layerSums().empty());
    EXPECT_EQ(Film(8, 8, 1.0f, kLayerNormal).layerSums().size(), 8u * 8u * 3u);
}

// The largest possible sums, of 2^32 samples.
TEST(FilmLayers, HoldTheSumsOfAnyNumberOfSamples) {
    for (const FilmLayer& layer : kFilmLayers) {
        const double largest = std::max(std::abs(static_cast<double>(layer.lowest)),
                                        std::abs(static_cast<double>(layer.largest)));
        EXPECT_LT(std::ldexp(largest / layer.quantum(), 32), 0x1p63) << layer.name;
        EXPECT_GE(largest / layer.quantum(), 0x1p24) << "less precise than a float: " << layer.name;
    }
}

TEST(FilmLayers, AddUpExactlyWhateverTheQuantaOfRadiance) {
    constexpr std::uint32_t kPixels = 16;
    std::mt19937_64 random(1);
    std::vector<std::uint32_t> pixels(kPixels);
    std::iota(pixels.begin(), pixels.end(), 0u);
    Film whole(kPixels, 1, 0x1p-20f, kLayerNormal), sum(kPixels, 1, 0x1p-25f, kLayerNormal);
    for (int part = 0; part < 8; ++part) {
        const std::vector<Film::PixelSum> radiance(kPixels, Film::PixelSum{{1, 2, 3}, {4, 5, 6}});
        std::vector<std::int64_t> normals(3 * kPixels);
        for (std::int64_t& n : normals)
            n = static_cast<std::int64_t>(random()) >> 20;
        whole.add(pixels, radiance, 3, normals);
        Film piece(kPixels, 1, part % 2 == 0 ? 0x1p-20f : 0x1p-28f, kLayerNormal);
        piece.add(pixels, radiance, 3, normals);
        sum.add(piece);
    }
    EXPECT_TRUE(std::ranges::equal(whole.layerSums(), sum.layerSums()));
    EXPECT_EQ(whole.resolve(kLayerNormal), sum.resolve(kLayerNormal));
}

// Reads them with OpenEXR's own library, with a number of rows that is not a multiple of the rows written at
// once.
TEST(FilmLayers, AreChannelsOfAnExr) {
    constexpr int kWidth = 7, kHeight = 37;
    const TemporaryFolder folder;
    const RadianceImage image = test::variedImage(kWidth, kHeight);
    ImageRows rows = rowsOf(image);
    const auto value = [](std::size_t index) { return std::sin(static_cast<float>(index)); };
    const auto from = [&](std::size_t channels) {
        return [=](std::uint32_t firstRow, std::span<float> values) {
            for (std::size_t i = 0; i < values.size(); ++i)
                values[i] = value(std::size_t{firstRow} * kWidth * channels + i);
        };
    };
    rows.layers = {{"normal", "XYZ", from(3)}, {"depth", "Z", from(1)}};
    for (const char* name : {"a.exr", "a.png", "a.pfm"})
        writeImage(folder / name, rows, {});

    Imf::InputFile file((folder / "a.exr").c_str());
    std::vector<std::string> names;
    const Imf::ChannelList& channels = file.header().channels();
    for (auto it = channels.begin(); it != channels.end(); ++it)
        names.emplace_back(it.name());
    EXPECT_THAT(names, testing::UnorderedElementsAre("R", "G", "B", "invisible.R", "invisible.G",
                                                     "invisible.B", "visible.R", "visible.G", "visible.B",
                                                     "normal.X", "normal.Y", "normal.Z", "depth.Z"));
    const auto read = [&](const char* name) {
        std::vector<float> values(std::size_t{kWidth} * kHeight);
        Imf::FrameBuffer frame;
        frame.insert(name, Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(values.data()), 4, 4 * kWidth));
        file.setFrameBuffer(frame);
        file.readPixels(0, kHeight - 1);
        return values;
    };
    const std::vector<float> x = read("normal.X"), y = read("normal.Y"), z = read("normal.Z"),
                             depth = read("depth.Z");
    for (std::size_t i = 0; i < x.size(); ++i) {
        EXPECT_EQ(x[i], value(3 * i));
        EXPECT_EQ(y[i], value(3 * i + 1));
        EXPECT_EQ(z[i], value(3 * i + 2));
        EXPECT_EQ(depth[i], value(i));
    }
    const RadianceImage back = readImage(folder / "a.exr");
    EXPECT_TRUE(test::sameBits(back.visible, image.visible));
    EXPECT_TRUE(test::sameBits(back.invisible, image.invisible));
    // Other formats do not change.
    writeImage(folder / "b.png", image, {});
    writeImage(folder / "b.pfm", image, {});
    EXPECT_EQ(readFile(folder / "a.png"), readFile(folder / "b.png"));
    EXPECT_EQ(readFile(folder / "a.pfm"), readFile(folder / "b.pfm"));
}

}  // namespace
}  // namespace duolux

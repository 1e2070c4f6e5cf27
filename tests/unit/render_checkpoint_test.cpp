#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <functional>
#include <string>

#include "host/base/error.h"
#include "host/base/file.h"
#include "host/base/hash.h"
#include "host/cli/temporary_folder.h"
#include "host/render/checkpoint.h"

namespace duolux::test {
namespace {

using testing::HasSubstr;

constexpr std::uint32_t kWidth = 5, kHeight = 3;
constexpr FilmLayerSet kAllLayers = (FilmLayerSet{1} << kFilmLayers.size()) - 1;

/// A film in which every number is different and uses its high bits.
Film someFilm(bool light, FilmLayerSet layers = 0) {
    Film::Sums sums(kWidth * kHeight), lightPathSums(light ? kWidth * kHeight : 0);
    Film::Samples samples(kWidth * kHeight);
    std::int64_t next = 0x0123456789abcdef;
    for (std::uint32_t i = 0; i < samples.size(); ++i) {
        samples[i] = i * 0x01010101u;
        for (int c = 0; c < 3; ++c) {
            sums[i].invisible[c] = next += 0x1111;
            sums[i].visible[c] = -(next += 0x1111);
            if (!light) continue;
            lightPathSums[i].invisible[c] = next += 0x1111;
            lightPathSums[i].visible[c] = next += 0x1111;
        }
    }
    Film::LayerSums layerSums(samples.size() * channelsOf(layers));
    for (std::size_t i = 0; i < layerSums.size(); ++i)
        layerSums[i] = i % 2 == 0 ? next += 0x1111 : -(next += 0x1111);
    return Film({.width = kWidth,
                 .height = kHeight,
                 .quantum = 0x1p-29f,
                 .sums = sums,
                 .samples = samples,
                 .lightPathSums = lightPathSums,
                 .lightPaths = light ? 0x123456789abull : 0ull,
                 .carries = {{3, 7}, {50, -1}},
                 .layers = layers,
                 .layerSums = layerSums});
}

FilmOrigin someOrigin() {
    FilmOrigin origin{"a \"scene\".json",       "0123456789abcdef", "blend 0.5,1", {},
                      DirectLight::kClosedForm, {0.25f, -1.5f},     {7, 33}};
    origin.settings = {kWidth, kHeight, 26, 12, 0xfffffff0u, Sampler::kIndependent, Integrator::kLightTracer};
    return origin;
}

RenderStatistics someStatistics() {
    RenderStatistics statistics;
    statistics.lastBounceRadiance = 1.0 / 3.0;
    statistics.previousBounceRadiance = 1e-200;
    statistics.filmOverflowed = true;
    return statistics;
}

bool same(std::span<const Film::PixelSum> a, std::span<const Film::PixelSum> b) {
    return std::ranges::equal(a, b, [](const Film::PixelSum& p, const Film::PixelSum& q) {
        return std::ranges::equal(p.invisible, q.invisible) && std::ranges::equal(p.visible, q.visible);
    });
}

class CheckpointTest : public testing::Test {
  protected:
    TemporaryFolder folder_;
    std::filesystem::path file_ = folder_ / "some.checkpoint";

    void expectRefused(const std::string& bytes, const char* words) {
        std::ofstream(file_, std::ios::binary) << bytes;
        try {
            readCheckpoint(file_);
            ADD_FAILURE() << "was read; expected: " << words;
        } catch (const InputError& e) {
            EXPECT_THAT(e.what(), HasSubstr(file_.string()));
            EXPECT_THAT(e.what(), HasSubstr(words));
        }
    }
};

TEST_F(CheckpointTest, KeepsEverything) {
    for (const FilmLayerSet layers : {FilmLayerSet{0}, kLayerNormal, kAllLayers}) {
        const bool light = layers != kLayerNormal;
        const Film film = someFilm(light, layers);
        FilmOrigin origin = someOrigin();
        origin.settings.layers = layers;
        writeCheckpoint(file_, origin, film, someStatistics());
        const Checkpoint read = readCheckpoint(file_);
        EXPECT_TRUE(same(read.state.film.sums(), film.sums()));
        EXPECT_TRUE(same(read.state.film.lightPathSums(), film.lightPathSums()));
        EXPECT_TRUE(std::ranges::equal(read.state.film.samples(), film.samples()));
        EXPECT_EQ(read.state.film.lightPaths(), film.lightPaths());
        EXPECT_EQ(read.state.film.quantum(), film.quantum());
        EXPECT_EQ(read.state.film.carries(), film.carries());
        EXPECT_EQ(read.state.film.layers(), layers);
        EXPECT_TRUE(std::ranges::equal(read.state.film.layerSums(), film.layerSums()));
        EXPECT_EQ(read.state.film.width(), kWidth);
        EXPECT_EQ(read.state.film.height(), kHeight);
        EXPECT_EQ(read.state.lastBounceRadiance, 1.0 / 3.0);
        EXPECT_EQ(read.state.previousBounceRadiance, 1e-200);
        EXPECT_TRUE(read.state.filmOverflowed);
        EXPECT_EQ(read.origin.sceneFile, origin.sceneFile);
        EXPECT_EQ(read.origin.display, origin.display);
        EXPECT_EQ(read.origin.samples.begin, 7u);
        EXPECT_EQ(read.origin.samples.end, 33u);
        EXPECT_EQ(read.origin.settings.spp, 26u);
        EXPECT_NO_THROW(requireSameOrigin(file_, read.origin, origin, "itself"));
    }
}

TEST(SamplesTaken, OfLightPathsAreAsManyAsBegun) {
    Film film(kWidth, kHeight, 0x1p-29f);
    EXPECT_EQ(samplesTaken(film), 0u);
    film.countLightPaths(1);
    EXPECT_EQ(samplesTaken(film), 1u);
    film.countLightPaths(kWidth * kHeight - 1);
    EXPECT_EQ(samplesTaken(film), 1u);
    film.countLightPaths(1);
    EXPECT_EQ(samplesTaken(film), 2u);
    EXPECT_EQ(samplesTaken(someFilm(false)), 14u * 0x01010101u);
}

TEST_F(CheckpointTest, ADamagedFileIsRefused) {
    writeCheckpoint(file_, someOrigin(), someFilm(true), someStatistics());
    const std::string good = readFile(file_);
    for (std::size_t at = 8; at < good.size(); at += 13) {
        std::string bad = good;
        bad[at] = static_cast<char>(bad[at] ^ 4);
        expectRefused(bad, "damaged");
    }
    for (const std::size_t length : {good.size() - 1, good.size() / 2, std::size_t{20}})
        expectRefused(good.substr(0, length), "damaged");
    expectRefused(good + '\0', "damaged");
    expectRefused("", "is no checkpoint");
    expectRefused("P6 5 3 255 no checkpoint at all", "is no checkpoint");
    std::string newer = good;
    newer[7] = '9';
    expectRefused(newer, "another version");
    EXPECT_THROW(readCheckpoint(folder_ / "missing"), InputError);
}

/// The bytes of a checkpoint with another header of the same length.
std::string withHeader(std::string bytes, const std::string& was, const std::string& is) {
    bytes.replace(bytes.find(was), was.size(), is);
    bytes.resize(bytes.size() - sizeof(std::uint64_t));
    Hasher checksum;
    checksum.add(bytes);
    const std::uint64_t sum = checksum.digest();
    bytes.append(reinterpret_cast<const char*>(&sum), sizeof sum);
    return bytes;
}

TEST_F(CheckpointTest, LayersThatDoNotFitAreRefused) {
    writeCheckpoint(file_, someOrigin(), someFilm(false, kLayerNormal), someStatistics());
    const std::string good = readFile(file_);
    const std::string layers = R"("layers":["normal"])";
    expectRefused(withHeader(good, layers, R"("layers":["moral!"])"),
                  "has a layer 'moral!', which this version does not know");
    expectRefused(withHeader(good, layers, R"("layers":["normal",)"), "its header cannot be read");
    expectRefused(withHeader(good, layers, R"("layers":[        ])"), "its parts do not fit");
}

TEST_F(CheckpointTest, UnknownNamesAreRefused) {
    writeCheckpoint(file_, someOrigin(), someFilm(true), someStatistics());
    const std::string good = readFile(file_);
    const auto with = [&](const std::string& was, const std::string& is) {
        return withHeader(good, "\"" + was + "\"", is);
    };
    expectRefused(with("independent", R"("dependently")"),
                  "has the sampler 'dependently', which this version does not know; expected a checkpoint");
    expectRefused(with("light", R"("right")"),
                  "has the integrator 'right', which this version does not know");
    expectRefused(with("closed-form", R"("open-format")"),
                  "has the direct light 'open-format', which this version does not know");
    expectRefused(with("closed-form", R"("auto"       )"), "its parts do not fit");
    expectRefused(with("light", "1      "), "its header cannot be read");
}

TEST_F(CheckpointTest, AnotherOriginIsRefusedByName) {
    struct Change {
        const char* word;
        std::function<void(FilmOrigin&)> make;
    };
    const Change changes[] = {
        {"size", [](FilmOrigin& o) { o.settings.width = 6; }},
        {"reflectance", [](FilmOrigin& o) { o.reflectance = "global"; }},
        {"scene hash", [](FilmOrigin& o) { o.sceneHash[3] = 'x'; }},
        {"integrator", [](FilmOrigin& o) { o.settings.integrator = Integrator::kPathTracer; }},
        {"bounces", [](FilmOrigin& o) { o.settings.bounces = 13; }},
        {"seed", [](FilmOrigin& o) { o.settings.seed = 1; }},
        {"sampler", [](FilmOrigin& o) { o.settings.sampler = Sampler::kSobol; }},
        {"layers: is normal, but none in", [](FilmOrigin& o) { o.settings.layers = kLayerNormal; }},
        {"direct light", [](FilmOrigin& o) { o.directLight = DirectLight::kSampled; }}};
    for (const Change& change : changes) {
        FilmOrigin other = someOrigin();
        change.make(other);
        try {
            requireSameOrigin(file_, other, someOrigin(), "this render");
            ADD_FAILURE() << change.word;
        } catch (const InputError& e) {
            EXPECT_THAT(e.what(), HasSubstr(change.word));
        }
    }
    FilmOrigin range = someOrigin();
    range.samples = {0, 99};
    range.settings.spp = 99;
    EXPECT_NO_THROW(requireSameOrigin(file_, range, someOrigin(), "this render"));
}

}  // namespace
}  // namespace duolux::test

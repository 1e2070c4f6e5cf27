#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/shader/mirror_types.h"

// Compares the sums of lanes with both oracles. pixel_sums_test.glsl and light_path_test.glsl test the
// expected values.

DUOLUX_GLSL_TYPE(duolux::mirror::Array<6>, "uint[6]", "");

namespace duolux::test {
namespace {

using mirror::single::FilmSum;
using mirror::single::PixelSums;
using mirror::single::Radiance2;
using mirror::single::SampleRadiance;

const ShaderLibrary& pixelSums() {
    static const ShaderLibrary library("shaders/lib/pixel_sums.glsl");
    return library;
}

class PixelSumsOracles : public testing::Test {
  protected:
    std::uint32_t word() { return static_cast<std::uint32_t>(engine_()); }
    float number() { return uniform_(engine_); }
    glm::vec3 vector() { return {number(), number(), number()}; }
    FilmSum filmSum() { return {{word(), word()}, {word(), word()}, {word(), word()}}; }
    SampleRadiance received(float bright) {
        return {{bright * vector(), bright * vector()}, number(), number()};
    }
    PixelSums sums() {
        return {filmSum(), filmSum(), word(), word(), word(), word(), word(), word(), number(), number()};
    }

    std::mt19937 engine_{12};
    std::uniform_real_distribution<float> uniform_;
};

constexpr Budget kExact{0, 0};

TEST_F(PixelSumsOracles, Gather) {
    std::vector<SampleRadiance> before;
    std::vector<Radiance2> lights;
    std::vector<glm::uvec2> scatterings;  // of the path, and allowed
    std::vector<glm::vec2> display;
    for (int i = 0; i < 4096; ++i) {
        before.push_back(received(1.0f));
        lights.push_back({vector(), vector()});
        scatterings.emplace_back(word() % 4, word() % 4);
        display.emplace_back(number(), number());
    }
    const auto after = pixelSums().evaluate<SampleRadiance>(
        "SampleRadiance g = x0; addRadiance(g, x1, x2.x, x2.y, x3); result = g;", before, lights, scatterings,
        display);
    // A sum of seven terms of about 1.
    EXPECT_WITHIN_ORACLES(
        "addRadiance", after, Budget{4, 5e-7},
        [](SampleRadiance g, const auto& l, const auto& s, const auto& d) {
            mirror::single::addRadiance(g, l, s.x, s.y, d);
            return g;
        },
        [](mirror::twice::SampleRadiance g, const auto& l, const auto& s, const auto& d) {
            mirror::twice::addRadiance(g, l, s.x, s.y, d);
            return g;
        },
        before, lights, scatterings, display);
    EXPECT_EQ(numbers(pixelSums().call<SampleRadiance>("noRadiance")[0]),
              numbers(mirror::single::noRadiance()));
}

// Numbers of all sizes, except sums of six near 2^58 quanta or 1e30, where the precision decides.
TEST_F(PixelSumsOracles, Samples) {
    std::vector<PixelSums> before;
    std::vector<SampleRadiance> samples;
    for (int i = 0; i < 4096; ++i) {
        before.push_back(sums());
        const float bright = std::exp2(static_cast<float>(i % 110));
        samples.push_back(i % 16 == 15 ? received(i % 32 == 31 ? NAN : INFINITY) : received(bright));
    }
    const auto after = pixelSums().evaluate<PixelSums>(
        "PixelSums s = x0; addSample(s, x1, 1024.0, FilmRounding(vec3(0.25), vec3(0.75))); result = s;",
        before, samples);
    // Words are exact; the statistics' floats are sums of two numbers of about 1.
    EXPECT_WITHIN_ORACLES(
        "addSample", after, Budget{1, 0},
        [](PixelSums s, const auto& g) {
            mirror::single::addSample(s, g, 1024.0f, {glm::vec3(0.25f), glm::vec3(0.75f)});
            return s;
        },
        [](mirror::twice::PixelSums s, const auto& g) {
            mirror::twice::addSample(s, g, 1024.0, {glm::dvec3(0.25), glm::dvec3(0.75)});
            return s;
        },
        before, samples);
}

TEST_F(PixelSumsOracles, Results) {
    std::vector<FilmSum> filmSums;
    std::vector<PixelSums> all;
    for (int i = 0; i < 1024; ++i) {
        filmSums.push_back(filmSum());
        all.push_back(sums());
    }
    EXPECT_ORACLES(pixelSums(), words, kExact, filmSums);
    EXPECT_ORACLES(pixelSums(), pixelResult, kExact, all);
    EXPECT_EQ(numbers(pixelSums().call<PixelSums>("emptyPixelSums")[0]),
              numbers(mirror::single::emptyPixelSums()));
}

TEST(LightPathOracles, LaneResult) {
    using mirror::single::LaneSums;
    ShaderLibrary library("shaders/lib/light_path.glsl");
    for (const char* name : {"Normal", "Plane", "Pair", "Light"})
        library.define("uvec4 fetch" + std::string(name) + "Texel(uint index) { return uvec4(0u); }");
    const std::vector<LaneSums> sums{library.call<LaneSums>("emptyLaneSums")[0],
                                     {1, 2, 3, 4, 5, {6, 7}, {8, 9}, {10, 11}, {12, 13}},
                                     {0xfffffff1,
                                      0xfffffff2,
                                      0xfffffff3,
                                      0xfffffff4,
                                      0xfffffff5,
                                      {6, 0xffffffff},
                                      {8, 0x80000000},
                                      {10, 0xffffffff},
                                      {12, 0x80000000}}};
    const auto results = library.call<mirror::single::LaneResult>("laneResult", sums);
    EXPECT_EQ(numbers(results[0]), numbers(mirror::single::laneResult(mirror::single::emptyLaneSums())));
    for (std::size_t i = 0; i < sums.size(); ++i)
        EXPECT_EQ(numbers(results[i]), numbers(mirror::single::laneResult(sums[i])));
}

}  // namespace
}  // namespace duolux::test

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "tests/shader/harness/census.h"
#include "tests/shader/inputs.h"
#include "tests/shader/oracles.h"
#include "tests/shader/published_sequences.h"
#include "tests/shader/uniformity.h"

// Random numbers: equal to the published ones, uniform, and uncorrelated with their counters.

namespace duolux::test {
namespace {

const ShaderLibrary& rng() {
    static const ShaderLibrary library("shaders/lib/rng.glsl");
    return library;
}

TEST(Rng, MatchesThePublishedGenerator) {
    std::vector<glm::uvec4> inputs = randomWords4(4096, 1);
    for (std::uint32_t i = 0; i < 1000; ++i)
        inputs.emplace_back(i, i * 7919u, ~i, i << 20);
    const std::vector<glm::uvec4> outputs = rng().call<glm::uvec4>("pcg4d", inputs);
    Census census("pcg4d");
    for (std::size_t i = 0; i < inputs.size(); ++i)
        census.compare(i, outputs[i], publishedPcg4d(inputs[i]));
}

/// Computed once by a program in another language.
TEST(Rng, KnownAnswers) {
    const std::vector<glm::uvec4> inputs{
        glm::uvec4(0u), {1u, 2u, 3u, 4u}, glm::uvec4(~0u), {1u << 31, 0u, 0u, 0u}, {5u, ~0u, 65537u, 1u}};
    const std::vector<glm::uvec4> expected{{0x0f02f829u, 0x2d568769u, 0x32b0c43bu, 0xd32548eau},
                                           {0x3622cd16u, 0xf11471d8u, 0xe1109b3fu, 0x02b94c2fu},
                                           {0x974ed892u, 0xc015dc67u, 0x9f955760u, 0xa1bba208u},
                                           {0xe6ddf829u, 0x3e198769u, 0x4fbf443bu, 0x0c88c8eau},
                                           {0x33461b4fu, 0xbfe009ddu, 0x1c9ed892u, 0xfc727f9au}};
    EXPECT_EQ(rng().call<glm::uvec4>("pcg4d", inputs), expected);
}

/// A float takes the upper 24 bits of a word: every multiple of 2^-24 below 1, exactly.
TEST(Rng, FloatsAreTheUpperBits) {
    std::vector<std::uint32_t> words = randomWords(1 << 16);
    for (int bit = 0; bit < 32; ++bit) {
        for (const std::uint32_t word : {1u << bit, ~0u << bit, ~0u >> bit})
            words.push_back(word);
    }
    words.push_back(0u);
    const std::vector<float> floats = rng().call<float>("uniformFloat", words);
    for (std::size_t i = 0; i < words.size(); ++i)
        ASSERT_EQ(static_cast<double>(floats[i]), std::ldexp(words[i] >> 8, -24)) << words[i];
    const std::vector<float> ends =
        rng().call<float>("uniformFloat", std::vector<std::uint32_t>{0u, 0xffu, 0x100u, 1u << 31, ~0u});
    EXPECT_EQ(ends, (std::vector<float>{0.0f, 0.0f, 0x1p-24f, 0.5f, 1.0f - 0x1p-24f}));
}

/// A counter in each of the four inputs, like pixels, samples, dimensions and seeds. Tests every word by its
/// upper bits, by the lowest bits of its float, and by pairs of consecutive words; every pair of words; and
/// floats in a number of bins that is not a power of two. One false alarm in 10^4.
TEST(Rng, WordsAreUniformAndIndependent) {
    constexpr std::uint32_t kCount = 1 << 16;
    Family family;
    for (glm::length_t input = 0; input < 4; ++input) {
        std::vector<glm::uvec4> counters(kCount, glm::uvec4(7u, 1u, 4u, 1u));
        for (std::uint32_t i = 0; i < kCount; ++i)
            counters[i][input] = i;
        const std::vector<glm::uvec4> outputs = rng().call<glm::uvec4>("pcg4d", counters);
        std::array<std::vector<std::uint32_t>, 4> words;
        for (const glm::uvec4& o : outputs) {
            for (std::size_t w = 0; w < 4; ++w)
                words[w].push_back(o[static_cast<glm::length_t>(w)]);
        }
        for (std::size_t w = 0; w < 4; ++w) {
            const std::string name = fmt::format("word {} for a counter in input {}", w, input);
            const std::span<const std::uint32_t> word(words[w]);
            std::vector<std::uint32_t> upper, lower, thousandths;
            for (const float x : rng().call<float>("uniformFloat", words[w]))
                thousandths.push_back(static_cast<std::uint32_t>(x * 1000.0f));
            for (const std::uint32_t x : word) {
                upper.push_back(x >> 22);
                lower.push_back(x >> 8 & 0x3ffu);
            }
            family.add(name + ", upper bits", evenly(upper, 1024));
            family.add(name + ", lower bits", evenly(lower, 1024));
            family.add(name + ", as a float", evenly(thousandths, 1000));
            family.add(name + ", consecutive", evenlyInSquares(word.first(kCount - 1), word.subspan(1), 5));
            family.add(name + ", serial correlation", uncorrelated(word.first(kCount - 1), word.subspan(1)));
            for (std::size_t other = 0; other < w; ++other) {
                family.add(fmt::format("{}, with word {}", name, other),
                           evenlyInSquares(word, words[other], 5));
                family.add(fmt::format("{}, correlation with word {}", name, other),
                           uncorrelated(word, words[other]));
            }
        }
    }
    family.expect(1e-4);
}

/// How often each input bit changes each output bit, [input bit][output bit], over random inputs.
std::vector<std::vector<double>> avalanche(std::size_t inputs) {
    const std::vector<glm::uvec4> base = randomWords4(inputs, 2);
    std::vector<glm::uvec4> flipped;
    for (std::uint32_t bit = 0; bit < 128; ++bit) {
        for (glm::uvec4 v : base) {
            v[static_cast<glm::length_t>(bit / 32)] ^= 1u << bit % 32;
            flipped.push_back(v);
        }
    }
    const std::vector<glm::uvec4> before = rng().call<glm::uvec4>("pcg4d", base);
    const std::vector<glm::uvec4> after = rng().call<glm::uvec4>("pcg4d", flipped);
    std::vector<std::vector<double>> rate(128, std::vector<double>(128));
    for (std::size_t i = 0; i < after.size(); ++i) {
        const glm::uvec4 changed = after[i] ^ before[i % inputs];
        for (std::size_t bit = 0; bit < 128; ++bit)
            rate[i / inputs][bit] += changed[static_cast<glm::length_t>(bit / 32)] >> bit % 32 & 1u;
    }
    for (std::vector<double>& row : rate) {
        for (double& r : row)
            r /= static_cast<double>(inputs);
    }
    return rate;
}

/// Each of the lower 20 bits of an input, where counters are, changes each bit of a float half of the time;
/// higher bits change the upper 16 bits often enough. (They cannot reach the lower bits: sums and products
/// carry only upwards, and the shift between the two rounds is by 16 bits.) 80 x 96 rates over 2048 inputs
/// have a deviation of 0.011: less than one false alarm beyond 0.07 in 10^4.
TEST(Rng, EveryInputBitChangesHalfOfTheFloat) {
    const std::vector<std::vector<double>> rate = avalanche(2048);
    for (std::size_t in = 0; in < 128; ++in) {
        for (std::size_t out = 0; out < 128; ++out) {
            const bool counts = in % 32 < 20 && out % 32 >= 8;
            const double allowed = counts ? 0.07 : out % 32 >= 16 ? 0.25 : 0.5;
            EXPECT_NEAR(rate[in][out], 0.5, allowed) << in << ' ' << out;
        }
    }
}

TEST(RngOracles, AllFunctions) {
    const std::vector<glm::uvec4> counters = randomWords4(4096, 3);
    const std::vector<std::uint32_t> words = randomWords(4096, 4);
    std::vector<glm::uvec2> pairs;
    for (const glm::uvec4& c : counters)
        pairs.emplace_back(c.x, c.y);
    EXPECT_ORACLES(rng(), pcg4d, (Budget{0, 0}), counters);
    EXPECT_ORACLES(rng(), uniformFloat, (Budget{0, 0}), words);
    EXPECT_ORACLES(rng(), uniformFloat2, (Budget{0, 0}), pairs);
}

}  // namespace
}  // namespace duolux::test

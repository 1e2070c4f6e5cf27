#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "tests/shader/harness/census.h"
#include "tests/shader/inputs.h"
#include "tests/shader/oracles.h"
#include "tests/shader/published_sequences.h"
#include "tests/shader/uniformity.h"

// Sobol points: equal to the published ones, nets for every key, and independent for different keys.

namespace duolux::test {
namespace {

const ShaderLibrary& sobol() {
    static const ShaderLibrary library("shaders/lib/sobol.glsl");
    return library;
}

std::vector<std::uint32_t> range(std::uint32_t first, std::uint32_t count) {
    std::vector<std::uint32_t> indices(count);
    std::iota(indices.begin(), indices.end(), first);
    return indices;
}

TEST(Sobol, SecondDimensionMatchesTheDirectionNumbers) {
    std::vector<std::uint32_t> inputs = range(0, 2048);
    for (const std::uint32_t word : randomWords(4096))
        inputs.push_back(word);
    const std::vector<std::uint32_t> outputs = sobol().call<std::uint32_t>("sobolSecondReversed", inputs);
    for (std::size_t i = 0; i < inputs.size(); ++i)
        ASSERT_EQ(reversed(outputs[i]), publishedSobol(inputs[i], 1)) << inputs[i];
}

/// Each bit of the index separately. The numbers were computed once by a program in another language.
TEST(Sobol, DirectionNumbersAreThose) {
    const std::vector<std::uint32_t> expected{
        0x80000000u, 0xc0000000u, 0xa0000000u, 0xf0000000u, 0x88000000u, 0xcc000000u, 0xaa000000u,
        0xff000000u, 0x80800000u, 0xc0c00000u, 0xa0a00000u, 0xf0f00000u, 0x88880000u, 0xcccc0000u,
        0xaaaa0000u, 0xffff0000u, 0x80008000u, 0xc000c000u, 0xa000a000u, 0xf000f000u, 0x88008800u,
        0xcc00cc00u, 0xaa00aa00u, 0xff00ff00u, 0x80808080u, 0xc0c0c0c0u, 0xa0a0a0a0u, 0xf0f0f0f0u,
        0x88888888u, 0xccccccccu, 0xaaaaaaaau, 0xffffffffu};
    std::vector<std::uint32_t> bits;
    for (int i = 0; i < 32; ++i)
        bits.push_back(1u << i);
    std::vector<std::uint32_t> outputs = sobol().call<std::uint32_t>("sobolSecondReversed", bits);
    std::transform(outputs.begin(), outputs.end(), outputs.begin(), reversed);
    EXPECT_EQ(outputs, expected);
}

TEST(Sobol, ScramblingIsThePublishedHash) {
    const std::vector<std::uint32_t> numbers = randomWords(4096, 1);
    const std::vector<std::uint32_t> seeds = randomWords(4096, 2);
    const std::vector<std::uint32_t> scrambled =
        sobol().call<std::uint32_t>("owenScrambleReversed", numbers, seeds);
    for (std::size_t i = 0; i < numbers.size(); ++i)
        ASSERT_EQ(reversed(scrambled[i]), publishedScramble(reversed(numbers[i]), seeds[i])) << numbers[i];
    // Computed once by a program in another language.
    EXPECT_EQ(sobol().call<std::uint32_t>(
                  "owenScrambleReversed",
                  std::vector<std::uint32_t>{0u, 1u, 0u, 1u, 0x80000000u, 0xffffffffu, 0x12345678u},
                  std::vector<std::uint32_t>{0u, 0u, 1u, 0x10000u, 0xdeadbeefu, 0xffffffffu, 0x9abcdef0u}),
              (std::vector<std::uint32_t>{0u, 0x3eaef8ddu, 0xbc7f85abu, 0x8a91f8ddu, 0xfa9249e5u, 0x5edbfd28u,
                                          0xfb1d0b68u}));
}

/// Numbers with equal lower 16 bits have results with equal lower 16 bits, and all 2^16 values occur.
TEST(Sobol, ScramblingIsAPermutationOfTheLowerBits) {
    for (const std::uint32_t seed : {0u, 1u, 0x80000000u, 0xffffffffu, 0x9e3779b9u}) {
        std::vector<bool> seen(1 << 16);
        for (const std::uint32_t x :
             sobol().call<std::uint32_t>("owenScrambleReversed", range(0xabcd0000u, 1 << 16), seed))
            seen[x & 0xffffu] = true;
        EXPECT_EQ(std::count(seen.begin(), seen.end(), true), 1 << 16) << seed;
    }
}

/// Over the seeds, bit k flips with probability 1/2, and independently for two numbers that differ in the bit
/// below (k > 0). The seeds are words of a hash.
TEST(Sobol, SeedsScrambleIndependently) {
    constexpr std::uint32_t kSeeds = 1 << 14;
    const std::vector<std::uint32_t> seeds = randomWords(kSeeds, 3);
    Family family;
    for (const std::uint32_t number : {0u, 0x5a5a5a5au, 0xffffffffu}) {
        const std::vector<std::uint32_t> base =
            sobol().call<std::uint32_t>("owenScrambleReversed", number, seeds);
        for (std::uint32_t k = 1; k < 32; ++k) {
            const std::vector<std::uint32_t> other =
                sobol().call<std::uint32_t>("owenScrambleReversed", number ^ 1u << (k - 1), seeds);
            std::vector<std::uint32_t> flips;
            for (std::size_t i = 0; i < kSeeds; ++i)
                flips.push_back(((base[i] ^ number) >> k & 1u) << 1 | ((other[i] ^ number) >> k & 1u));
            family.add(fmt::format("bit {} of {:x}", k, number), evenly(flips, 4));
        }
    }
    family.expect(1e-4);
}

TEST(Sobol, PairsMatchThePublishedConstruction) {
    const std::vector<glm::uvec4> keys = randomWords4(4096, 4);
    std::vector<std::uint32_t> indices = randomWords(4096, 5);
    for (std::size_t i = 0; i < 2048; ++i)
        indices[i] >>= 16;
    const std::vector<glm::uvec2> points = sobol().call<glm::uvec2>("sobolPair", indices, keys);
    Census census("sobolPair");
    for (std::size_t i = 0; i < points.size(); ++i)
        census.compare(i, points[i], publishedPair(indices[i], keys[i]));
}

/// Whether every elementary interval of 2^m points, 2^-a by 2^-(m - a) for each a, holds exactly one point: a
/// (0, m, 2)-net in base 2.
testing::AssertionResult isNet(std::span<const glm::uvec2> points, int m) {
    const auto cell = [](std::uint32_t x, int bits) { return bits == 0 ? 0u : x >> (32 - bits); };
    for (int a = 0; a <= m; ++a) {
        std::vector<bool> taken(points.size());
        for (const glm::uvec2& p : points) {
            const std::uint32_t at = cell(p.x, a) << (m - a) | cell(p.y, m - a);
            if (taken[at]) {
                return testing::AssertionFailure()
                       << "2^" << m << " points, 2^" << a << " columns: two in interval " << at;
            }
            taken[at] = true;
        }
    }
    return testing::AssertionSuccess();
}

/// Shuffling and scrambling preserve the nets of Sobol points: every aligned run of 2^m points is a net, m =
/// 1..10 (a (0, 2)-sequence). Runs at the start, in the middle and at the end of the indices.
TEST(Sobol, EveryAlignedRunOfAnyPairIsANet) {
    constexpr std::uint32_t kPoints = 1 << 11;
    for (const glm::uvec4& key : randomWords4(8, 6)) {
        for (const std::uint32_t first : {0u, 5 * kPoints, 0u - kPoints}) {
            const std::vector<glm::uvec2> points =
                sobol().call<glm::uvec2>("sobolPair", range(first, kPoints), key);
            for (int m = 1; m <= 10; ++m) {
                const std::size_t size = std::size_t{1} << m;
                for (std::size_t run = 0; run < kPoints / size; ++run)
                    ASSERT_TRUE(isNet(std::span(points).subspan(run * size, size), m))
                        << "run " << run << " of those from " << first;
            }
        }
    }
}

/// The integration error of a smooth function falls faster than 1 / n; with random numbers it falls with 1 /
/// sqrt(n). The function is x y e^(x + y), whose integral is 1; the error is the root mean square over 64
/// keys.
TEST(Sobol, IntegratesBetterThanRandomNumbers) {
    const auto error = [&](std::uint32_t n) {
        double sum = 0.0;
        const std::vector<glm::uvec4> keys = randomWords4(64, 7);
        for (const glm::uvec4& key : keys) {
            double mean = 0.0;
            for (const glm::uvec2& p : sobol().call<glm::uvec2>("sobolPair", range(0, n), key)) {
                const double x = std::ldexp(p.x, -32);
                const double y = std::ldexp(p.y, -32);
                mean += x * y * std::exp(x + y) / n;
            }
            sum += (mean - 1.0) * (mean - 1.0);
        }
        return std::sqrt(sum / static_cast<double>(keys.size()));
    };
    const double coarse = error(64);
    const double fine = error(1024);
    EXPECT_LT(coarse, 0.15 / std::sqrt(64.0));
    EXPECT_LT(fine, coarse / 16.0);
}

TEST(SobolOracles, AllFunctions) {
    const std::vector<std::uint32_t> numbers = randomWords(4096, 8);
    const std::vector<std::uint32_t> seeds = randomWords(4096, 9);
    const std::vector<glm::uvec4> keys = randomWords4(4096, 10);
    EXPECT_ORACLES(sobol(), owenScrambleReversed, (Budget{0, 0}), numbers, seeds);
    EXPECT_ORACLES(sobol(), sobolSecondReversed, (Budget{0, 0}), numbers);
    EXPECT_ORACLES(sobol(), sobolPair, (Budget{0, 0}), numbers, keys);
}

}  // namespace
}  // namespace duolux::test

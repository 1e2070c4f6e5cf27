#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "shaders/shared/path_tracer_layout.h"
#include "tests/shader/harness/census.h"
#include "tests/shader/inputs.h"
#include "tests/shader/oracles.h"
#include "tests/shader/published_sequences.h"
#include "tests/shader/uniformity.h"

// The random numbers of a path: numbers with different pixels, samples, dimensions, seeds or uses are
// independent.

namespace duolux::test {
namespace {

using shared::kSamplerIndependent;
using shared::kSamplerSobol;

const ShaderLibrary& sampler() {
    static const ShaderLibrary library("shaders/lib/sampler.glsl");
    return library;
}

/// The numbers that identify a sample.
struct Name {
    std::uint32_t pixel, sample, dimension, seed;
};

/// The two words of a pair, and the upper 24 bits of a choice.
using Words = std::array<std::vector<std::uint32_t>, 3>;

Words draw(std::uint32_t kind, const std::vector<Name>& names) {
    std::vector<std::uint32_t> pixels, samples, dimensions, seeds;
    for (const Name& name : names) {
        pixels.push_back(name.pixel);
        samples.push_back(name.sample);
        dimensions.push_back(name.dimension);
        seeds.push_back(name.seed);
    }
    Words words;
    for (const glm::uvec3& v :
         sampler().evaluate<glm::uvec3>("result = uvec3(sampleWords(x0, x1, x2, x3, x4), "
                                        "uint(sampleChoice(x1, x2, x3, x4) * 16777216.0) << 8u);",
                                        kind, pixels, samples, dimensions, seeds)) {
        for (std::size_t w = 0; w < words.size(); ++w)
            words[w].push_back(v[static_cast<glm::length_t>(w)]);
    }
    return words;
}

/// The names of `count` samples, of which one member counts up.
std::vector<Name> counted(std::uint32_t Name::*member, std::uint32_t count, Name first = {5, 0, 4, 1}) {
    std::vector<Name> names(count, first);
    for (std::uint32_t i = 0; i < count; ++i)
        names[i].*member += i;
    return names;
}

const std::vector<std::pair<const char*, std::uint32_t Name::*>> kMembers{{"pixels", &Name::pixel},
                                                                          {"samples", &Name::sample},
                                                                          {"dimensions", &Name::dimension},
                                                                          {"seeds", &Name::seed}};

TEST(Sampler, WordsAreThoseOfThePublishedGenerators) {
    std::vector<Name> names;
    for (const glm::uvec4& v : randomWords4(2048))
        names.push_back({v.x, v.y, v.z, v.w});
    const Words sobol = draw(kSamplerSobol, names);
    const Words independent = draw(kSamplerIndependent, names);
    Census pairs("samplePair"), choices("sampleChoice");
    for (std::size_t i = 0; i < names.size(); ++i) {
        const auto& [pixel, sample, dimension, seed] = names[i];
        const glm::uvec2 pair = publishedPair(sample, publishedPcg4d({pixel, ~0u, dimension, seed}));
        const glm::uvec4 random = publishedPcg4d({pixel, sample, dimension, seed});
        pairs.compare(i, glm::uvec2(sobol[0][i], sobol[1][i]), pair);
        pairs.compare(i, glm::uvec2(independent[0][i], independent[1][i]), glm::uvec2(random.x, random.y));
        for (const Words* w : {&sobol, &independent})
            choices.compare(i, (*w)[2][i], random.z >> 8 << 8);
    }
}

/// The first 2^m samples of a pixel's dimension, as kernels draw them, have one point in each elementary
/// interval.
TEST(Sampler, SobolPairsOfAnyPixelAndDimensionAreNets) {
    for (const std::uint32_t pixel : {0u, 1u, 77777u}) {
        for (const std::uint32_t dimension : {0u, 1u, 65537u}) {
            for (std::uint32_t m = 1; m <= 8; ++m) {
                const std::uint32_t count = 1u << m;
                std::vector<std::uint32_t> samples;
                for (std::uint32_t i = 0; i < count; ++i)
                    samples.push_back(i);
                const std::vector<glm::vec2> points =
                    sampler().call<glm::vec2>("samplePair", kSamplerSobol, pixel, samples, dimension, 1u);
                for (std::uint32_t a = 0; a <= m; ++a) {
                    std::vector<int> counts(count);
                    for (const glm::vec2& p : points) {
                        const auto x = static_cast<std::uint32_t>(std::ldexp(p.x, static_cast<int>(a)));
                        const auto y = static_cast<std::uint32_t>(std::ldexp(p.y, static_cast<int>(m - a)));
                        ++counts.at(x << (m - a) | y);
                    }
                    EXPECT_EQ(std::count(counts.begin(), counts.end(), 1), count)
                        << "pixel " << pixel << " dimension " << dimension << ", 2^" << m << " points, split "
                        << a;
                }
            }
        }
    }
}

/// As any part of the name counts up, pairs and choices fall evenly into squares, and so does each number
/// with its successor. Consecutive samples of Sobol pairs are excepted, because they are more even than
/// independent numbers. One false alarm in 10^4.
TEST(Sampler, NumbersAreUniformAndSeriallyIndependent) {
    constexpr std::uint32_t kCount = 1 << 16;
    Family family;
    for (const std::uint32_t kind : {kSamplerSobol, kSamplerIndependent}) {
        for (const auto& [what, member] : kMembers) {
            const Words words = draw(kind, counted(member, kCount));
            const bool net = kind == kSamplerSobol && member == &Name::sample;
            for (std::size_t a = net ? 2 : 0; a < words.size(); ++a) {
                const std::string name = fmt::format("{}, kind {}, number {}", what, kind, a);
                const std::span<const std::uint32_t> word(words[a]);
                family.add(name + ", consecutive",
                           evenlyInSquares(word.first(kCount - 1), word.subspan(1), 5));
                family.add(name + ", serial correlation",
                           uncorrelated(word.first(kCount - 1), word.subspan(1)));
                for (std::size_t b = 0; b < a; ++b) {
                    family.add(fmt::format("{} with {}", name, b), evenlyInSquares(word, words[b], 5));
                    family.add(fmt::format("{}, correlation with {}", name, b), uncorrelated(word, words[b]));
                }
            }
        }
    }
    family.expect(1e-4);
}

/// Sequences of samples whose names differ by a step that occurs in renders: the next pixel, the pixel below
/// at a width of 512, the next purpose, crossing and scattering event, the next seed.
const std::vector<std::pair<const char*, Name>> kSteps{{"next pixel", {1, 0, 0, 0}},
                                                       {"pixel below", {512, 0, 0, 0}},
                                                       {"next purpose", {0, 0, 1, 0}},
                                                       {"next crossing", {0, 0, 4, 0}},
                                                       {"next scattering", {0, 0, 1u << 16, 0}},
                                                       {"next seed", {0, 0, 0, 1}},
                                                       {"next pixel and seed", {1, 0, 0, 1}}};

/// The correlation of two independent uniform sequences of n random numbers has mean 0 and deviation 1 /
/// sqrt(n). Sobol points with independent keys may have larger correlations (their deviation is 1.25 /
/// sqrt(n)), but of both signs equally often. Tests the mean over 128 places with Student's t for every pair
/// of components, with one false alarm in 10^4, and requires a root mean square below 2 / sqrt(n).
TEST(Sampler, PixelsDimensionsAndSeedsAreUncorrelated) {
    constexpr std::uint32_t kPlaces = 128;
    constexpr std::uint32_t kSamples = 256;
    const auto series = [&](std::uint32_t kind, const Name& step) {
        std::vector<Name> names;
        for (std::uint32_t place = 0; place < kPlaces; ++place) {
            const Name first{place * 1031 + step.pixel, 0, 4 + step.dimension, place + step.seed};
            for (const Name& name : counted(&Name::sample, kSamples, first))
                names.push_back(name);
        }
        return draw(kind, names);
    };
    Family family;
    for (const std::uint32_t kind : {kSamplerSobol, kSamplerIndependent}) {
        const Words base = series(kind, {});
        for (const auto& [what, step] : kSteps) {
            const Words other = series(kind, step);
            for (std::size_t c = 0; c < 4; ++c) {
                const std::string name =
                    fmt::format("{}, kind {}, components {} {}", what, kind, c / 2, c % 2);
                double mean = 0.0;
                double square = 0.0;
                for (std::size_t place = 0; place < kPlaces; ++place) {
                    const auto part = [&](const Words& words, std::size_t component) {
                        return std::span(words[component]).subspan(place * kSamples, kSamples);
                    };
                    const double r = correlation(part(base, c / 2), part(other, c % 2));
                    mean += r / kPlaces;
                    square += r * r / kPlaces;
                }
                EXPECT_LT(std::sqrt(square), 2.0 / std::sqrt(kSamples)) << name;
                const double deviation = std::sqrt((square - mean * mean) / (kPlaces - 1));
                family.add(name, studentTwoSided(mean / deviation, kPlaces - 1));
            }
        }
    }
    family.expect(1e-4);
}

/// Over many places, equal samples of two sequences fall evenly into the squares of (one, other).
TEST(Sampler, NeighboursAreJointlyUniform) {
    constexpr std::uint32_t kPlaces = 1 << 14;
    Family family;
    for (const std::uint32_t kind : {kSamplerSobol, kSamplerIndependent}) {
        const std::vector<Name> names = counted(&Name::seed, kPlaces, {5, 3, 4, 7});
        const Words base = draw(kind, names);
        for (const auto& [what, step] : kSteps) {
            std::vector<Name> moved = names;
            for (Name& name : moved)
                name = {name.pixel + step.pixel, name.sample, name.dimension + step.dimension,
                        name.seed + step.seed};
            const Words other = draw(kind, moved);
            for (std::size_t a = 0; a < base.size(); ++a) {
                for (std::size_t b = 0; b < other.size(); ++b)
                    family.add(fmt::format("{}, kind {}, numbers {} {}", what, kind, a, b),
                               evenlyInSquares(base[a], other[b], 4));
            }
        }
    }
    family.expect(1e-4);
}

TEST(SamplerOracles, AllFunctions) {
    const std::vector<std::uint32_t> a = randomWords(4096, 1), b = randomWords(4096, 2),
                                     c = randomWords(4096, 3), d = randomWords(4096, 4);
    EXPECT_ORACLES(sampler(), sampleDimension, (Budget{0, 0}), a, b, c);
    EXPECT_ORACLES(sampler(), sampleChoice, (Budget{0, 0}), a, b, c, d);
    for (const std::uint32_t kind : {kSamplerSobol, kSamplerIndependent}) {
        const std::vector<std::uint32_t> kinds(a.size(), kind);
        EXPECT_ORACLES(sampler(), sampleWords, (Budget{0, 0}), kinds, a, b, c, d);
        EXPECT_ORACLES(sampler(), samplePair, (Budget{0, 0}), kinds, a, b, c, d);
    }
}

}  // namespace
}  // namespace duolux::test

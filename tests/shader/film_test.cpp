#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "tests/shader/harness/census.h"
#include "tests/shader/mirror_types.h"

// The film's integers against 64-bit integers of the host.

namespace duolux::test {
namespace {

using mirror::single::FilmSum;

const ShaderLibrary& film() {
    static const ShaderLibrary library("shaders/lib/film.glsl");
    return library;
}

std::uint64_t wide(glm::uvec2 v) {
    return std::uint64_t{v.y} << 32 | v.x;
}

glm::uvec2 words(std::uint64_t v) {
    return {static_cast<std::uint32_t>(v), static_cast<std::uint32_t>(v >> 32)};
}

constexpr float kLargest = 0x1p56f;

/// The one number below a half that goes up though it is nearer to 0: a half added to it rounds to 1.
constexpr float kBelowHalf = 0x1.fffffep-2f;

/// The nearest integer to value x inverseQuantum, halves up, at most 2^56. The product is a float's.
std::uint64_t quanta(float value, float inverseQuantum) {
    const double scaled = static_cast<double>(std::min(value * inverseQuantum, kLargest));
    if (scaled == static_cast<double>(kBelowHalf)) return 1;
    return static_cast<std::uint64_t>(std::floor(scaled + 0.5));
}

/// Around every power of two, integers and halves: where floats lose their fraction (2^23), the low word
/// overflows (2^32), the largest is reached (2^56). Then anything.
std::vector<float> values() {
    std::vector<float> out{0.0f, 1e-45f, 1e-38f, 1e-30f, 0.25f,   0.49f,
                           0.5f, 0.51f,  1.5f,   2.5f,   3.4e38f, INFINITY};
    for (int e = 0; e < 64; ++e) {
        const float power = std::ldexp(1.0f, e);
        const float below = std::nextafter(power, 0.0f), above = std::nextafter(power, INFINITY);
        out.insert(out.end(), {std::nextafter(below, 0.0f), below, power, above,
                               std::nextafter(above, INFINITY), power + 0.5f, power - 0.5f, 1.5f * power});
    }
    std::mt19937 engine(1);
    std::uniform_real_distribution<float> uniform;
    for (int i = 0; i < 4096; ++i)
        out.push_back(std::exp2(90.0f * uniform(engine) - 30.0f));
    for (int i = 0; i < 4096; ++i)  // odd and even integers without a fraction, and the halves below
        out.push_back(std::floor(0x1p24f * uniform(engine)) * (i % 2 == 0 ? 1.0f : 0.5f));
    return out;
}

TEST(FilmQuantise, IsTheNearestInteger) {
    const std::vector<float> in = values();
    for (const float inverse : {1.0f, 0x1p-20f, 0x1p30f, 0x1p120f}) {
        std::vector<float> scaled = in;
        for (float& x : scaled)
            x /= inverse;
        const auto out = film().call<glm::uvec2>("filmQuantise", scaled, inverse);
        Census census("filmQuantise by " + std::to_string(inverse));
        for (std::size_t i = 0; i < in.size(); ++i)
            census.compare(i, out[i], words(quanta(scaled[i], inverse)));
    }
}

/// All pairs of numbers at which words overflow, and random ones.
std::pair<std::vector<glm::uvec2>, std::vector<glm::uvec2>> operands() {
    const std::vector<std::uint64_t> edges{0,
                                           1,
                                           2,
                                           0x7fffffff,
                                           0x80000000,
                                           0xffffffff,
                                           0x100000000,
                                           0x100000001,
                                           0x1ffffffff,
                                           std::uint64_t{1} << 56,
                                           0x7fffffffffffffff,
                                           0x8000000000000000,
                                           0xffffffff00000000,
                                           0xffffffffffffffff};
    std::pair<std::vector<glm::uvec2>, std::vector<glm::uvec2>> out;
    for (const std::uint64_t a : edges) {
        for (const std::uint64_t b : edges) {
            out.first.push_back(words(a));
            out.second.push_back(words(b));
        }
    }
    std::mt19937_64 engine(2);
    for (int i = 0; i < 4096; ++i) {
        out.first.push_back(words(engine()));
        out.second.push_back(words(engine() >> (i % 64)));
    }
    return out;
}

TEST(FilmAdd, IsThatOf64BitIntegers) {
    const auto [a, b] = operands();
    const auto sum = film().call<glm::uvec2>("filmAdd", a, b);
    Census census("filmAdd");
    for (std::size_t i = 0; i < a.size(); ++i)
        census.compare(i, sum[i], words(wide(a[i]) + wide(b[i])));
}

TEST(FilmNegate, IsTheTwosComplement) {
    const auto [a, b] = operands();
    const auto negative = film().call<glm::uvec2>("filmNegate", a);
    Census census("filmNegate");
    for (std::size_t i = 0; i < a.size(); ++i)
        census.compare(i, negative[i], words(0 - wide(a[i])));
}

TEST(FilmAddSigned, IsThatOf64BitIntegers) {
    const std::vector<float> magnitudes = values();
    std::vector<glm::uvec2> sums;
    std::vector<float> terms;
    std::mt19937_64 engine(3);
    for (std::size_t i = 0; i < magnitudes.size(); ++i) {
        for (const float sign : {1.0f, -1.0f}) {
            // Sums of both signs, those that a term takes across 0 or across a word among them.
            const std::uint64_t sum = i % 3 == 0   ? engine()
                                      : i % 3 == 1 ? quanta(magnitudes[i], 4.0f)
                                                   : 0 - quanta(magnitudes[i], 4.0f);
            sums.push_back(words(sum));
            terms.push_back(sign * magnitudes[i]);
        }
    }
    const auto out = film().call<glm::uvec2>("filmAddSigned", sums, terms, 4.0f);
    Census census("filmAddSigned");
    for (std::size_t i = 0; i < sums.size(); ++i) {
        const std::uint64_t term = quanta(std::abs(terms[i]), 4.0f);
        census.compare(i, out[i], words(terms[i] < 0.0f ? wide(sums[i]) - term : wide(sums[i]) + term));
    }
}

TEST(FilmAccumulate, AddsEveryChannel) {
    const std::vector<float> in = values();
    std::vector<FilmSum> sums;
    std::vector<glm::vec3> radiances;
    std::mt19937_64 engine(4);
    for (std::size_t i = 0; i < in.size(); ++i) {
        sums.push_back({words(engine()), words(engine()), words(engine())});
        radiances.emplace_back(in[i], in[(i + 1) % in.size()], in[(i + 2) % in.size()]);
    }
    const auto out = film().call<FilmSum>("filmAccumulate", sums, radiances, 0.25f);
    Census census("filmAccumulate");
    for (std::size_t i = 0; i < sums.size(); ++i) {
        census.compare(i, out[i].r, words(wide(sums[i].r) + quanta(radiances[i].r, 0.25f)));
        census.compare(i, out[i].g, words(wide(sums[i].g) + quanta(radiances[i].g, 0.25f)));
        census.compare(i, out[i].b, words(wide(sums[i].b) + quanta(radiances[i].b, 0.25f)));
    }
}

// Quanta are powers of two, so that not even the product rounds: the device is exact, whatever computes.
TEST(FilmOracles, Integers) {
    const Budget exact{0, 0};
    std::vector<float> in = values();
    // Devices may take the smallest for 0, and double precision rounds a half correctly.
    std::erase_if(in, [](float x) { return (x < 1e-37f && x != 0.0f) || x * 0x1p10f == kBelowHalf; });
    const std::vector<float> inverses(in.size(), 0x1p10f);
    EXPECT_ORACLES(film(), filmQuantise, exact, in, inverses);
    const auto [a, b] = operands();
    EXPECT_ORACLES(film(), filmAdd, exact, a, b);
    EXPECT_ORACLES(film(), filmNegate, exact, a);
    std::vector<glm::uvec2> sums(in.size());
    std::vector<glm::vec3> radiances(in.size());
    std::vector<FilmSum> filmSums(in.size());
    for (std::size_t i = 0; i < in.size(); ++i) {
        sums[i] = a[i % a.size()];
        filmSums[i] = {a[i % a.size()], b[i % a.size()], a[(i + 1) % a.size()]};
        radiances[i] = glm::vec3(in[i], in[(i + 7) % in.size()], in[(i + 31) % in.size()]);
    }
    EXPECT_ORACLES(film(), filmAddSigned, exact, sums, in, inverses);
    EXPECT_ORACLES(film(), filmAccumulate, exact, filmSums, radiances, inverses);
    EXPECT_EQ(numbers(film().call<FilmSum>("filmZero")[0]), numbers(mirror::single::filmZero()));
}

}  // namespace
}  // namespace duolux::test

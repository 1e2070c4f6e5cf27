#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "tests/shader/harness/census.h"
#include "tests/shader/mirror_types.h"
#include "tests/shader/uniformity.h"

// Compares the film's integers with 64-bit integers of the host.

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

constexpr float kLargest = 0x1p58f;

/// The integer below value x inverseQuantum, or the next one if u is less than the fraction; at most 2^58.
/// The product is rounded to a float.
std::uint64_t quanta(float value, float inverseQuantum, float u) {
    const double scaled = static_cast<double>(std::min(value * inverseQuantum, kLargest));
    const double whole = std::floor(scaled);
    return static_cast<std::uint64_t>(whole) + (static_cast<double>(u) < scaled - whole ? 1 : 0);
}

/// Integers and halves around every power of two, including those where floats lose their fraction (2^23),
/// the low word overflows (2^32) and the maximum is reached (2^58); then random values.
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
    for (int i = 0; i < 4096; ++i)  // odd and even integers, and halves
        out.push_back(std::floor(0x1p24f * uniform(engine)) * (i % 2 == 0 ? 1.0f : 0.5f));
    return out;
}

/// Uniform numbers as kernels generate them, including both ends.
std::vector<float> uniformNumbers(std::size_t count) {
    std::mt19937 engine(5);
    std::vector<float> out{0.0f, 0x1.fffffep-1f, 0.5f, 0.25f};
    while (out.size() < count)
        out.push_back(static_cast<float>(engine() >> 8) * 0x1p-24f);
    out.resize(count);
    return out;
}

TEST(FilmQuantise, IsOneOfTheIntegersBeside) {
    const std::vector<float> in = values(), u = uniformNumbers(in.size());
    for (const float inverse : {1.0f, 0x1p-20f, 0x1p30f, 0x1p120f}) {
        std::vector<float> scaled = in;
        for (float& x : scaled)
            x /= inverse;
        const auto out = film().call<glm::uvec2>("filmQuantise", scaled, inverse, u);
        Census census("filmQuantise by " + std::to_string(inverse));
        for (std::size_t i = 0; i < in.size(); ++i)
            census.compare(i, out[i], words(quanta(scaled[i], inverse, u[i])));
    }
}

// The mean over all uniform numbers (2^24, in steps of 2^12) is the value, however small it is.
TEST(FilmQuantise, HasNoBias) {
    constexpr std::size_t kNumbers = 4096;
    for (const float value : {0x1p-12f, 3e-4f, 0.01f, 0.3f, 0.5f, 0.875f, 1.25f, 1000.1f, 4194303.75f}) {
        const std::vector<float> values(kNumbers, value);
        std::vector<float> u;
        for (std::size_t i = 0; i < kNumbers; ++i)
            u.push_back(static_cast<float>(i) * 0x1p-12f);
        double sum = 0.0;
        for (const glm::uvec2& out : film().call<glm::uvec2>("filmQuantise", values, 1.0f, u))
            sum += static_cast<double>(wide(out));
        EXPECT_NEAR(sum / kNumbers, static_cast<double>(value), 1.0 / kNumbers) << value;
    }
}

// The six numbers of a sample are uniform, and independent of each other, of those of its neighbours and of
// the sampler's. All tests together fail by chance once in 10^6 seeds; the seeds are fixed.
TEST(FilmRounding, IsUniformAndIndependent) {
    constexpr std::uint32_t kSamples = 1 << 16;
    std::vector<std::uint32_t> a(kSamples), b(kSamples);
    for (std::uint32_t i = 0; i < kSamples; ++i) {
        a[i] = i / 256;
        b[i] = i % 256;
    }
    const auto numbersOf = [&](const char* expression) {
        std::vector<std::uint32_t> words;
        for (const float u : film().evaluate<float>(expression, a, b))
            words.push_back(static_cast<std::uint32_t>(u * 0x1p32f));
        return words;
    };
    std::vector<std::vector<std::uint32_t>> numbers;
    for (const char* part : {"invisible", "visible"}) {
        for (const char* channel : {"r", "g", "b"}) {
            const std::string code =
                "result = filmRounding(x0, x1, 0u, 7u)." + std::string(part) + "." + channel + ";";
            numbers.push_back(numbersOf(code.c_str()));
        }
    }
    numbers.push_back(numbersOf("result = uniformFloat(pcg4d(uvec4(x0, x1, 0u, 7u)).x);"));
    numbers.push_back(numbersOf("result = uniformFloat(pcg4d(uvec4(x0, x1, 0u, 7u)).z);"));
    numbers.push_back(numbersOf("result = filmRounding(x0, x1 + 1u, 0u, 7u).invisible.r;"));
    numbers.push_back(numbersOf("result = filmRounding(x0, x1, 0u, 8u).invisible.r;"));
    Family family;
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        std::vector<std::uint32_t> high;
        for (const std::uint32_t word : numbers[i])
            high.push_back(word >> 24);
        family.add("bins " + std::to_string(i), evenly(high, 256));
        for (std::size_t k = 0; k < i; ++k)
            family.add("pair " + std::to_string(i), evenlyInSquares(numbers[i], numbers[k], 4));
    }
    family.expect(1e-6);
}

/// All pairs of numbers at which words overflow, and random pairs.
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
            // Sums of both signs, including those for which a term crosses 0 or a word boundary.
            const std::uint64_t sum = i % 3 == 0   ? engine()
                                      : i % 3 == 1 ? quanta(magnitudes[i], 4.0f, 0.5f)
                                                   : 0 - quanta(magnitudes[i], 4.0f, 0.5f);
            sums.push_back(words(sum));
            terms.push_back(sign * magnitudes[i]);
        }
    }
    const auto out = film().call<glm::uvec2>("filmAddSigned", sums, terms, 4.0f);
    Census census("filmAddSigned");
    for (std::size_t i = 0; i < sums.size(); ++i) {
        const std::uint64_t term = quanta(std::abs(terms[i]), 4.0f, 0.5f);
        census.compare(i, out[i], words(terms[i] < 0.0f ? wide(sums[i]) - term : wide(sums[i]) + term));
    }
}

TEST(FilmAccumulate, AddsEveryChannel) {
    const std::vector<float> in = values();
    std::vector<FilmSum> sums;
    std::vector<glm::vec3> radiances, u;
    const std::vector<float> uniform = uniformNumbers(in.size());
    std::mt19937_64 engine(4);
    for (std::size_t i = 0; i < in.size(); ++i) {
        sums.push_back({words(engine()), words(engine()), words(engine())});
        radiances.emplace_back(in[i], in[(i + 1) % in.size()], in[(i + 2) % in.size()]);
        u.emplace_back(uniform[i], uniform[(i + 7) % in.size()], uniform[(i + 11) % in.size()]);
    }
    const auto out = film().call<FilmSum>("filmAccumulate", sums, radiances, 0.25f, u);
    Census census("filmAccumulate");
    for (std::size_t i = 0; i < sums.size(); ++i) {
        census.compare(i, out[i].r, words(wide(sums[i].r) + quanta(radiances[i].r, 0.25f, u[i].r)));
        census.compare(i, out[i].g, words(wide(sums[i].g) + quanta(radiances[i].g, 0.25f, u[i].g)));
        census.compare(i, out[i].b, words(wide(sums[i].b) + quanta(radiances[i].b, 0.25f, u[i].b)));
    }
}

TEST(FilmAccumulateSigned, AddsEveryChannelToTheNearest) {
    const std::vector<float> in = values();
    std::vector<FilmSum> sums;
    std::vector<glm::vec3> terms;
    std::mt19937_64 engine(5);
    for (std::size_t i = 0; i < in.size(); ++i) {
        sums.push_back({words(engine()), words(engine()), words(engine())});
        terms.emplace_back(in[i], -in[(i + 1) % in.size()], in[(i + 2) % in.size()]);
    }
    const auto out = film().call<FilmSum>("filmAccumulateSigned", sums, terms, 0.25f);
    Census census("filmAccumulateSigned");
    for (std::size_t i = 0; i < sums.size(); ++i) {
        census.compare(i, out[i].r, words(wide(sums[i].r) + quanta(terms[i].x, 0.25f, 0.5f)));
        census.compare(i, out[i].g, words(wide(sums[i].g) - quanta(-terms[i].y, 0.25f, 0.5f)));
        census.compare(i, out[i].b, words(wide(sums[i].b) + quanta(terms[i].z, 0.25f, 0.5f)));
    }
}

// Quanta are powers of two, so even the product does not round: every device is exact.
TEST(FilmOracles, Integers) {
    const Budget exact{0, 0};
    std::vector<float> in = values();
    // Devices may flush the smallest numbers to 0.
    std::erase_if(in, [](float x) { return x < 1e-37f && x != 0.0f; });
    const std::vector<float> uniform = uniformNumbers(in.size());
    const std::vector<float> inverses(in.size(), 0x1p10f);
    EXPECT_ORACLES(film(), filmQuantise, exact, in, inverses, uniform);
    const auto [a, b] = operands();
    EXPECT_ORACLES(film(), filmAdd, exact, a, b);
    EXPECT_ORACLES(film(), filmNegate, exact, a);
    std::vector<glm::uvec2> sums(in.size());
    std::vector<glm::vec3> radiances(in.size()), u(in.size());
    std::vector<FilmSum> filmSums(in.size());
    for (std::size_t i = 0; i < in.size(); ++i) {
        sums[i] = a[i % a.size()];
        filmSums[i] = {a[i % a.size()], b[i % a.size()], a[(i + 1) % a.size()]};
        radiances[i] = glm::vec3(in[i], in[(i + 7) % in.size()], in[(i + 31) % in.size()]);
        u[i] = glm::vec3(uniform[i], uniform[(i + 7) % in.size()], uniform[(i + 31) % in.size()]);
    }
    EXPECT_ORACLES(film(), filmAddSigned, exact, sums, in, inverses);
    EXPECT_ORACLES(film(), filmAccumulate, exact, filmSums, radiances, inverses, u);
    EXPECT_ORACLES(film(), filmAccumulateSigned, exact, filmSums, radiances, inverses);
    EXPECT_EQ(numbers(film().call<FilmSum>("filmZero")[0]), numbers(mirror::single::filmZero()));
}

}  // namespace
}  // namespace duolux::test

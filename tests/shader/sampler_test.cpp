#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "tests/support/run_kernel.h"

namespace duolux::spirv {
extern const std::span<const std::uint32_t> kSamplerTest;
}

namespace duolux::test {
namespace {

using Vector = std::array<std::uint32_t, 4>;

struct Push {
    std::uint32_t count, function;
};

std::vector<Vector> evaluate(const std::vector<Vector>& inputs, std::uint32_t function) {
    const Buffer input = Buffer::upload<Vector>(device(), BufferUse::kStorage, inputs, "inputs");
    const auto count = static_cast<std::uint32_t>(inputs.size());
    return runKernel<Vector>(spirv::kSamplerTest, {{0, &input}}, 1, Push{count, function}, count);
}

float asFloat(std::uint32_t bits) {
    float f = 0.0f;
    std::memcpy(&f, &bits, sizeof f);
    return f;
}

/// pcg4d as published, written again for the host.
Vector pcg4d(Vector v) {
    for (auto& x : v)
        x = x * 1664525u + 1013904223u;
    const auto mix = [&] {
        v[0] += v[1] * v[3];
        v[1] += v[2] * v[0];
        v[2] += v[0] * v[1];
        v[3] += v[1] * v[2];
    };
    mix();
    for (auto& x : v)
        x ^= x >> 16;
    mix();
    return v;
}

TEST(Rng, MatchesThePublishedGenerator) {
    std::vector<Vector> inputs;
    for (std::uint32_t i = 0; i < 1000; ++i)
        inputs.push_back({i, i * 7919u, ~i, i << 20});
    const std::vector<Vector> outputs = evaluate(inputs, 0);
    for (std::size_t i = 0; i < inputs.size(); ++i)
        EXPECT_EQ(outputs[i], pcg4d(inputs[i])) << i;
}

std::uint32_t reversed(std::uint32_t x) {
    std::uint32_t r = 0;
    for (int i = 0; i < 32; ++i)
        r |= (x >> i & 1u) << (31 - i);
    return r;
}

TEST(Upload, ThroughAStagingBufferGivesTheSame) {
    std::vector<Vector> inputs;
    for (std::uint32_t i = 0; i < 5000; ++i)
        inputs.push_back({i, ~i, i * i, i << 7});
    const Buffer staged =
        Buffer::uploadStaged(device(), BufferUse::kStorage, std::as_bytes(std::span(inputs)), "inputs");
    const auto count = static_cast<std::uint32_t>(inputs.size());
    EXPECT_EQ(runKernel<Vector>(spirv::kSamplerTest, {{0, &staged}}, 1, Push{count, 0}, count),
              evaluate(inputs, 0));
}

TEST(Sobol, SecondDimensionMatchesTheDirectionNumbers) {
    // Primitive polynomial x + 1: v_1 = 2^31, v_(i+1) = v_i ^ (v_i >> 1) (Joe and Kuo, 2008).
    std::array<std::uint32_t, 32> direction{};
    direction[0] = 1u << 31;
    for (std::size_t i = 1; i < 32; ++i)
        direction[i] = direction[i - 1] ^ direction[i - 1] >> 1;
    std::vector<Vector> inputs;
    for (std::uint32_t i = 0; i < 4096; ++i)
        inputs.push_back({i < 2048 ? i : i * 2654435761u, 0, 0, 0});
    const std::vector<Vector> outputs = evaluate(inputs, 1);
    for (std::size_t k = 0; k < inputs.size(); ++k) {
        std::uint32_t expected = 0;
        for (std::size_t bit = 0; bit < 32; ++bit) {
            if ((inputs[k][0] >> bit & 1u) != 0) expected ^= direction[bit];
        }
        EXPECT_EQ(reversed(outputs[k][0]), expected) << inputs[k][0];
    }
}

/// Every elementary interval of 2^m points in base 2 holds exactly one of the first 2^m points: a (0, m,
/// 2)-net. Owen scrambling keeps the property, and so does the shuffling of the index.
TEST(Sobol, ScrambledPairsAreNets) {
    constexpr std::uint32_t kLog = 8;
    constexpr std::uint32_t kPoints = 1u << kLog;
    for (std::uint32_t pixel : {0u, 1u, 77777u}) {
        for (std::uint32_t dimension : {0u, 1u, 65537u}) {
            std::vector<Vector> inputs;
            for (std::uint32_t i = 0; i < kPoints; ++i)
                inputs.push_back({i, pixel, dimension, 1});
            const std::vector<Vector> points = evaluate(inputs, 2);
            for (std::uint32_t a = 0; a <= kLog; ++a) {
                std::vector<int> count(kPoints);
                for (const Vector& p : points) {
                    const auto x = static_cast<std::uint32_t>(std::ldexp(asFloat(p[0]), static_cast<int>(a)));
                    const auto y =
                        static_cast<std::uint32_t>(std::ldexp(asFloat(p[1]), static_cast<int>(kLog - a)));
                    ++count[x << (kLog - a) | y];
                }
                EXPECT_EQ(std::count(count.begin(), count.end(), 1), kPoints)
                    << "pixel " << pixel << " dimension " << dimension << " split " << a;
            }
        }
    }
}

/// Pairs of different dimensions, and of different pixels, are independent: their correlation over n points
/// is about normal with deviation 1 / sqrt(n). 3 x 2 comparisons at 5 deviations: a false alarm once in 10^5.
TEST(Sobol, DimensionsPixelsAndSeedsAreUncorrelated) {
    constexpr std::uint32_t kPoints = 1 << 14;
    const auto series = [&](std::uint32_t pixel, std::uint32_t dimension, std::uint32_t seed) {
        std::vector<Vector> inputs;
        for (std::uint32_t i = 0; i < kPoints; ++i)
            inputs.push_back({i, pixel, dimension, seed});
        return evaluate(inputs, 2);
    };
    const std::vector<Vector> base = series(5, 4, 1);
    const std::vector<std::vector<Vector>> others{series(5, 8, 1), series(6, 4, 1), series(5, 4, 2)};
    for (const std::vector<Vector>& other : others) {
        for (std::size_t component : {0u, 1u}) {
            double sum = 0.0;
            for (std::uint32_t i = 0; i < kPoints; ++i) {
                sum += (static_cast<double>(asFloat(base[i][component])) - 0.5) *
                       (static_cast<double>(asFloat(other[i][component])) - 0.5) * 12.0;
            }
            EXPECT_LT(std::abs(sum / kPoints), 5.0 / std::sqrt(kPoints));
        }
    }
}

}  // namespace
}  // namespace duolux::test

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <set>

#include "host/base/random.h"

namespace duolux {
namespace {

TEST(Random, IsSplitMix64) {
    // The upper halves of the published numbers for the state 0: e220a8397b1dcdaf, 6e789e6aa1b965f4, ...
    Random random(0);
    EXPECT_EQ(random.bits(), 0xe220a839u);
    EXPECT_EQ(random.bits(), 0x6e789e6au);
    EXPECT_EQ(random.bits(), 0x06c45d18u);
}

TEST(Random, StreamsDoNotOverlap) {
    std::set<std::uint32_t> numbers;
    for (std::uint64_t seed = 0; seed < 8; ++seed) {
        for (std::uint64_t stream = 0; stream < 8; ++stream) {
            Random random(seed, stream);
            for (int i = 0; i < 8; ++i)
                numbers.insert(random.bits());
        }
    }
    EXPECT_EQ(numbers.size(), 512u);  // two of 512 random numbers are equal with a probability of 3e-5
}

TEST(Random, UniformNumbersAreTheUpperBits) {
    Random bits(7), uniform(7);
    for (int i = 0; i < 100; ++i)
        EXPECT_EQ(uniform.uniform(), std::ldexp(static_cast<float>(bits.bits() >> 8), -24));
}

TEST(Random, CosineDirectionsHaveTheMomentsOfACosine) {
    constexpr int kCount = 100'000;
    const glm::vec3 normal = glm::normalize(glm::vec3(1.0f, -2.0f, 0.5f));
    Random random(1);
    double first = 0.0, second = 0.0;
    glm::dvec3 sum(0.0);
    for (int i = 0; i < kCount; ++i) {
        const glm::vec3 direction = cosineDirection(normal, random);
        ASSERT_NEAR(glm::length(direction), 1.0f, 1e-6f);
        const auto cosine = static_cast<double>(glm::dot(direction, normal));
        ASSERT_GT(cosine, -1e-6);
        first += cosine / kCount;
        second += cosine * cosine / kCount;
        sum += glm::dvec3(direction) / static_cast<double>(kCount);
    }
    // Variances: 1/18 of the cosine, 1/12 of its square, 1/4 of each tangential component. Five sigma.
    EXPECT_NEAR(first, 2.0 / 3.0, 5.0 * std::sqrt(1.0 / 18.0 / kCount));
    EXPECT_NEAR(second, 0.5, 5.0 * std::sqrt(1.0 / 12.0 / kCount));
    EXPECT_NEAR(glm::length(sum - glm::dvec3(normal) * first), 0.0, 5.0 * std::sqrt(0.5 / kCount));
}

}  // namespace
}  // namespace duolux

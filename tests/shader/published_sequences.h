#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>

// Independent implementations of the library's random numbers and Sobol points, from the publications.

namespace duolux::test {

/// Jarzynski and Olano, "Hash Functions for GPU Rendering", JCGT 9(3), 2020.
inline glm::uvec4 publishedPcg4d(const glm::uvec4& input) {
    std::array<std::uint32_t, 4> v{};
    for (std::size_t i = 0; i < 4; ++i)
        v[i] = input[static_cast<glm::length_t>(i)] * 1664525u + 1013904223u;
    const auto mix = [&] {
        v[0] += v[1] * v[3];
        v[1] += v[2] * v[0];
        v[2] += v[0] * v[1];
        v[3] += v[1] * v[2];
    };
    mix();
    for (std::uint32_t& x : v)
        x ^= x >> 16;
    mix();
    return {v[0], v[1], v[2], v[3]};
}

inline std::uint32_t reversed(std::uint32_t x) {
    std::uint32_t r = 0;
    for (int i = 0; i < 32; ++i)
        r |= (x >> i & 1u) << (31 - i);
    return r;
}

/// Vegdahl, "Building a Better LK Hash", 2021: nested scrambling of a number whose bits are in their usual
/// order.
inline std::uint32_t publishedScramble(std::uint32_t number, std::uint32_t seed) {
    std::uint32_t x = reversed(number);
    x ^= x * 0x3d20adeau;
    x += seed;
    x *= (seed >> 16) | 1u;
    x ^= x * 0x05526c56u;
    x ^= x * 0x53a22864u;
    return reversed(x);
}

/// Coordinate 0 or 1 of a Sobol point, in units of 2^-32, from direction numbers: v_i = 2^(32 - i) for the
/// first, v_1 = 2^31 and v_(i + 1) = v_i ^ (v_i >> 1) for the second, whose primitive polynomial is x + 1
/// (Joe and Kuo, "Constructing Sobol Sequences with Better Two-Dimensional Projections", SISC 30, 2008).
inline std::uint32_t publishedSobol(std::uint32_t index, int dimension) {
    std::uint32_t direction = 1u << 31;
    std::uint32_t sum = 0;
    for (; index != 0; index >>= 1) {
        if ((index & 1u) != 0) sum ^= direction;
        direction = dimension == 0 ? direction >> 1 : direction ^ direction >> 1;
    }
    return sum;
}

/// Burley, "Practical Hash-based Owen Scrambling", JCGT 9(4), 2020: the index is shuffled, each coordinate
/// scrambled.
inline glm::uvec2 publishedPair(std::uint32_t index, const glm::uvec4& key) {
    const std::uint32_t shuffled = publishedScramble(index, key.x);
    return {publishedScramble(publishedSobol(shuffled, 0), key.y),
            publishedScramble(publishedSobol(shuffled, 1), key.z)};
}

}  // namespace duolux::test

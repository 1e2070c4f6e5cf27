#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <random>
#include <vector>

// Inputs for shader functions, identical on every run and machine.

namespace duolux::test {

/// The centres of n x n cells: a stratified sample of the unit square.
inline std::vector<glm::vec2> unitSquare(int n) {
    std::vector<glm::vec2> us;
    for (int i = 0; i < n * n; ++i)
        us.push_back((glm::vec2(i % n, i / n) + 0.5f) / static_cast<float>(n));
    return us;
}

inline std::vector<std::uint32_t> randomWords(std::size_t n, std::uint32_t seed = 1) {
    std::mt19937 generator(seed);
    std::vector<std::uint32_t> words;
    for (std::size_t i = 0; i < n; ++i)
        words.push_back(static_cast<std::uint32_t>(generator()));
    return words;
}

inline std::vector<glm::uvec2> randomWords2(std::size_t n, std::uint32_t seed = 1) {
    const std::vector<std::uint32_t> words = randomWords(2 * n, seed);
    std::vector<glm::uvec2> vectors;
    for (std::size_t i = 0; i < words.size(); i += 2)
        vectors.emplace_back(words[i], words[i + 1]);
    return vectors;
}

inline std::vector<glm::uvec4> randomWords4(std::size_t n, std::uint32_t seed = 1) {
    const std::vector<std::uint32_t> words = randomWords(4 * n, seed);
    std::vector<glm::uvec4> vectors;
    for (std::size_t i = 0; i < words.size(); i += 4)
        vectors.emplace_back(words[i], words[i + 1], words[i + 2], words[i + 3]);
    return vectors;
}

/// Uniform in [0, 1), multiples of 2^-24.
inline std::vector<glm::vec2> randomSquare(std::size_t n, std::uint32_t seed = 1) {
    const std::vector<std::uint32_t> words = randomWords(2 * n, seed);
    std::vector<glm::vec2> us;
    for (std::size_t i = 0; i < n; ++i)
        us.push_back(glm::vec2(words[2 * i] >> 8, words[2 * i + 1] >> 8) * 0x1p-24f);
    return us;
}

/// Uniform on the sphere; unit length up to the rounding of each component.
inline std::vector<glm::vec3> randomDirections(std::size_t n, std::uint32_t seed = 1) {
    std::vector<glm::vec3> directions;
    for (const glm::vec2 u : randomSquare(n, seed)) {
        const double z = 2.0 * static_cast<double>(u.x) - 1.0;
        const double phi = 2.0 * 3.14159265358979323846 * static_cast<double>(u.y);
        const double r = std::sqrt(1.0 - z * z);
        directions.emplace_back(glm::dvec3(r * std::cos(phi), r * std::sin(phi), z));
    }
    return directions;
}

/// Of both signs, with magnitudes from 2^lower to 2^upper, every binade with equal frequency.
inline std::vector<float> randomScales(std::size_t n, double lower, double upper, std::uint32_t seed = 1) {
    std::vector<float> floats;
    for (const glm::vec2 u : randomSquare(n, seed)) {
        const double magnitude = std::exp2(lower + (upper - lower) * static_cast<double>(u.x));
        floats.push_back(static_cast<float>(u.y < 0.5f ? -magnitude : magnitude));
    }
    return floats;
}

}  // namespace duolux::test

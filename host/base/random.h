#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <numbers>

namespace duolux {

/// Random numbers of the host: SplitMix64 (Steele, Lea, Flood, "Fast Splittable Pseudorandom Number
/// Generators", 2014).
class Random {
  public:
    /// For a fixed seed: the sequence of seed s + n is that of seed s without its first n numbers.
    explicit Random(std::uint64_t seed) : state_(seed * kIncrement) {}

    /// For many sequences: those of other seeds, of other streams and of the other constructor are unrelated.
    Random(std::uint64_t seed, std::uint64_t stream)
        : state_(mixed(mixed((seed + 1) * kIncrement) + stream * kIncrement)) {}

    std::uint32_t bits() {
        state_ += kIncrement;
        return static_cast<std::uint32_t>(mixed(state_) >> 32);
    }

    /// Uniform in [0, 1).
    float uniform() { return static_cast<float>(bits() >> 8) * 0x1p-24f; }

  private:
    static std::uint64_t mixed(std::uint64_t z) {
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
        return z ^ (z >> 31);
    }

    static constexpr std::uint64_t kIncrement = 0x9e3779b97f4a7c15ull;
    std::uint64_t state_;
};

/// A unit vector, cosine-distributed about the normal (unit).
inline glm::vec3 cosineDirection(const glm::vec3& normal, Random& random) {
    const float z = 1.0f - 2.0f * random.uniform();
    const float phi = 2.0f * std::numbers::pi_v<float> * random.uniform();
    const float r = std::sqrt(std::max(0.0f, 1.0f - z * z));
    // A uniform point on the unit sphere that is tangent to the surface.
    const glm::vec3 sum = normal + glm::vec3(r * std::cos(phi), r * std::sin(phi), z);
    const float length = glm::length(sum);
    return length > 1e-3f ? sum / length : normal;
}

}  // namespace duolux

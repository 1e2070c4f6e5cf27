#pragma once

#include <compare>
#include <cstdint>
#include <limits>

namespace duolux {

/// What the values of an image file become when it is decoded, where the file holds another quantity than the
/// texture that uses it.
struct ImageConversion {
    enum class Kind : std::uint8_t {
        kNone,
        kHeights,    ///< heights become normals
        kExponents,  ///< fractions of Phong's exponent `factor` become roughness
        kGlossiness  ///< fractions of the glossiness `factor` become roughness, 1 - glossiness
    };
    static constexpr std::uint32_t kLuminance = 4;

    Kind kind = Kind::kNone;
    float base = 0.0f, gain = 1.0f;  ///< at first every value v but alpha becomes base + gain v
    std::uint32_t channel = 0;       ///< that holds the quantity, 0..3, or kLuminance
    float factor = 1.0f;             ///< >= 0
    /// kExponents: the roughness is 0 from this exponent on.
    float mirrorFrom = std::numeric_limits<float>::infinity();
    bool repeats = true;  ///< kHeights: whether the first column and row follow the last ones

    auto operator<=>(const ImageConversion&) const = default;
};

}  // namespace duolux

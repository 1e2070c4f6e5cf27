#pragma once

#include <cstdint>

namespace duolux {

/// The sRGB transfer function and its inverse (IEC 61966-2-1:1999, clause 5.2), on [0, 1].
double srgbEncode(double linear);
double srgbDecode(double encoded);

/// Linear value to the nearest 8-bit sRGB code: clamped to [0, 1], NaN becomes 0.
std::uint8_t toSrgb8(double linear);

/// The linear value of an 8-bit sRGB code. toSrgb8(fromSrgb8(code)) == code.
float fromSrgb8(std::uint8_t code);

}  // namespace duolux

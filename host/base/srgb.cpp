#include "host/base/srgb.h"

#include <array>
#include <cmath>

namespace duolux {

double srgbEncode(double linear) {
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055;
}

double srgbDecode(double encoded) {
    return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

std::uint8_t toSrgb8(double linear) {
    if (!(linear > 0.0)) return 0;  // also NaN
    if (linear >= 1.0) return 255;
    return static_cast<std::uint8_t>(std::floor(255.0 * srgbEncode(linear) + 0.5));
}

float fromSrgb8(std::uint8_t code) {
    static const std::array<float, 256> table = [] {
        std::array<float, 256> values{};
        for (int i = 0; i < 256; ++i)
            values[i] = static_cast<float>(srgbDecode(i / 255.0));
        return values;
    }();
    return table[code];
}

}  // namespace duolux

#include "host/render/film_quantum.h"

#include <algorithm>
#include <cmath>

namespace duolux {

namespace {

constexpr int kStep = 40;  // factor between the quanta of two looks, as a power of two
constexpr int kLeastExponent = -120,
              kMostExponent = 100;       // exponents of quanta; their inverses are floats as well
constexpr double kFewestQuanta = 256.0;  // sum; fewer quanta do not determine the brightness of the image
constexpr double kDarkest = 0x1p-13;     // a darker component counts down to this fraction of the other

float powerOfTwo(int exponent) {
    return std::ldexp(1.0f, std::clamp(exponent, kLeastExponent, kMostExponent));
}

int exponentOf(double value) {
    return static_cast<int>(std::floor(std::log2(value)));
}

}  // namespace

float findQuantum(double brightest, const std::function<FirstLook(float)>& look) {
    if (!(brightest > 0.0)) return powerOfTwo(-30);
    int exponent = std::clamp(exponentOf(brightest) - 50, kLeastExponent, kMostExponent);
    FirstLook shown = look(powerOfTwo(exponent));
    while (shown.clamped && exponent + kStep <= kMostExponent) {
        exponent += kStep;
        shown = look(powerOfTwo(exponent));
    }
    while (!shown.clamped && std::max(shown.invisible, shown.visible) < kFewestQuanta &&
           exponent - kStep >= kLeastExponent) {
        exponent -= kStep;
        shown = look(powerOfTwo(exponent));
    }
    const double quantum = static_cast<double>(powerOfTwo(exponent));
    const auto samples = static_cast<double>(std::max<std::uint64_t>(shown.samples, 1));
    const double brighter = std::max(shown.invisible, shown.visible) * quantum / samples;
    const double darker = std::min(shown.invisible, shown.visible) * quantum / samples;
    if (!(brighter > 0.0)) return powerOfTwo(exponentOf(brightest) - 30);
    const int mean = exponentOf(darker > 0.0 ? std::max(darker, brighter * kDarkest) : brighter);
    constexpr int kLargest = 58;                                     // the exponent of shared::kFilmLargest
    const int holdsEmission = exponentOf(brightest) + 4 - kLargest;  // in the sum of all six channels
    return powerOfTwo(std::max(mean - 30, std::min(holdsEmission, mean - 20)));
}

}  // namespace duolux

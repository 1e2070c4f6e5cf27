#include "tests/support/statistics.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace duolux::test {

namespace {

/// Continued fraction of the incomplete beta function (Abramowitz & Stegun, 26.5.8) by Lentz's method.
double betaFraction(double a, double b, double x) {
    constexpr double kTiny = 1e-300;
    const auto away = [](double v) { return std::abs(v) < kTiny ? kTiny : v; };
    double c = 1.0;
    double d = 1.0 / away(1.0 - (a + b) * x / (a + 1.0));
    double fraction = d;
    for (int m = 1; m < 10000; ++m) {
        const double even = m * (b - m) * x / ((a + 2 * m - 1.0) * (a + 2 * m));
        d = 1.0 / away(1.0 + even * d);
        c = away(1.0 + even / c);
        fraction *= d * c;
        const double odd = -(a + m) * (a + b + m) * x / ((a + 2 * m) * (a + 2 * m + 1.0));
        d = 1.0 / away(1.0 + odd * d);
        c = away(1.0 + odd / c);
        fraction *= d * c;
        if (std::abs(d * c - 1.0) < 1e-15) break;
    }
    return fraction;
}

/// Regularised incomplete beta function I_x(a, b) (Abramowitz & Stegun, 26.5.1).
double incompleteBeta(double a, double b, double x) {
    if (x <= 0.0) return 0.0;
    if (x >= 1.0) return 1.0;
    const double front =
        std::exp(std::lgamma(a + b) - std::lgamma(a) - std::lgamma(b) + a * std::log(x) + b * std::log1p(-x));
    if (x < (a + 1.0) / (a + b + 2.0)) return front * betaFraction(a, b, x) / a;
    return 1.0 - front * betaFraction(b, a, 1.0 - x) / b;
}

}  // namespace

double studentTwoSided(double t, double degrees) {
    // Far beyond any table the normal distribution is the same to the precision that a level needs.
    if (degrees > 1e6) return std::erfc(std::abs(t) / std::sqrt(2.0));
    return incompleteBeta(0.5 * degrees, 0.5, degrees / (degrees + t * t));
}

double sidakLevel(double alpha, std::size_t tests) {
    return -std::expm1(std::log1p(-alpha) / static_cast<double>(std::max<std::size_t>(tests, 1)));
}

Welch welch(const Mean& a, const Mean& b, double tolerance) {
    const double difference = a.value - b.value;
    const double excess = std::max(0.0, std::abs(difference) - tolerance);
    if (excess == 0.0) return {};
    const double variance = a.variance + b.variance;
    if (!(variance > 0.0)) {
        return {std::copysign(std::numeric_limits<double>::infinity(), difference), 0.0, 1.0};
    }
    const double spread = a.variance * a.variance / a.degrees + b.variance * b.variance / b.degrees;
    const double degrees = variance * variance / spread;
    const double t = excess / std::sqrt(variance);
    return {std::copysign(t, difference), studentTwoSided(t, degrees), degrees};
}

}  // namespace duolux::test

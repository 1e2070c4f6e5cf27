#include "tests/support/statistics.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

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

/// Regularised incomplete gamma function P(a, x) by its series (Abramowitz & Stegun, 6.5.29), for x < a + 1.
double gammaSeries(double a, double x) {
    double term = 1.0 / a;
    double sum = term;
    for (int n = 1; n < 100000 && std::abs(term) > 1e-17 * std::abs(sum); ++n) {
        term *= x / (a + n);
        sum += term;
    }
    return sum * std::exp(a * std::log(x) - x - std::lgamma(a));
}

/// Q(a, x) = 1 - P(a, x) by its continued fraction (Abramowitz & Stegun, 6.5.31), for x >= a + 1.
double gammaFraction(double a, double x) {
    double b = x + 1.0 - a;
    double c = 1e300;
    double d = 1.0 / b;
    double fraction = d;
    for (int n = 1; n < 100000; ++n) {
        const double numerator = -n * (n - a);
        b += 2.0;
        d = 1.0 / (numerator * d + b);
        c = b + numerator / c;
        fraction *= d * c;
        if (std::abs(d * c - 1.0) < 1e-15) break;
    }
    return fraction * std::exp(a * std::log(x) - x - std::lgamma(a));
}

}  // namespace

double chiSquareTail(double x, double degrees) {
    if (x <= 0.0) return 1.0;
    const double a = 0.5 * degrees;
    return 0.5 * x < a + 1.0 ? 1.0 - gammaSeries(a, 0.5 * x) : gammaFraction(a, 0.5 * x);
}

ChiSquare chiSquare(std::span<const double> observed, std::span<const double> expected, double minimum) {
    assert(observed.size() == expected.size());
    std::vector<std::size_t> order(observed.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return expected[a] < expected[b]; });
    struct Bin {
        double observed = 0.0, expected = 0.0;
    };
    std::vector<Bin> bins(1);
    for (const std::size_t i : order) {
        if (!(expected[i] > 0.0) && observed[i] > 0.0) return {INFINITY, 1.0, 0.0};
        if (bins.back().expected >= minimum) bins.emplace_back();
        bins.back().observed += observed[i];
        bins.back().expected += expected[i];
    }
    // The remaining counts at the end may be too small for a separate bin.
    if (bins.size() > 1 && bins.back().expected < minimum) {
        const Bin rest = bins.back();
        bins.pop_back();
        bins.back().observed += rest.observed;
        bins.back().expected += rest.expected;
    }
    ChiSquare result;
    for (const Bin& bin : bins) {
        const double off = bin.observed - bin.expected;
        if (bin.expected > 0.0) result.statistic += off * off / bin.expected;
    }
    result.degrees = static_cast<double>(bins.size()) - 1.0;
    // With a single bin nothing is tested, which must not count as passed.
    result.p = result.degrees > 0.0 ? chiSquareTail(result.statistic, result.degrees) : 0.0;
    return result;
}

double studentTwoSided(double t, double degrees) {
    // For very many degrees of freedom, the normal distribution is accurate enough.
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

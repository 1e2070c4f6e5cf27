#pragma once

#include <cstddef>
#include <span>

namespace duolux::test {

/// Probability that |T| >= |t| for Student's T with `degrees` > 0 degrees of freedom (Abramowitz &
/// Stegun, 26.7.1).
double studentTwoSided(double t, double degrees);

/// Probability that chi-square with `degrees` > 0 degrees of freedom is at least x (Abramowitz & Stegun,
/// 26.4.19).
double chiSquareTail(double x, double degrees);

/// Pearson's test (Phil. Mag. 50, 1900) that counts come from a distribution.
struct ChiSquare {
    double statistic = 0.0;
    double degrees = 0.0;
    double p = 1.0;
};
/// `observed` and `expected`: counts with equal sums up to rounding. Bins are merged, those with the lowest
/// expectations first, until each expects at least `minimum`. p is 0 if a bin with expectation 0 is not
/// empty, or if only one bin remains.
ChiSquare chiSquare(std::span<const double> observed, std::span<const double> expected, double minimum = 5.0);

/// Level of each of `tests` independent tests whose family errs with probability `alpha` (Sidak, JASA 62,
/// 1967).
double sidakLevel(double alpha, std::size_t tests);

/// An unbiased estimate of a mean.
struct Mean {
    double value = 0.0;
    double variance = 0.0;  ///< of the mean
    double degrees = 1.0;   ///< of freedom of that variance
};

/// Welch's test (Biometrika 34, 1947) that two means differ by no more than `tolerance`.
struct Welch {
    double t = 0.0;        ///< signed; beyond the tolerance
    double p = 1.0;        ///< two-sided
    double degrees = 1.0;  ///< of freedom of t (Welch-Satterthwaite)
};
Welch welch(const Mean& a, const Mean& b, double tolerance);

}  // namespace duolux::test

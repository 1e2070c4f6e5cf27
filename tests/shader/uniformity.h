#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/statistics.h"

// Statistical tests for random words.

namespace duolux::test {

/// p-values of tests with the joint error probability `alpha` (Sidak).
class Family {
  public:
    void add(std::string what, double p) { members_.emplace_back(std::move(what), p); }
    void expect(double alpha) const {
        const double level = sidakLevel(alpha, members_.size());
        EXPECT_FALSE(members_.empty());
        for (const auto& [what, p] : members_)
            EXPECT_GE(p, level) << what << ", one of " << members_.size() << " tests";
    }

  private:
    std::vector<std::pair<std::string, double>> members_;
};

/// Tests that all values below `bins` have the same frequency.
inline double evenly(std::span<const std::uint32_t> values, std::size_t bins) {
    std::vector<double> observed(bins);
    for (const std::uint32_t v : values)
        observed.at(v) += 1.0;
    const std::vector<double> expected(bins, static_cast<double>(values.size()) / static_cast<double>(bins));
    return chiSquare(observed, expected).p;
}

/// Tests that pairs (a, b) are distributed evenly over 2^bits x 2^bits squares of the unit square.
inline double evenlyInSquares(std::span<const std::uint32_t> a, std::span<const std::uint32_t> b, int bits) {
    std::vector<std::uint32_t> squares;
    for (std::size_t i = 0; i < a.size(); ++i)
        squares.push_back((a[i] >> (32 - bits)) << bits | b[i] >> (32 - bits));
    return evenly(squares, std::size_t{1} << (2 * bits));
}

/// Correlation of two sequences of words, each taken as uniform in [0, 1).
inline double correlation(std::span<const std::uint32_t> a, std::span<const std::uint32_t> b) {
    double sum = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i)
        sum += (std::ldexp(a[i], -32) - 0.5) * (std::ldexp(b[i], -32) - 0.5) * 12.0;
    return sum / static_cast<double>(a.size());
}

/// Tests that the correlation of n independent pairs is 0; it is approximately normal with deviation 1 /
/// sqrt(n).
inline double uncorrelated(std::span<const std::uint32_t> a, std::span<const std::uint32_t> b) {
    const double deviations = correlation(a, b) * std::sqrt(static_cast<double>(a.size()));
    return std::erfc(std::abs(deviations) / std::sqrt(2.0));
}

}  // namespace duolux::test

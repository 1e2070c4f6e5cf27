#include "tests/shader/harness/census.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace duolux::test {

namespace {

constexpr int kNotFinite = std::numeric_limits<int>::max();

}  // namespace

void Census::add(std::size_t invocation, std::size_t number, double actual, double expected, double allowed) {
    ++compared_;
    const bool same = actual == expected || (std::isnan(actual) && std::isnan(expected));
    const double difference = same ? 0.0 : std::abs(actual - expected);
    double ratio = same ? 0.0 : difference / allowed;
    if (!(ratio >= 0.0)) ratio = std::numeric_limits<double>::infinity();
    const Case here{invocation, number, actual, expected, allowed, ratio};
    if (ratio > worst_.ratio) worst_ = here;
    if (ratio <= 1.0) return;
    if (off_++ == 0) first_ = here;
    if (invocation != lastOff_) ++invocationsOff_;
    lastOff_ = invocation;
    const double size = allowed > 0.0 ? ratio : difference;
    ++octaves_[std::isfinite(size) ? std::ilogb(size) : kNotFinite];
}

void Census::addMismatch(std::size_t invocation) {
    add(invocation, 0, std::numeric_limits<double>::quiet_NaN(), 0.0, 0.0);
    note_ = "; values of different sizes were compared";
}

std::string Census::describe(const Case& c) {
    return fmt::format("invocation {}, number {}: {:.9g}, expected {:.9g}{}", c.invocation, c.number,
                       c.actual, c.expected,
                       c.allowed > 0.0 ? fmt::format(", allowed {:.3g}", c.allowed) : "");
}

Census::~Census() {
    if (off_ == 0 && compared_ > 0) return;
    std::string report = what_ + ": ";
    if (compared_ == 0) report += "nothing was compared";
    if (off_ > 0) {
        report +=
            fmt::format("{} of {} numbers are off, in {} invocations\n  first: {}\n  worst: {}{}\n  off by",
                        off_, compared_, invocationsOff_, describe(first_), describe(worst_), note_);
    }
    for (const auto& [octave, count] : octaves_) {
        const double lower = octave == kNotFinite ? 0.0 : std::ldexp(1.0, octave);
        const std::string range =
            octave == kNotFinite ? "not finite" : fmt::format("{:.4g} to {:.4g}", lower, 2.0 * lower);
        report +=
            fmt::format("\n    {}{}: {}", range, first_.allowed > 0.0 ? " times what is allowed" : "", count);
    }
    ADD_FAILURE_AT(where_.file_name(), static_cast<int>(where_.line())) << report;
}

}  // namespace duolux::test

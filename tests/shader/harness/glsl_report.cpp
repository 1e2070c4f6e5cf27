#include "tests/shader/harness/glsl_report.h"

#include <fmt/format.h>

#include <bit>
#include <cmath>

namespace duolux::test {

namespace {

using shared::Evidence;
using shared::Expectation;

std::string formatComponent(std::uint32_t bits, std::uint32_t type) {
    switch (type) {
        case shared::kValueBool:
            return bits != 0 ? "true" : "false";
        case shared::kValueInt:
            return fmt::format("{}", static_cast<std::int32_t>(bits));
        case shared::kValueUint:
            return fmt::format("{} (0x{:x})", bits, bits);
        default:
            return fmt::format("{:.9g}", std::bit_cast<float>(bits));
    }
}

std::string formatValue(const std::uint32_t (&bits)[4], const Evidence& seen) {
    std::string out;
    for (std::uint32_t i = 0; i < seen.components; ++i)
        out += (i > 0 ? ", " : "") + formatComponent(bits[i], seen.type);
    return seen.components > 1 ? "(" + out + ")" : out;
}

std::string formatEvidence(const Evidence& seen, std::string_view name, std::uint32_t invocation) {
    const std::string allowed = seen.allowed > 0.0f ? fmt::format(" (allowed: {:.4g})", seen.allowed) : "";
    return fmt::format("  {} invocation {}\n    actual:   {}\n    expected: {}\n    off by {:.4g}{}\n", name,
                       invocation, formatValue(seen.actual, seen), formatValue(seen.expected, seen),
                       seen.difference, allowed);
}

std::string formatCensus(const Expectation& e) {
    std::string out = fmt::format("  all {}, off by\n", e.failed);
    for (std::uint32_t bin = 0; bin < shared::kCensusBins; ++bin) {
        if (e.census[bin] == 0) continue;
        const double lower = std::ldexp(1.0, static_cast<int>(bin));
        std::string range = bin == 0 && e.firstSeen.allowed == 0.0f
                                ? "less than 2"
                                : fmt::format("{} to {}", lower, 2.0 * lower);
        if (bin == shared::kCensusOpen) range = fmt::format("{} or more", lower);
        if (e.firstSeen.allowed > 0.0f) range += " times what is allowed";
        if (bin == shared::kCensusNaN) range = "not a number";
        out += fmt::format("    {}: {}\n", range, e.census[bin]);
    }
    return out;
}

}  // namespace

std::vector<GlslFailure> readExpectations(const GlslFile& file, const GlslFile::Test& test,
                                          std::span<const Expectation> expectations,
                                          std::size_t failedInvocations) {
    std::vector<GlslFailure> failures;
    std::size_t evaluated = 0;
    for (std::size_t line = 0; line < expectations.size(); ++line) {
        const Expectation& e = expectations[line];
        evaluated += e.evaluated;
        if (e.failed == 0) continue;
        const GlslFile::Site* site = file.siteAt(line);
        const std::uint32_t first = ~e.first;
        const std::uint32_t worst = ~e.worstAt;
        std::string message =
            fmt::format("{}\n", site != nullptr ? site->text : "an expectation of an included file");
        message += fmt::format("  failed {} of {} times; {} of the test's {} invocations failed something\n",
                               e.failed, e.evaluated, failedInvocations, test.count);
        message += formatEvidence(e.firstSeen, "first:", first);
        if (worst != first) message += formatEvidence(e.worstSeen, "worst:", worst);
        if (e.failed > 1) message += formatCensus(e);
        failures.push_back({site != nullptr ? site->firstLine : line, message});
    }
    for (const GlslFile::Site& site : file.sites) {
        if (site.firstLine < test.line || site.lastLine > test.lastLine) continue;
        bool reached = false;
        for (std::size_t line = site.firstLine; line <= site.lastLine; ++line)
            reached = reached || (line < expectations.size() && expectations[line].evaluated > 0);
        if (!reached)
            failures.push_back({site.firstLine, site.text + "\n  no invocation has reached this\n"});
    }
    if (evaluated == 0) failures.push_back({test.line, "the test has checked nothing\n"});
    return failures;
}

}  // namespace duolux::test

#include "tests/shader/harness/glsl_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "tests/shader/harness/source_text.h"

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

std::string formatValue(const std::uint32_t (&bits)[4], std::uint32_t type, std::uint32_t components) {
    std::string out;
    for (std::uint32_t i = 0; i < components; ++i)
        out += (i > 0 ? ", " : "") + formatComponent(bits[i], type);
    return components > 1 ? "(" + out + ")" : out;
}

/// The name of an expectation's second value, and the unit of differences.
struct Words {
    std::string_view second = "expected", unit;
};

Words wordsFor(std::string_view site, const Evidence& seen) {
    if (site.starts_with("EXPECT_NE(")) return {"other", ""};
    for (const char* order : {"EXPECT_LT", "EXPECT_LE", "EXPECT_GT", "EXPECT_GE"}) {
        if (site.starts_with(order)) return {"bound", ""};
    }
    const bool ulps =
        site.starts_with("EXPECT_ULP") || (site.starts_with("EXPECT_EQ") && seen.type == shared::kValueFloat);
    return {"expected", ulps ? " ulp" : ""};
}

std::string formatEvidence(const Evidence& seen, std::string_view site, std::string_view name,
                           std::uint32_t invocation) {
    const Words words = wordsFor(site, seen);
    std::string out = fmt::format("  {} invocation {}\n    {:<9} {}\n    {:<9} {}\n", name, invocation,
                                  "actual:", formatValue(seen.actual, seen.type, seen.components),
                                  fmt::format("{}:", words.second),
                                  formatValue(seen.expected, seen.type, seen.expectedComponents));
    if (seen.components != seen.expectedComponents) {
        return out +
               fmt::format("    these have {} and {} components\n", seen.components, seen.expectedComponents);
    }
    if (seen.type == shared::kValueBool || words.second == "other") return out;
    out += fmt::format("    off by {:.4g}{}", seen.difference, words.unit);
    const bool tolerant = site.starts_with("EXPECT_NEAR") || site.starts_with("EXPECT_ULP");
    return out + (tolerant ? fmt::format(" (allowed: {:.4g}{})\n", seen.allowed, words.unit) : "\n");
}

std::string formatCensus(const Expectation& e, std::string_view unit) {
    std::string out = fmt::format("  all {}, off by\n", e.failed);
    for (std::uint32_t bin = 0; bin < shared::kCensusBins; ++bin) {
        if (e.census[bin] == 0) continue;
        const double lower = std::ldexp(1.0, static_cast<int>(bin));
        std::string range = bin == 0 && e.firstSeen.allowed == 0.0f
                                ? "less than 2"
                                : fmt::format("{} to {}", lower, 2.0 * lower);
        if (bin == shared::kCensusOpen) range = fmt::format("{} or more", lower);
        range += e.firstSeen.allowed > 0.0f ? " times what is allowed" : unit;
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
        // For a macro, only the line in which it is used is known.
        std::string text = site != nullptr ? site->text : "an expectation of an included file";
        if (site == nullptr && line > 0 && line <= file.source.size())
            text = collapseSpaces(file.source[line - 1]);
        const std::uint32_t first = ~e.first;
        const std::uint32_t worst = ~e.worstAt;
        std::string message =
            fmt::format("{}\n  failed {} of {} times; {} of the test's {} invocations failed something\n",
                        text, e.failed, e.evaluated, failedInvocations, test.count);
        message += formatEvidence(e.firstSeen, text, "first:", first);
        const Words words = wordsFor(text, e.firstSeen);
        const bool measured = e.firstSeen.type != shared::kValueBool && words.second != "other";
        if (worst != first && measured) message += formatEvidence(e.worstSeen, text, "worst:", worst);
        if (e.failed > 1 && measured) message += formatCensus(e, words.unit);
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
    std::stable_sort(failures.begin(), failures.end(),
                     [](const GlslFailure& a, const GlslFailure& b) { return a.line < b.line; });
    return failures;
}

std::string readNotes(const GlslFile& file, std::span<const Expectation> expectations) {
    std::string out;
    for (const GlslFile::Site& note : file.notes) {
        for (std::size_t line = note.firstLine; line <= note.lastLine && line < expectations.size(); ++line) {
            const Evidence& seen = expectations[line].firstSeen;
            if (seen.components == 0) continue;
            const std::string shown = note.text.substr(5, note.text.size() - 6);
            out += fmt::format("    {} = {}\n", shown, formatValue(seen.actual, seen.type, seen.components));
        }
    }
    return out;
}

}  // namespace duolux::test

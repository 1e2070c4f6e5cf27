#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace duolux {

// What the options of several commands have in common. All throw UsageError.

/// "A,B" as two numbers, or nothing.
std::optional<glm::vec2> parsePoint(const std::string& text);

/// "WIDTHxHEIGHT", each from 1 to 16384.
glm::uvec2 parseSize(const std::string& text);

/// "A:B", samples [first, end) with first < end.
struct SampleRange {
    std::uint32_t first, end;
};
SampleRange parseSampleRange(const std::string& text);

/// Checks that an option's text is a number in [lower, upper], which NaN is not.
CLI::Validator between(double lower, double upper);
CLI::Validator wholeNumber(std::uint64_t lower, std::uint64_t upper);

/// Refuses an empty text, such as a script's variable that was never set.
CLI::Validator notEmpty();

/// Adds --strict, which refuses scene files that are not quite right, to a command. `strict` must outlive it.
void addStrictOption(CLI::App& command, bool& strict);

/// The line for an error of the command line's syntax.
std::string describeParseError(const CLI::App& app, const CLI::ParseError& error);

}  // namespace duolux

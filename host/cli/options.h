#pragma once

#include <CLI/CLI.hpp>
#include <charconv>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

namespace duolux {

// Parsers and checks for options of several programs.

/// "A<separator>B" as two numbers; empty if malformed.
template <typename T>
std::optional<std::pair<T, T>> parsePair(const std::string& text, char separator) {
    const std::size_t at = text.find(separator);
    if (at == std::string::npos) return std::nullopt;
    std::pair<T, T> values{};
    const char* middle = text.data() + at;
    const char* end = text.data() + text.size();
    const auto first = std::from_chars(text.data(), middle, values.first);
    const auto second = std::from_chars(middle + 1, end, values.second);
    if (first.ec != std::errc() || first.ptr != middle || second.ec != std::errc() || second.ptr != end) {
        return std::nullopt;
    }
    return values;
}

/// "WIDTHxHEIGHT", each from 1 to 16384. Throws UsageError, which names --size.
glm::uvec2 parseSize(const std::string& text);

/// Checks that an option's text is a number in [lower, upper]; rejects NaN.
CLI::Validator between(double lower, double upper);
CLI::Validator wholeNumber(std::uint64_t lower, std::uint64_t upper);

/// Rejects an empty text, for example from an unset variable in a script, and the name of another option.
CLI::Validator notEmpty();

/// Accepts only these names; suggests the most similar one.
CLI::Validator oneOf(std::vector<std::string> names);

/// Adds an option that may be given several times, with one value each time.
CLI::Option* addRepeatable(CLI::App& command, const std::string& name, std::vector<std::string>& values,
                           const std::string& description);

}  // namespace duolux

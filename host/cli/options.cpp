#include "host/cli/options.h"

#include <fmt/format.h>

#include <algorithm>

#include "host/base/error.h"
#include "host/base/nearest_name.h"
#include "host/base/printable.h"

namespace duolux {

glm::uvec2 parseSize(const std::string& text) {
    const auto values = parsePair<std::uint32_t>(text, 'x');
    if (!values || values->first < 1 || values->second < 1 || values->first > 16384 ||
        values->second > 16384) {
        throw UsageError(
            fmt::format("--size {}: expected WIDTHxHEIGHT, each from 1 to 16384, for example 640x480", text));
    }
    return {values->first, values->second};
}

CLI::Validator between(double lower, double upper) {
    const std::string range = fmt::format("from {:g} to {:g}", lower, upper);
    return CLI::Validator(
        [=](std::string& text) {
            double value = 0.0;
            const bool fine = CLI::detail::lexical_cast(text, value) && value >= lower && value <= upper;
            return fine ? std::string() : fmt::format("expected a number {}, not {}", range, text);
        },
        range);
}

CLI::Validator wholeNumber(std::uint64_t lower, std::uint64_t upper) {
    const std::string range = fmt::format("from {} to {}", lower, upper);
    return CLI::Validator(
        [=](std::string& text) {
            std::uint64_t value = 0;
            const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
            const bool fine =
                error == std::errc() && end == text.data() + text.size() && value >= lower && value <= upper;
            return fine ? std::string() : fmt::format("expected a whole number {}, not {}", range, text);
        },
        range);
}

CLI::Validator notEmpty() {
    return CLI::Validator(
        [](std::string& text) {
            if (text.empty()) return std::string("expected a value, not an empty text");
            return text.starts_with("--") ? fmt::format("expected a value, not {}", text) : std::string();
        },
        "");
}

CLI::Validator oneOf(std::vector<std::string> names) {
    const std::string list = fmt::format("{{{}}}", fmt::join(names, ","));
    return CLI::Validator(
        [names = std::move(names)](std::string& text) {
            const bool known = std::find(names.begin(), names.end(), text) != names.end();
            return known ? std::string() : fmt::format("is {}; {}", inQuotes(text), suggestName(text, names));
        },
        list);
}

CLI::Option* addRepeatable(CLI::App& command, const std::string& name, std::vector<std::string>& values,
                           const std::string& description) {
    return command.add_option(name, values, description)->expected(1)->allow_extra_args(false)->take_all();
}

}  // namespace duolux

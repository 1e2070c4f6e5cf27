#include "host/app/options.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <string_view>
#include <utility>

#include "host/base/error.h"
#include "host/base/nearest_name.h"
#include "host/base/printable.h"

namespace duolux {

namespace {

/// "A<separator>B" as two numbers.
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

std::string_view withoutComma(std::string_view word) {
    return word.ends_with(',') ? word.substr(0, word.size() - 1) : word;
}

bool isNumber(std::string_view word) {
    double number = 0.0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
    return error == std::errc() && end == word.data() + word.size();
}

/// What an option expects, in the words of --help: "N, from 1 to 16777216".
std::string expectationOf(const CLI::Option& option) {
    std::string type = option.get_type_name();
    const std::size_t colon = type.find(':');
    if (colon != std::string::npos) type.replace(colon, 1, type[colon + 1] == '{' ? ", one of " : ", ");
    return type;
}

}  // namespace

std::optional<glm::vec2> parsePoint(const std::string& text) {
    const auto values = parsePair<float>(text, ',');
    if (!values) return std::nullopt;
    return glm::vec2(values->first, values->second);
}

glm::uvec2 parseSize(const std::string& text) {
    const auto values = parsePair<std::uint32_t>(text, 'x');
    if (!values || values->first < 1 || values->second < 1 || values->first > 16384 ||
        values->second > 16384) {
        throw UsageError(
            fmt::format("--size {}: expected WIDTHxHEIGHT, each from 1 to 16384, for example 640x480", text));
    }
    return {values->first, values->second};
}

FilmLayerSet parseLayers(const std::string& text) {
    FilmLayerSet layers = 0;
    std::size_t begin = 0;
    while (begin <= text.size()) {
        const std::size_t end = std::min(text.find(',', begin), text.size());
        const std::string name = text.substr(begin, end - begin);
        const auto layer = layerNamed(name);
        if (!layer) {
            throw UsageError(fmt::format("--aov {}: there is no layer {}; {}", text, inQuotes(name),
                                         suggestName(name, namesOf(~FilmLayerSet{0}))));
        }
        layers |= *layer;
        begin = end + 1;
    }
    return layers;
}

SampleRange parseSampleRange(const std::string& text) {
    const auto values = parsePair<std::uint32_t>(text, ':');
    if (!values || values->first >= values->second) {
        throw UsageError(fmt::format(
            "--sample-range {}: expected A:B, two whole numbers with A < B, for example 0:32", text));
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

std::vector<std::string> argumentsOf(int argc, const char* const* argv) {
    constexpr std::array<std::string_view, 3> kVectors{"--camera-position", "--look-at", "--up"};
    std::vector<std::string> arguments;
    for (int i = 1; i < argc; ++i) {
        arguments.emplace_back(argv[i]);
        if (std::find(kVectors.begin(), kVectors.end(), arguments.back()) == kVectors.end() || i + 3 >= argc)
            continue;
        const auto x = withoutComma(argv[i + 1]), y = withoutComma(argv[i + 2]),
                   z = withoutComma(argv[i + 3]);
        if (!isNumber(x) || !isNumber(y) || !isNumber(z)) continue;
        arguments.push_back(fmt::format("{},{},{}", x, y, z));
        i += 3;
    }
    return arguments;
}

void addStrictOption(CLI::App& command, bool& strict) {
    command.add_flag(
        "--strict", strict,
        "Refuse scene files with errors that are otherwise warnings: invalid numbers, normals, corners and "
        "faces of meshes, colours that are not three numbers >= 0, missing or unreadable MTL files, "
        "materials undefined or defined twice");
}

std::string describeParseError(const CLI::App& app, const CLI::ParseError& error) {
    const std::vector<const CLI::App*> parsed =
        app.get_subcommands(static_cast<const std::function<bool(const CLI::App*)>&>(
            [](const CLI::App* a) { return a->parsed() > 0; }));
    const CLI::App& command = parsed.empty() ? app : *parsed.front();
    const std::string help =
        fmt::format("(see '{}{} --help')", app.get_name(), parsed.empty() ? "" : " " + command.get_name());
    if (dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr) {
        std::vector<std::string> known;
        for (const CLI::Option* option : command.get_options()) {
            for (const std::string& name : option->get_lnames())
                known.push_back("--" + name);
        }
        for (const std::string& word : app.remaining(true)) {
            if (word.starts_with("--") && word != "--")
                return fmt::format("{}: unknown option; {} {}", word, suggestName(word, known), help);
        }
        if (!command.get_allow_extras()) {
            std::vector<std::string> words = app.remaining(true);
            std::reverse(words.begin(), words.end());  // as the error lists them
            return fmt::format("{} {}", CLI::ExtrasError(command.get_name(), words).what(), help);
        }
    }
    if (dynamic_cast<const CLI::ArgumentMismatch*>(&error) != nullptr) {
        const std::string what = error.what(), name = what.substr(0, what.find(':'));
        if (const CLI::Option* const option = command.get_option_no_throw(name)) {
            return fmt::format("{}: its value is missing; expected {} {}", name, expectationOf(*option),
                               help);
        }
    }
    return fmt::format("{} {}", error.what(), help);
}

}  // namespace duolux

#include "host/app/options.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <string_view>

#include "host/base/error.h"
#include "host/base/nearest_name.h"
#include "host/base/printable.h"
#include "host/cli/options.h"

namespace duolux {

namespace {

std::string_view withoutComma(std::string_view word) {
    return word.ends_with(',') ? word.substr(0, word.size() - 1) : word;
}

bool isNumber(std::string_view word) {
    double number = 0.0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
    return error == std::errc() && end == word.data() + word.size();
}

}  // namespace

std::optional<glm::vec2> parsePoint(const std::string& text) {
    const auto values = parsePair<float>(text, ',');
    if (!values) return std::nullopt;
    return glm::vec2(values->first, values->second);
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
    command.add_flag("--strict", strict,
                     "Refuse scene files with errors that otherwise only cause warnings: invalid numbers, "
                     "normals, corners, faces and counts in meshes; invalid values in MTL files; missing "
                     "or unreadable MTL files and images; materials that are undefined or defined twice");
}

}  // namespace duolux

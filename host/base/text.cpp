#include "host/base/text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace duolux {

std::string lowerCase(std::string_view text) {
    std::string result(text);
    std::ranges::transform(result, result.begin(), [](char c) {
        return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    });
    return result;
}

std::string alternatives(std::span<const std::string_view> texts) {
    if (texts.size() < 2) return texts.empty() ? std::string() : std::string(texts.front());
    return fmt::format("{} or {}", fmt::join(texts.first(texts.size() - 1), ", "), texts.back());
}

}  // namespace duolux

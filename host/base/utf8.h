#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace duolux {

struct Utf8Character {
    char32_t value;
    std::size_t bytes;
};

/// The first character of non-empty text, or nothing if its first byte starts no well-formed one.
std::optional<Utf8Character> firstUtf8(std::string_view text);

/// The characters of UTF-8 text; U+FFFD for every byte that is no part of a well-formed one.
std::u32string decodeUtf8(std::string_view text);

}  // namespace duolux

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

/// Whether a byte of UTF-8 text is in a character, but not its first byte.
constexpr bool continuesUtf8(char byte) {
    return (static_cast<unsigned char>(byte) & 0xC0u) == 0x80u;
}

/// The first character of non-empty text; empty if the text does not start with a well-formed character.
std::optional<Utf8Character> firstUtf8(std::string_view text);

/// The characters of UTF-8 text, with U+FFFD for every byte that is not part of a well-formed character.
std::u32string decodeUtf8(std::string_view text);

}  // namespace duolux

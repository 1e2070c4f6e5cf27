#include "host/film/utf8.h"

#include <bit>

namespace duolux {

namespace {

struct Decoded {
    char32_t character;
    std::size_t bytes;
};

/// The first character of non-empty text.
Decoded decodeFirst(std::string_view text) {
    constexpr Decoded kBad{U'\uFFFD', 1};
    const auto lead = static_cast<unsigned char>(text[0]);
    if (lead < 0x80) return {lead, 1};
    const auto count = static_cast<std::size_t>(std::countl_one(lead));
    if (count < 2 || count > 4 || count > text.size()) return kBad;
    char32_t character = lead & (0x7Fu >> count);
    for (std::size_t i = 1; i < count; ++i) {
        const auto byte = static_cast<unsigned char>(text[i]);
        if ((byte & 0xC0u) != 0x80u) return kBad;
        character = character << 6 | (byte & 0x3Fu);
    }
    constexpr char32_t kSmallest[] = {0, 0, 0x80, 0x800, 0x10000};  // shorter forms exist below these
    const bool surrogate = character >= 0xD800 && character <= 0xDFFF;
    if (character < kSmallest[count] || character > 0x10FFFF || surrogate) return kBad;
    return {character, count};
}

}  // namespace

std::u32string decodeUtf8(std::string_view text) {
    std::u32string characters;
    while (!text.empty()) {
        const Decoded first = decodeFirst(text);
        characters += first.character;
        text.remove_prefix(first.bytes);
    }
    return characters;
}

}  // namespace duolux

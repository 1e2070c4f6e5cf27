#include "host/base/utf8.h"

#include <bit>

namespace duolux {

std::optional<Utf8Character> firstUtf8(std::string_view text) {
    const auto lead = static_cast<unsigned char>(text[0]);
    if (lead < 0x80) return Utf8Character{lead, 1};
    const auto count = static_cast<std::size_t>(std::countl_one(lead));
    if (count < 2 || count > 4 || count > text.size()) return std::nullopt;
    char32_t character = lead & (0x7Fu >> count);
    for (std::size_t i = 1; i < count; ++i) {
        if (!continuesUtf8(text[i])) return std::nullopt;
        character = character << 6 | (static_cast<unsigned char>(text[i]) & 0x3Fu);
    }
    constexpr char32_t kSmallest[] = {0, 0, 0x80, 0x800,
                                      0x10000};  // smaller characters have shorter encodings
    const bool surrogate = character >= 0xD800 && character <= 0xDFFF;
    if (character < kSmallest[count] || character > 0x10FFFF || surrogate) return std::nullopt;
    return Utf8Character{character, count};
}

std::u32string decodeUtf8(std::string_view text) {
    std::u32string characters;
    while (!text.empty()) {
        const Utf8Character first = firstUtf8(text).value_or(Utf8Character{U'\uFFFD', 1});
        characters += first.value;
        text.remove_prefix(first.bytes);
    }
    return characters;
}

}  // namespace duolux

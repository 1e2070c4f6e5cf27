#include "host/base/printable.h"

#include <fmt/format.h>

#include <iterator>
#include <limits>

#include "host/base/utf8.h"

namespace duolux {

bool isControl(char32_t c) {
    return c < 0x20 || (c >= 0x7f && c < 0xa0) || c == 0x200e || c == 0x200f ||
           (c >= 0x2028 && c <= 0x202e) || (c >= 0x2066 && c <= 0x2069) || c == 0xfeff;
}

std::string shortened(std::string_view text, std::size_t most) {
    std::string result;
    for (std::size_t count = 0; !text.empty(); ++count) {
        if (count == most) return result + "...";
        const auto first = firstUtf8(text);
        const std::size_t bytes = first ? first->bytes : 1;
        if (first && !isControl(first->value)) {
            result += text.substr(0, bytes);
        } else {
            for (const char byte : text.substr(0, bytes)) {
                fmt::format_to(std::back_inserter(result), "\\x{:02x}", static_cast<unsigned char>(byte));
            }
        }
        text.remove_prefix(bytes);
    }
    return result;
}

std::string printable(std::string_view text) {
    return shortened(text, std::numeric_limits<std::size_t>::max());
}

std::string inQuotes(std::string_view text) {
    return '"' + shortened(text) + '"';
}

std::string withoutMiddle(std::string text, std::size_t mostBytes) {
    if (text.size() <= mostBytes) return text;
    constexpr std::string_view kLeftOut = " ... ";
    const std::size_t kept = mostBytes - kLeftOut.size();
    std::size_t begin = kept - kept / 3, end = text.size() - kept / 3;
    const auto isInCharacter = [&](std::size_t at) { return at < text.size() && continuesUtf8(text[at]); };
    while (isInCharacter(begin))
        --begin;
    while (isInCharacter(end))
        ++end;
    return text.replace(begin, end - begin, kLeftOut);
}

std::string asMessage(std::string_view text) {
    return withoutMiddle(printable(text), kLongestMessage);
}

}  // namespace duolux

#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace duolux {

/// Whether a terminal may act on a character instead of showing it: C0 and C1 controls, line and paragraph
/// separators, and bidirectional control characters.
bool isControl(char32_t c);

/// The text in a form that is safe for a terminal: control characters (including Unicode's bidirectional
/// ones) and bytes that are not UTF-8 become visible escapes such as \x1b. Idempotent.
std::string printable(std::string_view text);

/// Names longer than this are shortened in messages and tables.
inline constexpr std::size_t kLongestName = 40;

/// Messages are shortened to this many bytes, enough for several paths.
inline constexpr std::size_t kLongestMessage = 1000;

/// The first `most` characters, followed by "..." if there are more; printable.
std::string shortened(std::string_view text, std::size_t most = kLongestName);

/// The text in double quotes for a message: shortened and printable.
std::string inQuotes(std::string_view text);

/// Shortens UTF-8 text to at most `mostBytes`: longer text keeps its beginning and its end.
std::string withoutMiddle(std::string text, std::size_t mostBytes);

/// The text as a message: printable, and not longer than kLongestMessage.
std::string asMessage(std::string_view text);

}  // namespace duolux

#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace duolux {

/// The text as a terminal may show it: control characters (also those of Unicode that turn the direction of
/// writing) and bytes that are not UTF-8 become visible escapes such as \x1b. Doing it twice changes nothing.
std::string printable(std::string_view text);

/// Names longer than this are shortened in messages and tables.
inline constexpr std::size_t kLongestName = 40;

/// A message is cut to this many bytes: room for some paths.
inline constexpr std::size_t kLongestMessage = 1000;

/// The first `most` characters, followed by "..." if there are more; printable.
std::string shortened(std::string_view text, std::size_t most = kLongestName);

/// The text in double quotes for a message: shortened and printable.
std::string inQuotes(std::string_view text);

/// UTF-8 text of at most `mostBytes`: longer text keeps its beginning and its end.
std::string withoutMiddle(std::string text, std::size_t mostBytes);

/// A message as it may be shown: printable, and not longer than kLongestMessage.
std::string asMessage(std::string_view text);

}  // namespace duolux

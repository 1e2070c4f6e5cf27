#pragma once

#include <string>
#include <string_view>

namespace duolux {

/// The characters of UTF-8 text; U+FFFD for every byte that is no part of a well-formed one.
std::u32string decodeUtf8(std::string_view text);

}  // namespace duolux

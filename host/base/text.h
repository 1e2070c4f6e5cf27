#pragma once

#include <span>
#include <string>
#include <string_view>

namespace duolux {

/// The text with ASCII letters in lower case.
std::string lowerCase(std::string_view text);

/// The texts as a choice: "a, b or c".
std::string alternatives(std::span<const std::string_view> texts);

}  // namespace duolux

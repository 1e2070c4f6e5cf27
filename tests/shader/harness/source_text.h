#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace duolux::test {

/// Replaces every character of a comment by a space, so that offsets and lines do not change.
std::string blankComments(std::string_view glsl);

/// Offset of the bracket that closes the one at `open`, one of ( [ {; npos if there is none. Comments must
/// have been blanked.
std::size_t closingBracket(std::string_view glsl, std::size_t open);

/// Line of an offset, from 1.
std::size_t lineAt(std::string_view text, std::size_t offset);

/// Replaces runs of white space by single spaces, and removes white space at the ends.
std::string collapseSpaces(std::string_view text);

/// Whether a character can be part of an identifier or a number.
bool isWordCharacter(char c);

/// "reflectance_matrix" -> "ReflectanceMatrix".
std::string pascalCase(std::string_view snake);

}  // namespace duolux::test

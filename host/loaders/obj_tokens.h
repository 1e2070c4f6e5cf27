#pragma once

#include <array>
#include <glm/glm.hpp>
#include <string_view>

#include "host/loaders/source_text.h"

namespace duolux {

// The words of OBJ statements. The text ends with '\n', which terminates every scan.

/// The word that begins at this position.
std::string_view tokenAt(const char* at);

/// The next argument; null at the end of the line or at a comment.
inline const char* nextArgument(const char* at) {
    while (isBlank(*at))
        ++at;
    return isLineEnd(*at) || *at == '#' ? nullptr : at;
}

/// The text without blanks at both ends.
std::string_view restOfLine(const char* at);

/// The numbers of a statement. Errors after the third number are tolerated.
struct ObjNumbers {
    glm::dvec4 values{0.0};           ///< the first ones
    std::array<double, 3> more{};     ///< the fifth to the seventh
    int count = 0;                    ///< numbers before the first word that is not a number
    const char* notNumber = nullptr;  ///< the first word of the first three that is not a number
    const char* notFinite = nullptr;  ///< the first number of the first three that is not finite
    const char* oddExtra = nullptr;   ///< the first later word that is not a finite number

    /// The first invalid word of the first three, or null.
    const char* wrong() const { return notNumber != nullptr ? notNumber : notFinite; }
};
ObjNumbers readObjNumbers(const char* arguments, const char* end);

}  // namespace duolux

#pragma once

#include <glm/glm.hpp>
#include <string_view>

namespace duolux {

// The words of OBJ statements. Text ends with '\n', which stops every scan.

inline bool isBlank(char c) {
    return c == ' ' || c == '\t';
}
inline bool isLineEnd(char c) {
    return c == '\n' || c == '\r';
}

/// The word that begins there.
std::string_view tokenAt(const char* at);

/// At the next argument, or null at the end of the line or at a comment.
inline const char* nextArgument(const char* at) {
    while (isBlank(*at))
        ++at;
    return isLineEnd(*at) || *at == '#' ? nullptr : at;
}

/// Without blanks at both ends.
std::string_view restOfLine(const char* at);

/// The numbers of a statement. What comes behind the third does not matter as much.
struct ObjNumbers {
    glm::dvec4 values{0.0};           ///< the first ones
    int count = 0;                    ///< up to the first word that is no number
    const char* notNumber = nullptr;  ///< the first word of the first three that is no number
    const char* notFinite = nullptr;  ///< the first number of the first three that is not finite
    const char* oddExtra = nullptr;   ///< the first word behind that is no finite number

    /// What is wrong with the first three, or null.
    const char* wrong() const { return notNumber != nullptr ? notNumber : notFinite; }
};
ObjNumbers readObjNumbers(const char* arguments, const char* end);

}  // namespace duolux

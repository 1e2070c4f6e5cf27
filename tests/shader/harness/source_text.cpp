#include "tests/shader/harness/source_text.h"

#include <algorithm>
#include <cctype>

namespace duolux::test {

std::string blankComments(std::string_view glsl) {
    std::string out(glsl);
    for (std::size_t i = 0; i + 1 < out.size(); ++i) {
        if (out[i] != '/' || (out[i + 1] != '/' && out[i + 1] != '*')) continue;
        const bool line = out[i + 1] == '/';
        std::size_t end = glsl.find(line ? "\n" : "*/", i + 2);
        if (end == std::string_view::npos) end = out.size();
        if (!line) end = std::min(end + 2, out.size());
        for (; i < end; ++i) {
            if (out[i] != '\n') out[i] = ' ';
        }
        --i;
    }
    return out;
}

std::size_t closingBracket(std::string_view glsl, std::size_t open) {
    int depth = 0;
    for (std::size_t i = open; i < glsl.size(); ++i) {
        const char c = glsl[i];
        if (c == '(' || c == '[' || c == '{') ++depth;
        if ((c == ')' || c == ']' || c == '}') && --depth == 0) return i;
    }
    return std::string_view::npos;
}

std::size_t lineAt(std::string_view text, std::size_t offset) {
    return 1 + static_cast<std::size_t>(
                   std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(offset), '\n'));
}

std::string collapseSpaces(std::string_view text) {
    std::string out;
    for (const char c : text) {
        if (std::isspace(static_cast<unsigned char>(c)) == 0) {
            out += c;
        } else if (!out.empty() && out.back() != ' ') {
            out += ' ';
        }
    }
    if (!out.empty() && out.back() == ' ') out.pop_back();
    return out;
}

bool isWordCharacter(char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
}

std::string pascalCase(std::string_view snake) {
    std::string out;
    bool up = true;
    for (const char c : snake) {
        if (c != '_') out += up ? static_cast<char>(std::toupper(static_cast<unsigned char>(c))) : c;
        up = c == '_';
    }
    return out;
}

}  // namespace duolux::test

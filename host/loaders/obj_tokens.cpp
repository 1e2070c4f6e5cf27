#include "host/loaders/obj_tokens.h"

#include <cmath>
#include <cstddef>

#include "host/loaders/source_text.h"

namespace duolux {

std::string_view tokenAt(const char* at) {
    const char* end = at;
    while (!isBlank(*end) && !isLineEnd(*end))
        ++end;
    return {at, static_cast<std::size_t>(end - at)};
}

std::string_view restOfLine(const char* at) {
    const char* end = at;
    while (*end != '\n')
        ++end;
    return trimmed({at, static_cast<std::size_t>(end - at)});
}

ObjNumbers readObjNumbers(const char* arguments, const char* end) {
    ObjNumbers numbers;
    const auto note = [&](const char*& firstOfThree, const char* at) {
        const char*& first = numbers.count < 3 ? firstOfThree : numbers.oddExtra;
        if (first == nullptr) first = at;
    };
    for (const char* at = arguments; (at = nextArgument(at)) != nullptr;) {
        const auto [past, value] = readNumber(at, end);
        if (past == nullptr || !(isBlank(*past) || isLineEnd(*past) || *past == '#')) {
            note(numbers.notNumber, at);
            return numbers;
        }
        if (!std::isfinite(value)) note(numbers.notFinite, at);
        if (numbers.count < 4) {
            numbers.values[numbers.count] = value;
        } else if (numbers.count < 7) {
            numbers.more[static_cast<std::size_t>(numbers.count - 4)] = value;
        }
        ++numbers.count;
        at = past;
    }
    return numbers;
}

}  // namespace duolux

#include "host/base/error.h"

#include <fmt/format.h>

namespace duolux {

namespace {

std::string inputErrorLine(std::string_view file, std::string_view place, std::string_view problem,
                           std::string_view remedy) {
    std::string line(file);
    if (!place.empty()) line += fmt::format(": {}", place);
    line += fmt::format(": {}", problem);
    if (!remedy.empty()) line += fmt::format("; {}", remedy);
    // One line, whatever the input file put into a name.
    for (char& c : line) {
        if (c == '\n' || c == '\r') c = ' ';
    }
    return line;
}

}  // namespace

InputError::InputError(std::string_view file, std::string_view place, std::string_view problem,
                       std::string_view remedy)
    : Error(ExitStatus::kBadInput, inputErrorLine(file, place, problem, remedy)) {}

}  // namespace duolux

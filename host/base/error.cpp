#include "host/base/error.h"

#include <fmt/format.h>

#include <cstddef>

#include "host/base/printable.h"

namespace duolux {

namespace {

std::string inputErrorLine(std::string_view file, std::string_view place, std::string_view problem,
                           std::string_view remedy) {
    // The line stays short even if a name in the input file is long.
    constexpr std::size_t kLongest = 300;
    std::string line = printable(file);
    if (!place.empty()) line += fmt::format(": {}", shortened(place, kLongest));
    line += fmt::format(": {}", shortened(problem, kLongest));
    if (!remedy.empty()) line += fmt::format("; {}", shortened(remedy, 2 * kLongest));
    return line;
}

}  // namespace

InputError::InputError(std::string_view file, std::string_view place, std::string_view problem,
                       std::string_view remedy)
    : Error(inputErrorLine(file, place, problem, remedy)) {}

}  // namespace duolux

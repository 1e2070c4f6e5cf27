#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace duolux {

/// JSON as a program prints or writes it: indented, with a newline at the end. Control characters on which a
/// terminal may act are escaped. Bytes that are not UTF-8, for example in the name of a file, are replaced.
std::string jsonText(const nlohmann::ordered_json& json);

}  // namespace duolux

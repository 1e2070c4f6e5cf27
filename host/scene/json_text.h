#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>

namespace duolux {

/// Parses a JSON file. Throws InputError: for a syntax error with line and column, for a key that an object
/// holds twice (which JSON libraries let pass) with its path.
nlohmann::json parseJsonFile(const std::filesystem::path& path);

}  // namespace duolux

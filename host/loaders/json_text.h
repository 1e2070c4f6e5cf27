#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>

namespace duolux {

/// Parses a JSON file. Throws InputError with line and column for a syntax error, and with the path for a
/// duplicate key (which JSON libraries accept).
nlohmann::json parseJsonFile(const std::filesystem::path& path);

}  // namespace duolux

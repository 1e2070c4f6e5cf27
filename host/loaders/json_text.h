#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string_view>

namespace duolux {

/// Parses a JSON file. Throws InputError with line and column for a syntax error, and with the path for a
/// duplicate key (which JSON libraries accept).
nlohmann::json parseJsonFile(const std::filesystem::path& path);

/// The same for a text of the file at `path`, which should be `expected` (see expectNoForeignFormat).
nlohmann::json parseJson(const std::filesystem::path& path, std::string_view text, std::string_view expected);

}  // namespace duolux

#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace duolux {

/// Runs a program with the arguments and `--report`, and returns the report; trees are built, not taken from
/// the cache, so that its seconds are those of a scene that is new to it. Throws MachineError if it fails;
/// what it said on standard error is left there.
nlohmann::json runProgram(const std::filesystem::path& program, std::vector<std::string> arguments,
                          const std::filesystem::path& report);

}  // namespace duolux

#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace duolux {

/// Runs a program with the arguments and `--report`, and returns the report. Throws MachineError if the
/// program fails; its messages remain on standard error.
nlohmann::json runProgram(const std::filesystem::path& program, std::vector<std::string> arguments,
                          const std::filesystem::path& report);

}  // namespace duolux

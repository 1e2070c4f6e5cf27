#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace duolux::test {

struct ProgramResult {
    int status = 0;  ///< exit status; 128 + signal if a signal ended it
    std::string out, err;
};

struct ProgramSignal {
    int signal;
    std::chrono::milliseconds after;  ///< since the start
};

/// Runs a program (a path) with arguments in `folder` and waits for it, optionally sending it a signal.
/// SIGALRM ends a program that takes longer than `limit`.
ProgramResult runProgram(const std::string& program, const std::filesystem::path& folder,
                         std::vector<std::string> arguments,
                         std::optional<ProgramSignal> signal = std::nullopt,
                         std::chrono::seconds limit = std::chrono::seconds(120),
                         const std::vector<std::string>& environment = {});

/// The whole file; empty if it cannot be read.
std::string contentsOf(const std::filesystem::path& file);

}  // namespace duolux::test

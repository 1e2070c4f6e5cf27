#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "host/cli/temporary_folder.h"
#include "tests/support/run_program.h"

namespace duolux::test {

/// Runs duolux with arguments in `folder` and waits for it, optionally sending it a signal.
inline ProgramResult runDuolux(const std::filesystem::path& folder, std::vector<std::string> arguments,
                               std::optional<ProgramSignal> signal = std::nullopt) {
    return runProgram(DUOLUX_EXECUTABLE, folder, std::move(arguments), signal);
}

}  // namespace duolux::test

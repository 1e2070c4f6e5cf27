#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "host/device_scene/tuning.h"

namespace duolux {

/// The values of --layout and --kernel; empty if not given.
struct TuningOptions {
    std::string layout, kernel;

    TuningChoice choice() const;
};

/// Adds both options to a command that traces rays. `options` must outlive the command.
void addTuningOptions(CLI::App& command, TuningOptions& options);

}  // namespace duolux

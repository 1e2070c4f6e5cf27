#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "host/gpu/tuning.h"

namespace duolux {

/// What --layout and --kernel say; empty: nothing.
struct TuningOptions {
    std::string layout, kernel;

    TuningChoice choice() const;
};

/// Adds both to a command that traces rays. `options` must outlive it.
void addTuningOptions(CLI::App& command, TuningOptions& options);

}  // namespace duolux

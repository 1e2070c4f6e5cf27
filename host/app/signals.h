#pragma once

#include <optional>

#include "host/cli/exit_status.h"

namespace duolux {

// Signals that request a clean stop once work could be lost: SIGINT (Ctrl-C), SIGHUP (the terminal is closed;
// ignored if it was ignored when the program started, as under nohup), SIGTERM, and SIGXCPU (the limit on CPU
// time). They interrupt blocking calls, for example one that waits for a pipe's reader.

/// Must be called at the start of the program: each of these signals ends it at once with its exit status.
/// Writes to a pipe without a reader (SIGPIPE) or beyond the limit on file size (SIGXFSZ) fail with an error.
void handleSignals();

/// From now on, the first of these signals requests a clean stop, and the next one ends the program at once.
void deferSignals();

/// The exit status for the signal that requested a stop; empty if there was none.
std::optional<ExitStatus> stopStatus();

}  // namespace duolux

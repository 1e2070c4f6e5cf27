#pragma once

#include <optional>

#include "host/base/error.h"

namespace duolux {

// Signals that end a program, once it has something to lose, ask for a clean stop: SIGINT (Ctrl-C), SIGHUP
// (the terminal went away; ignored if it was when the program started, as under nohup), SIGTERM, and SIGXCPU
// (the limit of CPU time). Calls that wait, such as for a pipe's reader, are interrupted by them.

/// From the start of the program: each of these signals ends it at once with its exit status. What cannot be
/// written because nobody reads it (SIGPIPE), or a file would become too large (SIGXFSZ), fails with an
/// error.
void handleSignals();

/// From now on the first of these signals asks for a clean stop, and the next ends the program at once.
void deferSignals();

/// The exit status for the signal that asked for a stop, if one did.
std::optional<ExitStatus> stopStatus();

}  // namespace duolux

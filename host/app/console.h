#pragma once

#include <string_view>

namespace duolux {

// What a program says to its user beside its results. A line that cannot be written, because standard error
// is closed, full or a terminal that went away, is no reason to stop.

/// First thing in a program: what is opened later must not take the place of a standard stream that is
/// closed. Writing to one that is closed still fails.
void openStandardStreams();

/// One line on standard error, made printable and of bounded length, after what standard output holds.
void say(std::string_view line);

/// say() with "duolux: warning: ".
void warn(std::string_view text);

/// Writes a result, and what was printed before, to standard output. Throws MachineError if that fails, or
/// has failed before.
void printResult(std::string_view text = {});

}  // namespace duolux

#pragma once

#include <string_view>

namespace duolux {

// Messages to the user on standard error, and results on standard output. A message that cannot be written,
// because standard error is closed, full or a disconnected terminal, is dropped.

/// Must be called first in a program: prevents files that are opened later from taking the number of a closed
/// standard stream. Writing to a closed stream still fails.
void openStandardStreams();

/// Writes one line, printable and of bounded length, to standard error, after flushing standard output.
void say(std::string_view line);

/// say() with "duolux: warning: ".
void warn(std::string_view text);

/// Writes a result to standard output and flushes it. Throws MachineError if this or an earlier write failed.
void printResult(std::string_view text = {});

/// The same for text that a reader may stop reading (`--help | head`), which is not an error.
void printHelp(std::string_view text);

}  // namespace duolux

#pragma once

#include <string>
#include <vector>

namespace duolux {

/// Runs a program (a path, or a name to be found in PATH) with arguments, and waits for it. It inherits the
/// standard streams. `environment`: NAME=VALUE entries that override this program's environment. Returns the
/// exit status, 127 if there is no such program, or 128 + the signal that ended it. Throws MachineError if no
/// process can be started.
int runProcess(const std::string& program, std::vector<std::string> arguments,
               std::vector<std::string> environment = {});

}  // namespace duolux

#pragma once

#include <string>
#include <vector>

namespace duolux {

/// Runs a program (a path, or a name to be looked for) with arguments, and waits for it; what it reads and
/// writes is this program's. `environment`: NAME=VALUE in place of what this program has. Returns its exit
/// status, 127 if there is no such program, or 128 + the signal that ended it. Throws MachineError if no
/// process can be made.
int runProcess(const std::string& program, std::vector<std::string> arguments,
               std::vector<std::string> environment = {});

}  // namespace duolux

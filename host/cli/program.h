#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace duolux {

// What the main() of every program does.

/// Adds --version to a program and sets the layout of its --help.
void setUpProgram(CLI::App& app);

/// Parses the arguments of a program, without its name, and runs the callbacks of its commands. Returns false
/// if there was nothing to do but to print --help or --version. Throws UsageError.
bool parseArguments(CLI::App& app, std::vector<std::string> arguments);

/// Runs a program and returns its exit status. The program fails by throwing; the error is written to
/// standard error as "NAME: ...". Must be called first in main().
int runMain(std::string_view name, const std::function<void()>& program);

}  // namespace duolux

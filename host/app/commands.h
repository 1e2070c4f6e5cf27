#pragma once

namespace CLI {
class App;
}

namespace duolux {

// Each function adds one command to the command line. A command's callback does the work and throws
// duolux::Error on failure; main() prints the line and maps it to the exit status.
void addRenderCommand(CLI::App& app);
void addBenchCommand(CLI::App& app);
void addCompareCommand(CLI::App& app);
void addDevicesCommand(CLI::App& app);
void addInfoCommand(CLI::App& app);
void addMakeSceneCommand(CLI::App& app);
void addMergeCommand(CLI::App& app);
void addSheetCommand(CLI::App& app);

}  // namespace duolux

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <string>
#include <vector>

#include "host/app/commands.h"
#include "host/app/options.h"
#include "host/app/signals.h"
#include "host/base/error.h"
#include "host/base/nearest_name.h"
#include "host/cli/program.h"

namespace {

/// CLI11 does not distinguish an unknown command from a missing one.
void checkCommand(const CLI::App& app, int argc, char** argv) {
    std::vector<std::string> known;
    for (const CLI::App* command : app.get_subcommands({}))
        known.push_back(command->get_name());
    if (argc < 2) {
        throw duolux::UsageError(
            fmt::format("expected a command: {} (see 'duolux --help')", fmt::join(known, ", ")));
    }
    if (argv[1][0] == '-') return;
    if (std::find(known.begin(), known.end(), argv[1]) != known.end()) return;
    throw duolux::UsageError(
        fmt::format("{}: unknown command; {}", argv[1], duolux::suggestName(argv[1], known)));
}

void run(int argc, char** argv) {
    CLI::App app{
        "Duolux renders vector-valued light (invisible, visible) through matrix-valued reflectance:\n"
        "local, global, shadowless and one-bounce illumination and all blends of these, with a path tracer "
        "and a light tracer.",
        "duolux"};
    duolux::setUpProgram(app);
    app.footer(
        "A model to a picture:  duolux render model.obj -o model.png\n"
        "All options:           duolux COMMAND --help");
    app.require_subcommand(1);
    // The last of repeated options counts, so that scripts can append to default options.
    app.option_defaults()->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
    app.get_formatter()->label("SUBCOMMAND", "COMMAND");
    duolux::addRenderCommand(app);
    duolux::addBenchCommand(app);
    duolux::addCompareCommand(app);
    duolux::addDevicesCommand(app);
    duolux::addInfoCommand(app);
    duolux::addMakeSceneCommand(app);
    duolux::addMergeCommand(app);
    duolux::addSheetCommand(app);
    for (CLI::App* command : app.get_subcommands({}))
        command->group("Commands");
    checkCommand(app, argc, argv);
    duolux::parseArguments(app, duolux::argumentsOf(argc, argv));
}

}  // namespace

int main(int argc, char** argv) {
    return duolux::runMain("duolux", [&] {
        duolux::handleSignals();
        run(argc, argv);
    });
}

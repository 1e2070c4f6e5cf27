#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <exception>
#include <new>
#include <sstream>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "host/app/commands.h"
#include "host/app/console.h"
#include "host/app/exit_status.h"
#include "host/app/options.h"
#include "host/app/signals.h"
#include "host/base/error.h"
#include "host/base/memory.h"
#include "host/base/nearest_name.h"
#include "host/base/version.h"

namespace {

int report(std::string_view line, duolux::ExitStatus status) {
    duolux::say(fmt::format("duolux: {}", line));
    return static_cast<int>(status);
}

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

int run(int argc, char** argv) {
    CLI::App app{
        "Duolux renders vector-valued light (invisible, visible) through matrix-valued reflectance:\n"
        "local, global, shadowless and one-bounce illumination and all blends of these, with a path tracer "
        "and a light tracer.",
        "duolux"};
    app.set_version_flag("--version",
                         fmt::format("duolux {} ({})", duolux::versionString(), duolux::commitString()));
    app.footer(
        "A model to a picture:  duolux render model.obj -o model.png\n"
        "All options:           duolux COMMAND --help");
    app.require_subcommand(1);
    // The last of repeated options counts, so that scripts can append to default options.
    app.option_defaults()->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
    app.get_formatter()->column_width(36);
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
    try {
        checkCommand(app, argc, argv);
        std::vector<std::string> arguments = duolux::argumentsOf(argc, argv);
        std::reverse(arguments.begin(), arguments.end());  // as CLI11 takes them
        app.parse(std::move(arguments));
        return static_cast<int>(duolux::ExitStatus::kDone);
    } catch (const CLI::Success& e) {
        std::ostringstream text;  // of --help or --version
        const int status = app.exit(e, text, text);
        duolux::printHelp(text.str());
        return status;
    } catch (const CLI::ParseError& e) {
        return report(duolux::describeParseError(app, e), duolux::ExitStatus::kUsage);
    }
}

}  // namespace

int main(int argc, char** argv) {
    duolux::openStandardStreams();
    duolux::handleSignals();
    try {
        const int status = run(argc, argv);
        duolux::printResult();
        return status;
    } catch (const duolux::Error& e) {
        return report(e.what(), statusOf(e));
    } catch (const std::bad_alloc&) {
        return report("out of memory" + duolux::addressSpaceHint(), duolux::ExitStatus::kMachineFailed);
    } catch (const std::system_error& e) {
        if (std::ferror(stdout) == 0) return report(e.what(), duolux::ExitStatus::kMachineFailed);
        return report("standard output: cannot write: " + e.code().message(),
                      duolux::ExitStatus::kMachineFailed);
    } catch (const std::exception& e) {
        return report(e.what(), duolux::ExitStatus::kMachineFailed);
    }
}

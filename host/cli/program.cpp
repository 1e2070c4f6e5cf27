#include "host/cli/program.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <memory>
#include <new>
#include <sstream>
#include <system_error>
#include <utility>

#include "host/base/error.h"
#include "host/base/memory.h"
#include "host/base/nearest_name.h"
#include "host/base/version.h"
#include "host/cli/console.h"
#include "host/cli/exit_status.h"

namespace duolux {

namespace {

/// What an option expects, in the words of --help: "N, from 1 to 16777216".
std::string expectationOf(const CLI::Option& option) {
    std::string type = option.get_type_name();
    const std::size_t colon = type.find(':');
    if (colon != std::string::npos) type.replace(colon, 1, type[colon + 1] == '{' ? ", one of " : ", ");
    return type;
}

/// The message for a syntax error on the command line.
std::string describeParseError(const CLI::App& app, const CLI::ParseError& error) {
    const std::vector<const CLI::App*> parsed =
        app.get_subcommands(static_cast<const std::function<bool(const CLI::App*)>&>(
            [](const CLI::App* a) { return a->parsed() > 0; }));
    const CLI::App& command = parsed.empty() ? app : *parsed.front();
    const std::string help =
        fmt::format("(see '{}{} --help')", app.get_name(), parsed.empty() ? "" : " " + command.get_name());
    if (dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr) {
        std::vector<std::string> known;
        for (const CLI::Option* option : command.get_options()) {
            for (const std::string& name : option->get_lnames())
                known.push_back("--" + name);
        }
        for (const std::string& word : app.remaining(true)) {
            if (word.starts_with("--") && word != "--")
                return fmt::format("{}: unknown option; {} {}", word, suggestName(word, known), help);
        }
        if (!command.get_allow_extras()) {
            std::vector<std::string> words = app.remaining(true);
            std::reverse(words.begin(), words.end());  // as the error lists them
            return fmt::format("{} {}", CLI::ExtrasError(command.get_name(), words).what(), help);
        }
    }
    if (dynamic_cast<const CLI::ArgumentMismatch*>(&error) != nullptr) {
        const std::string what = error.what(), name = what.substr(0, what.find(':'));
        if (const CLI::Option* const option = command.get_option_no_throw(name)) {
            return fmt::format("{}: its value is missing; expected {} {}", name, expectationOf(*option),
                               help);
        }
    }
    return fmt::format("{} {}", error.what(), help);
}

/// Memory for what must not fail after an allocation has failed: messages, and destructors that allocate,
/// such as those of large JSON documents. It is not touched, so it takes only address space.
std::unique_ptr<char[]> memoryReserve;

void reserveMemory() {
    constexpr std::uint64_t kMost = std::uint64_t{64} << 20, kLeast = std::uint64_t{1} << 20;
    for (std::uint64_t size = std::min(kMost, addressSpaceLimit() / 3); size >= kLeast; size /= 2) {
        memoryReserve.reset(new (std::nothrow) char[static_cast<std::size_t>(size)]);
        if (memoryReserve) return;
    }
}

[[noreturn]] void releaseMemoryReserve() {
    memoryReserve.reset();
    std::set_new_handler(nullptr);
    throw std::bad_alloc();
}

}  // namespace

void setUpProgram(CLI::App& app) {
    app.set_version_flag("--version",
                         fmt::format("{} {} ({})", app.get_name(), versionString(), commitString()));
    app.get_formatter()->column_width(36);
}

bool parseArguments(CLI::App& app, std::vector<std::string> arguments) {
    std::reverse(arguments.begin(), arguments.end());  // as CLI11 takes them
    try {
        app.parse(std::move(arguments));
        return true;
    } catch (const CLI::Success& e) {
        std::ostringstream text;  // of --help or --version
        app.exit(e, text, text);
        printHelp(text.str());
        return false;
    } catch (const CLI::ParseError& e) {
        throw UsageError(describeParseError(app, e));
    }
}

int runMain(std::string_view name, const std::function<void()>& program) {
    openStandardStreams();
    reserveMemory();
    std::set_new_handler(releaseMemoryReserve);
    const auto report = [&](std::string_view line, ExitStatus status) {
        say(fmt::format("{}: {}", name, line));
        return static_cast<int>(status);
    };
    try {
        program();
        printResult();
        return static_cast<int>(ExitStatus::kDone);
    } catch (const Error& e) {
        return report(e.what(), statusOf(e));
    } catch (const std::bad_alloc&) {
        return report("out of memory" + addressSpaceHint(), ExitStatus::kMachineFailed);
    } catch (const std::system_error& e) {
        if (std::ferror(stdout) == 0) return report(e.what(), ExitStatus::kMachineFailed);
        return report("standard output: cannot write: " + e.code().message(), ExitStatus::kMachineFailed);
    } catch (const std::exception& e) {
        return report(e.what(), ExitStatus::kMachineFailed);
    }
}

}  // namespace duolux

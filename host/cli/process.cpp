#include "host/cli/process.h"

#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <string_view>

#include "host/base/error.h"

namespace duolux {

namespace {

std::vector<char*> pointersTo(std::vector<std::string>& texts) {
    std::vector<char*> pointers;
    for (std::string& text : texts)
        pointers.push_back(text.data());
    pointers.push_back(nullptr);
    return pointers;
}

/// Appends this program's environment variables, except those that `environment` already sets.
void addOwnEnvironment(std::vector<std::string>& environment) {
    const std::vector<std::string> changed = environment;
    for (char** variable = environ; *variable != nullptr; ++variable) {
        const std::string_view text = *variable;
        const std::string_view name = text.substr(0, text.find('=') + 1);
        const auto same = [&](const std::string& other) { return other.starts_with(name); };
        if (std::none_of(changed.begin(), changed.end(), same)) environment.emplace_back(text);
    }
}

}  // namespace

int runProcess(const std::string& program, std::vector<std::string> arguments,
               std::vector<std::string> environment) {
    arguments.insert(arguments.begin(), program);
    addOwnEnvironment(environment);
    pid_t child = 0;
    const int failure = ::posix_spawnp(&child, program.c_str(), nullptr, nullptr,
                                       pointersTo(arguments).data(), pointersTo(environment).data());
    if (failure == ENOENT || failure == EACCES) return 127;
    if (failure != 0) throw MachineError("cannot start another process");
    int status = 0;
    while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

}  // namespace duolux

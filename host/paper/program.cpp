#include "host/paper/program.h"

#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include "host/base/error.h"
#include "host/base/file.h"

namespace duolux {

nlohmann::json runProgram(const std::filesystem::path& program, std::vector<std::string> arguments,
                          const std::filesystem::path& report) {
    arguments.insert(arguments.begin(), program.string());
    arguments.insert(arguments.end(), {"--report", report.string()});
    std::vector<char*> argv;
    for (std::string& argument : arguments)
        argv.push_back(argument.data());
    argv.push_back(nullptr);
    const pid_t child = ::fork();
    if (child < 0) throw MachineError("cannot start another process");
    if (child == 0) {
        ::execvp(program.c_str(), argv.data());
        ::_exit(127);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) {
        std::string line;
        for (const std::string& argument : arguments)
            line += (line.empty() ? "" : " ") + argument;
        throw MachineError(fmt::format(
            "failed ({}): {}",
            WIFEXITED(status) && WEXITSTATUS(status) == 127 ? "cannot be started" : "see above", line));
    }
    return nlohmann::json::parse(readFile(report));
}

}  // namespace duolux

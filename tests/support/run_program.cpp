#include "tests/support/run_program.h"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string_view>
#include <thread>

#include "host/cli/temporary_folder.h"

namespace duolux::test {

ProgramResult runProgram(const std::string& program, const std::filesystem::path& folder,
                         std::vector<std::string> arguments, std::optional<ProgramSignal> signal,
                         std::chrono::seconds limit, const std::vector<std::string>& environment) {
    const TemporaryFolder streams;
    const std::string out = streams.path() / "out";
    const std::string err = streams.path() / "err";
    arguments.insert(arguments.begin(), program);
    std::vector<char*> argv;
    for (std::string& argument : arguments)
        argv.push_back(argument.data());
    argv.push_back(nullptr);
    std::vector<std::string> variables = environment;
    for (char** variable = environ; *variable != nullptr; ++variable) {
        const std::string_view name =
            std::string_view(*variable).substr(0, std::string_view(*variable).find('=') + 1);
        const auto same = [&](const std::string& v) { return v.starts_with(name); };
        if (std::none_of(environment.begin(), environment.end(), same)) variables.emplace_back(*variable);
    }
    std::vector<char*> envp;
    for (std::string& variable : variables)
        envp.push_back(variable.data());
    envp.push_back(nullptr);
    const pid_t child = fork();
    if (child < 0) throw std::runtime_error("fork");
    if (child == 0) {
        if (chdir(folder.c_str()) != 0) _exit(125);
        dup2(open("/dev/null", O_RDONLY), 0);
        dup2(open(out.c_str(), O_CREAT | O_WRONLY, 0600), 1);
        dup2(open(err.c_str(), O_CREAT | O_WRONLY, 0600), 2);
        alarm(static_cast<unsigned>(limit.count()));  // ends a program that hangs
        execve(argv[0], argv.data(), envp.data());
        _exit(126);
    }
    if (signal) {
        std::this_thread::sleep_for(signal->after);
        kill(child, signal->signal);
    }
    int status = 0;
    waitpid(child, &status, 0);
    return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), contentsOf(out),
            contentsOf(err)};
}

std::string contentsOf(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

}  // namespace duolux::test

#include "host/cli/console.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <string>

#include "host/base/error.h"
#include "host/base/printable.h"

namespace duolux {

void openStandardStreams() {
    for (const int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
        if (::fcntl(descriptor, F_GETFD) >= 0 || errno != EBADF) continue;
        // open() returns this number, the lowest free one. The access mode is the opposite of the stream's,
        // so that using the stream still fails.
        static_cast<void>(::open("/dev/null", descriptor == STDIN_FILENO ? O_WRONLY : O_RDONLY));
    }
}

void say(std::string_view line) {
    std::fflush(stdout);  // keeps the order if both streams go to the same place
    const std::string text = asMessage(line) + "\n";
    std::fwrite(text.data(), 1, text.size(), stderr);
    std::fflush(stderr);
}

void warn(std::string_view text) {
    say(fmt::format("duolux: warning: {}", text));
}

void printResult(std::string_view text) {
    errno = 0;
    if (std::fwrite(text.data(), 1, text.size(), stdout) == text.size() && std::fflush(stdout) == 0 &&
        std::ferror(stdout) == 0) {
        return;
    }
    const char* reason = errno != 0 ? std::strerror(errno) : "an earlier part was lost";
    throw MachineError(fmt::format("standard output: cannot write: {}", reason));
}

void printHelp(std::string_view text) {
    errno = 0;
    const bool written =
        std::fwrite(text.data(), 1, text.size(), stdout) == text.size() && std::fflush(stdout) == 0;
    if (!written && errno == EPIPE) std::clearerr(stdout);
}

}  // namespace duolux

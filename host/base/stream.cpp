#include "host/base/stream.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <system_error>

namespace duolux {

namespace fs = std::filesystem;

namespace {

std::atomic<bool> readersAwaited{true};
static_assert(std::atomic<bool>::is_always_lock_free);  // a signal handler sets it

/// Waits until a pipe or device can be written to. Throws EINTR at a signal and, if readers are no longer
/// awaited, after a second in which nothing was read.
void waitForReader(int stream) {
    constexpr int kInterval = 100, kPatience = 10;  // ms, intervals
    for (int left = kPatience;; --left) {
        if (left == 0) throw std::system_error(EINTR, std::generic_category());
        pollfd entry{stream, POLLOUT, 0};
        const int ready = ::poll(&entry, 1, kInterval);
        if (ready > 0) return;
        if (ready < 0) throw std::system_error(errno, std::generic_category());
        if (readersAwaited) left = kPatience + 1;
    }
}

}  // namespace

bool isPipe(const fs::path& path) {
    std::error_code unknown;
    return fs::is_fifo(path, unknown);
}

void stopAwaitingReaders() noexcept {
    readersAwaited = false;
}

int openStream(const fs::path& path) {
    // Not by an open() that waits for the reader: a signal that comes before it would not interrupt it.
    constexpr int kInterval = 20;  // ms
    for (;;) {
        const int stream = ::open(path.c_str(), O_WRONLY | O_APPEND | O_NONBLOCK | O_CLOEXEC | O_NOCTTY);
        struct stat status {};
        if (stream >= 0 || errno != ENXIO || ::stat(path.c_str(), &status) != 0 || !S_ISFIFO(status.st_mode))
            return stream;
        if (!readersAwaited || ::poll(nullptr, 0, kInterval) < 0) {
            errno = EINTR;
            return -1;
        }
    }
}

void writeAll(int file, const char* bytes, std::size_t count) {
    while (count > 0) {
        const ssize_t written = ::write(file, bytes, count);
        if (written < 0 && errno == EAGAIN) {
            waitForReader(file);
            continue;
        }
        if (written < 0) throw std::system_error(errno, std::generic_category());
        bytes += written;
        count -= static_cast<std::size_t>(written);
    }
}

}  // namespace duolux

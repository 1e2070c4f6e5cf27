#include "host/app/signals.h"

#include <unistd.h>

#include <csignal>
#include <ctime>
#include <string_view>

#include "host/base/stream.h"

namespace duolux {

namespace {

volatile std::sig_atomic_t deferred = 0;
volatile std::sig_atomic_t stopSignal = 0;
timespec firstSignal{};  // when it came

/// Programs such as timeout(1) send a signal to the process and to its group: the same request twice.
bool repeatsFirst() {
    constexpr double kSeconds = 0.5;
    timespec now{};
    ::clock_gettime(CLOCK_MONOTONIC, &now);
    return static_cast<double>(now.tv_sec - firstSignal.tv_sec) +
               1e-9 * static_cast<double>(now.tv_nsec - firstSignal.tv_nsec) <
           kSeconds;
}

ExitStatus statusOf(int signal) {
    return signal == SIGINT || signal == SIGHUP ? ExitStatus::kInterrupted : ExitStatus::kTerminated;
}

extern "C" void onSignal(int signal) {
    if (deferred != 0 && stopSignal == 0) {
        ::clock_gettime(CLOCK_MONOTONIC, &firstSignal);
        stopSignal = signal;
        stopAwaitingReaders();
        return;
    }
    if (stopSignal != 0 && (signal == SIGXCPU || repeatsFirst())) return;  // SIGXCPU comes every second
    constexpr std::string_view kInterrupted = "duolux: interrupted\n", kTerminated = "duolux: terminated\n";
    const std::string_view line = statusOf(signal) == ExitStatus::kInterrupted ? kInterrupted : kTerminated;
    static_cast<void>(!::write(STDERR_FILENO, line.data(), line.size()));
    ::_exit(static_cast<int>(statusOf(signal)));
}

void setAction(int signal, void (*handler)(int)) {
    struct sigaction action {};
    action.sa_handler = handler;
    ::sigaction(signal, &action, nullptr);  // without SA_RESTART
}

bool isIgnored(int signal) {
    struct sigaction action {};
    return ::sigaction(signal, nullptr, &action) == 0 && action.sa_handler == SIG_IGN;
}

}  // namespace

void handleSignals() {
    for (const int signal : {SIGINT, SIGTERM, SIGXCPU})
        setAction(signal, onSignal);
    if (!isIgnored(SIGHUP)) setAction(SIGHUP, onSignal);
    for (const int signal : {SIGPIPE, SIGXFSZ})
        setAction(signal, SIG_IGN);
}

void deferSignals() {
    deferred = 1;
}

std::optional<ExitStatus> stopStatus() {
    if (stopSignal == 0) return std::nullopt;
    return statusOf(stopSignal);
}

}  // namespace duolux

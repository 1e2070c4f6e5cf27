#include "host/app/interrupt.h"

#include <csignal>

namespace duolux {

namespace {

volatile std::sig_atomic_t stopRequested = 0;

extern "C" void onSignal(int signal) {
    stopRequested = 1;
    std::signal(signal, SIG_DFL);
}

}  // namespace

void catchInterrupts() {
    std::signal(SIGINT, onSignal);
    std::signal(SIGTERM, onSignal);
}

bool interrupted() {
    return stopRequested != 0;
}

}  // namespace duolux

#include "host/base/parallel.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace duolux {

namespace {

std::atomic<unsigned> chosenWorkers{0};

}  // namespace

unsigned workerCount() {
    const unsigned chosen = chosenWorkers;
    return chosen > 0 ? chosen : std::max(1u, std::thread::hardware_concurrency());
}

void limitWorkers(unsigned count) {
    chosenWorkers = count;
}

void runOnThreads(std::size_t threads, const std::function<void()>& work) {
    std::vector<std::jthread> pool;
    try {
        while (pool.size() + 1 < threads)
            pool.emplace_back(work);
    } catch (const std::exception&) {
        // The system has no more threads, or no memory for their stacks: the existing threads do all the
        // work.
    }
    work();
}  // joins

void parallelFor(std::size_t count, std::size_t grain,
                 const std::function<void(std::size_t, std::size_t)>& body) {
    if (count == 0) return;
    grain = std::max<std::size_t>(grain, 1);
    const std::size_t chunks = (count + grain - 1) / grain;
    const std::size_t threads = std::min<std::size_t>(workerCount(), chunks);
    if (threads <= 1) {
        body(0, count);
        return;
    }
    std::atomic<std::size_t> next{0};
    std::exception_ptr failure;
    std::mutex failureMutex;
    auto work = [&] {
        try {
            for (std::size_t chunk = next++; chunk < chunks; chunk = next++) {
                body(chunk * grain, std::min(count, (chunk + 1) * grain));
            }
        } catch (...) {
            std::lock_guard lock(failureMutex);
            if (!failure) failure = std::current_exception();
            next = chunks;
        }
    };
    runOnThreads(threads, work);
    if (failure) std::rethrow_exception(failure);
}

}  // namespace duolux

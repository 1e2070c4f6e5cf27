#pragma once

#include <cstddef>
#include <functional>

namespace duolux {

/// Number of threads that share work: the cores that this process may use, unless limitWorkers chose another.
/// At least 1.
unsigned workerCount();

/// Chooses the number of threads from now on, which may be more than there are cores; 0: one for each core.
void limitWorkers(unsigned count);

/// Runs `work` on up to `threads` threads at a time, this one among them, and waits for them; on fewer where
/// the system has no more to give. `work` must not throw, and one thread alone must be able to finish it.
void runOnThreads(std::size_t threads, const std::function<void()>& work);

/// Calls body(begin, end) on disjoint ranges that cover [0, count), on workerCount() threads, and waits for
/// them.
/// Ranges hold at least `grain` items (but for the last). The split must not matter to the result.
/// The first exception thrown by a body is rethrown here.
void parallelFor(std::size_t count, std::size_t grain,
                 const std::function<void(std::size_t, std::size_t)>& body);

}  // namespace duolux

#pragma once

#include <cstddef>
#include <functional>

namespace duolux {

/// Number of worker threads: the number of cores available to this process, unless limitWorkers set another.
/// At least 1.
unsigned workerCount();

/// Sets the number of worker threads, which may exceed the number of cores; 0: one for each core.
void limitWorkers(unsigned count);

/// Runs `work` on up to `threads` threads, including the calling one, and waits for them. Uses fewer threads
/// if the system cannot provide more. `work` must not throw, and a single thread must be able to finish it.
void runOnThreads(std::size_t threads, const std::function<void()>& work);

/// Calls body(begin, end) on disjoint ranges that cover [0, count), on workerCount() threads, and waits for
/// them.
/// Ranges hold at least `grain` items, except for the last. The result must not depend on the split.
/// The first exception thrown by a body is rethrown.
void parallelFor(std::size_t count, std::size_t grain,
                 const std::function<void(std::size_t, std::size_t)>& body);

}  // namespace duolux

#pragma once

#include <cstddef>
#include <functional>

namespace duolux {

/// Number of worker threads used by parallelFor: the hardware's cores, at least 1.
unsigned workerCount();

/// Calls body(begin, end) on disjoint ranges that cover [0, count), on all cores, and waits for them.
/// Ranges hold at least `grain` items (but for the last). The split must not matter to the result.
/// The first exception thrown by a body is rethrown here.
void parallelFor(std::size_t count, std::size_t grain,
                 const std::function<void(std::size_t, std::size_t)>& body);

}  // namespace duolux

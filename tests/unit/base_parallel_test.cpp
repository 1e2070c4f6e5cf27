#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <mutex>
#include <numeric>
#include <set>
#include <stdexcept>
#include <thread>
#include <vector>

#include "host/base/parallel.h"
#include "tests/support/address_space.h"

namespace duolux {
namespace {

TEST(ParallelFor, CoversEveryIndexOnce) {
    for (std::size_t count : {0u, 1u, 7u, 1000u}) {
        for (std::size_t grain : {0u, 1u, 3u, 5000u}) {
            std::vector<std::atomic<int>> visits(count);
            parallelFor(count, grain, [&](std::size_t begin, std::size_t end) {
                EXPECT_LT(begin, end);
                for (std::size_t i = begin; i < end; ++i)
                    ++visits[i];
            });
            for (const auto& visit : visits)
                EXPECT_EQ(visit, 1);
        }
    }
}

TEST(ParallelFor, RethrowsWhatABodyThrows) {
    EXPECT_THROW(parallelFor(100, 1,
                             [](std::size_t begin, std::size_t) {
                                 if (begin == 42) throw std::domain_error("42");
                             }),
                 std::domain_error);
}

TEST(WorkerCount, IsTheNumberOfCoresUnlessChosen) {
    const unsigned cores = workerCount();
    EXPECT_GE(cores, 1u);
    limitWorkers(cores + 3);
    EXPECT_EQ(workerCount(), cores + 3);
    limitWorkers(0);
    EXPECT_EQ(workerCount(), cores);
}

/// The number of threads that run a loop of this many chunks.
unsigned threadsThatWork(std::size_t chunks) {
    std::mutex mutex;
    std::set<std::thread::id> threads;
    parallelFor(chunks, 1, [&](std::size_t, std::size_t) {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
        const std::lock_guard lock(mutex);
        threads.insert(std::this_thread::get_id());
    });
    return static_cast<unsigned>(threads.size());
}

TEST(ParallelFor, UsesTheThreadsThatWereChosen) {
    limitWorkers(1);
    EXPECT_EQ(threadsThatWork(20), 1u);
    limitWorkers(4);
    EXPECT_EQ(threadsThatWork(40), 4u);
    limitWorkers(0);
}

TEST(ParallelFor, DoesWithFewerThreadsThanWereChosen) {
    // The remaining address space holds a few stacks, but not sixteen.
    limitWorkers(16);
    std::atomic<int> sum{0};
    {
        const test::AddressSpaceLimit limit(std::size_t{20} << 20);
        EXPECT_NO_THROW(parallelFor(100, 1, [&](std::size_t begin, std::size_t) { sum += int(begin); }));
    }
    limitWorkers(0);
    EXPECT_EQ(sum, 4950);
}

}  // namespace
}  // namespace duolux

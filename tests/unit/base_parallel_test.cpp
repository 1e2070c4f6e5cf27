#include <gtest/gtest.h>

#include <atomic>
#include <numeric>
#include <stdexcept>
#include <vector>

#include "host/base/parallel.h"

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

TEST(WorkerCount, IsPositive) {
    EXPECT_GE(workerCount(), 1u);
}

}  // namespace
}  // namespace duolux

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <utility>

#include "host/render/schedule.h"

namespace duolux {
namespace {

/// How often each (slot, sample) was handed out.
using Counts = std::map<std::pair<std::uint32_t, std::uint32_t>, int>;

void count(Counts& counts, const WorkRange& range) {
    for (std::uint32_t slot = range.firstSlot; slot < range.firstSlot + range.slots; ++slot) {
        for (std::uint32_t s = range.firstSample; s < range.firstSample + range.samples; ++s)
            ++counts[{slot, s}];
    }
}

void expectEachOnce(const Counts& counts, std::size_t slots, std::size_t samples) {
    EXPECT_EQ(counts.size(), slots * samples);
    for (const auto& [work, times] : counts)
        ASSERT_EQ(times, 1) << work.first << " " << work.second;
}

TEST(Schedule, HandsOutEachSampleOnceAtAnySpeed) {
    for (const double seconds : {0.0, 1e-9, 1e-6, 1e-4, 1.0}) {
        for (const std::uint32_t lane : {1u, 3u, 128u}) {
            Schedule schedule(700, 21, 300, 16);
            Counts counts;
            std::uint32_t firstSampleSlots = 0;
            while (const auto range = schedule.next(seconds, lane, false)) {
                EXPECT_LE(range->slots, 300u);
                EXPECT_LE(range->samples, std::min(lane, 16u));
                EXPECT_LE(static_cast<double>(range->size()) * seconds,
                          std::max(kDispatchSeconds, 64 * seconds) * 1.0001);
                if (range->firstSample == 0) {
                    EXPECT_EQ(range->samples, 1u);
                    firstSampleSlots += range->slots;
                } else {
                    EXPECT_EQ(firstSampleSlots, 700u) << "the first pass comes first";
                }
                count(counts, *range);
            }
            expectEachOnce(counts, 700, 21);
        }
    }
}

TEST(Schedule, RunsTakeAboutTheTimeOfADispatch) {
    Schedule schedule(1u << 20, 100, 1u << 18, 16);
    while (schedule.next(2e-6, 128, false)->firstSample == 0) {
    }
    const WorkRange range = *schedule.next(2e-6, 128, false);
    EXPECT_EQ(range.samples, 16u);
    EXPECT_NEAR(static_cast<double>(range.size()) * 2e-6, kDispatchSeconds, 0.05 * kDispatchSeconds);
    // Where one sample is slow, few are taken of few slots.
    Schedule slow(1000, 100, 1000, 16);
    while (slow.next(1e-3, 128, false)->firstSample == 0) {
    }
    EXPECT_LE(slow.next(1e-3, 128, false)->size(), 128u);
}

TEST(Schedule, ChangesOfTheLimitWithinARunLoseNothing) {
    Schedule schedule(500, 40, 500, 16);
    Counts counts;
    const std::uint32_t limits[] = {128, 5, 7, 2, 128, 1, 3, 16};
    std::size_t i = 0;
    while (const auto range = schedule.next(1e-5 * static_cast<double>(i % 5), limits[i % 8], false)) {
        count(counts, *range);
        ++i;
    }
    expectEachOnce(counts, 500, 40);
}

TEST(Schedule, RetriesComeInPartsThatFit) {
    Schedule schedule(100, 17, 100, 16);
    Counts counts;
    count(counts, *schedule.next(0.0, 128, false));
    const WorkRange cut = *schedule.next(0.0, 128, false);
    EXPECT_EQ(cut.samples, 16u);
    schedule.retry(cut);
    while (const auto range = schedule.next(0.0, 5, false)) {
        EXPECT_LE(range->samples, 5u);
        count(counts, *range);
    }
    expectEachOnce(counts, 100, 17);
}

TEST(Schedule, WhenTimeIsUpOnlyTheFirstPassGoesOn) {
    Schedule schedule(600, 9, 256, 16);
    Counts counts;
    const WorkRange first = *schedule.next(0.0, 128, false);
    schedule.retry(first);
    while (const auto range = schedule.next(0.0, 128, true)) {
        EXPECT_EQ(range->firstSample, 0u);
        count(counts, *range);
    }
    expectEachOnce(counts, 600, 1);
    // A range of a later pass waits in vain, one of the first does not.
    schedule.retry({0, 10, 3, 2});
    EXPECT_FALSE(schedule.next(0.0, 128, true));
    schedule.retry({0, 10, 0, 1});
    EXPECT_EQ(schedule.next(0.0, 128, true)->firstSample, 0u);
}

}  // namespace
}  // namespace duolux

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include "host/render/schedule.h"

namespace duolux {
namespace {

/// How often each (pixel, sample) was handed out.
using Counts = std::map<std::pair<std::uint32_t, std::uint32_t>, int>;

void count(Counts& counts, const WorkRange& range) {
    for (std::uint32_t pixel = range.firstPixel; pixel < range.firstPixel + range.pixels; ++pixel) {
        for (std::uint32_t s = range.firstSample; s < range.firstSample + range.samples; ++s)
            ++counts[{pixel, s}];
    }
}

void expectEachOnce(const Counts& counts, std::size_t pixels, std::size_t samples) {
    EXPECT_EQ(counts.size(), pixels * samples);
    for (const auto& [work, times] : counts)
        ASSERT_EQ(times, 1) << work.first << " " << work.second;
}

TEST(Schedule, HandsOutEachSampleOnceAtAnySpeed) {
    for (const double seconds : {0.0, 1e-9, 1e-6, 1e-4, 1.0}) {
        for (const std::uint32_t lane : {1u, 3u, 128u}) {
            Schedule schedule(700, {0, 21}, 300, 16);
            Counts counts;
            std::uint32_t firstSamplePixels = 0;
            while (const auto range = schedule.next(seconds, lane, Wanted::kAll)) {
                EXPECT_LE(range->pixels, 300u);
                EXPECT_LE(range->samples, std::min(lane, 16u));
                EXPECT_LE(static_cast<double>(range->size()) * seconds,
                          std::max(kDispatchSeconds, 64 * seconds) * 1.0001);
                if (range->firstSample == 0) {
                    EXPECT_EQ(range->samples, 1u);
                    firstSamplePixels += range->pixels;
                } else {
                    EXPECT_EQ(firstSamplePixels, 700u) << "the first pass comes first";
                }
                count(counts, *range);
            }
            expectEachOnce(counts, 700, 21);
        }
    }
}

TEST(Schedule, RunsTakeAboutTheTimeOfADispatch) {
    Schedule schedule(1u << 20, {0, 100}, 1u << 18, 16);
    while (schedule.next(2e-6, 128, Wanted::kAll)->firstSample == 0) {
    }
    const WorkRange range = *schedule.next(2e-6, 128, Wanted::kAll);
    EXPECT_EQ(range.samples, 16u);
    EXPECT_NEAR(static_cast<double>(range.size()) * 2e-6, kDispatchSeconds, 0.05 * kDispatchSeconds);
    // If a sample is slow, a range has few samples of few pixels.
    Schedule slow(1000, {0, 100}, 1000, 16);
    while (slow.next(1e-3, 128, Wanted::kAll)->firstSample == 0) {
    }
    EXPECT_LE(slow.next(1e-3, 128, Wanted::kAll)->size(), 128u);
}

TEST(Schedule, ChangesOfTheLimitWithinARunLoseNothing) {
    Schedule schedule(500, {0, 40}, 500, 16);
    Counts counts;
    const std::uint32_t limits[] = {128, 5, 7, 2, 128, 1, 3, 16};
    std::size_t i = 0;
    while (const auto range = schedule.next(1e-5 * static_cast<double>(i % 5), limits[i % 8], Wanted::kAll)) {
        count(counts, *range);
        ++i;
    }
    expectEachOnce(counts, 500, 40);
}

TEST(Schedule, RetriesComeInPartsThatFit) {
    Schedule schedule(100, {0, 17}, 100, 16);
    Counts counts;
    count(counts, *schedule.next(0.0, 128, Wanted::kAll));
    const WorkRange cut = *schedule.next(0.0, 128, Wanted::kAll);
    EXPECT_EQ(cut.samples, 16u);
    schedule.retry(cut);
    while (const auto range = schedule.next(0.0, 5, Wanted::kAll)) {
        EXPECT_LE(range->samples, 5u);
        count(counts, *range);
    }
    expectEachOnce(counts, 100, 17);
}

TEST(Schedule, WhenTimeIsUpOnlyTheFirstPassGoesOn) {
    Schedule schedule(600, {0, 9}, 256, 16);
    Counts counts;
    const WorkRange first = *schedule.next(0.0, 128, Wanted::kAll);
    schedule.retry(first);
    while (const auto range = schedule.next(0.0, 128, Wanted::kFirstPass)) {
        EXPECT_EQ(range->firstSample, 0u);
        count(counts, *range);
        schedule.traced(*range);
    }
    expectEachOnce(counts, 600, 1);
    EXPECT_FALSE(schedule.next(0.0, 128, Wanted::kFirstPass));
    // Retries are handed out in every pass, because their pixels must not keep gaps.
    for (const Wanted wanted : {Wanted::kFirstPass, Wanted::kRetries}) {
        EXPECT_TRUE(schedule.settled());
        schedule.retry({0, 10, 3, 2});
        EXPECT_FALSE(schedule.settled());
        EXPECT_EQ(schedule.next(0.0, 1, wanted)->firstSample, 3u);
        const WorkRange rest = *schedule.next(0.0, 128, wanted);
        EXPECT_EQ(rest.firstSample, 4u);
        EXPECT_FALSE(schedule.next(0.0, 128, wanted));
        // A range in flight leaves a gap until it is traced, and longer if it is ended early again.
        schedule.traced({0, 10, 3, 1, true});
        EXPECT_FALSE(schedule.settled());
        schedule.retry(rest);
        EXPECT_FALSE(schedule.settled());
        schedule.traced(*schedule.next(0.0, 128, wanted));
    }
    EXPECT_TRUE(schedule.settled());
}

TEST(Schedule, ResumesFromAnyState) {
    constexpr std::uint32_t kFirst = 5, kEnd = 40;
    const auto resumed = [](const std::vector<std::uint32_t>& taken) {
        Counts counts;
        for (std::uint32_t pixel = 0; pixel < taken.size(); ++pixel) {
            if (taken[pixel] > 0) count(counts, {pixel, 1, kFirst, taken[pixel]});
        }
        Schedule schedule(static_cast<std::uint32_t>(taken.size()), {kFirst, kEnd}, 100, 16);
        schedule.resume(taken);
        while (const auto range = schedule.next(1e-5, 11, Wanted::kAll)) {
            EXPECT_LE(range->pixels, 100u);
            EXPECT_LE(range->samples, 11u);
            count(counts, *range);
        }
        expectEachOnce(counts, taken.size(), kEnd - kFirst);
    };
    resumed(std::vector<std::uint32_t>(300, 0));
    resumed(std::vector<std::uint32_t>(300, 7));
    resumed(std::vector<std::uint32_t>(300, kEnd - kFirst));
    std::vector<std::uint32_t> uneven(300, 17);
    std::fill(uneven.begin() + 130, uneven.begin() + 150, 1);
    std::fill(uneven.begin() + 150, uneven.end(), 0);
    resumed(uneven);
    uneven[299] = kEnd - kFirst;
    resumed(uneven);

    // With a limit below the samples that some pixels already have, the other pixels do not exceed the limit.
    Schedule fewer(300, {kFirst, kFirst + 9}, 100, 16);
    fewer.resume(uneven);
    Counts some;
    while (const auto range = fewer.next(0.0, 128, Wanted::kAll))
        count(some, *range);
    EXPECT_EQ(some.size(), 20u * 8u + 149u * 9u);
    for (const auto& [work, times] : some)
        EXPECT_TRUE(work.second < kFirst + 9 && times == 1);

    // When the time is up, pixels without a sample get only one.
    Schedule schedule(300, {kFirst, kEnd}, 100, 16);
    schedule.resume(uneven);
    Counts counts;
    while (const auto range = schedule.next(0.0, 128, Wanted::kFirstPass))
        count(counts, *range);
    EXPECT_EQ(counts.size(), 149u);
    for (const auto& [work, times] : counts) {
        EXPECT_TRUE(work.first >= 150 && work.first < 299 && work.second == kFirst && times == 1);
    }
}

}  // namespace
}  // namespace duolux

#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "host/film/sample_range.h"

namespace duolux {

/// A range of work: samples [firstSample, firstSample + samples) of the pixels [firstPixel, firstPixel +
/// pixels), numbered in the order in which they are traced.
struct WorkRange {
    std::uint32_t firstPixel = 0, pixels = 0;
    std::uint32_t firstSample = 0, samples = 0;
    bool again = false;  ///< handed out before, alone or as part of a larger range

    std::uint64_t size() const { return std::uint64_t{pixels} * samples; }
};

/// Target duration of a dispatch: short enough for watchdogs and a prompt stop, long enough to hide its
/// overhead.
inline constexpr double kDispatchSeconds = 0.1;

/// Which ranges a caller wants from a schedule.
enum class Wanted : std::uint8_t {
    kAll,
    kFirstPass,  ///< only the first sample of every pixel, the minimum for an image
    kRetries     ///< only ranges to be traced again, so that no pixel's samples have gaps
};

/// Divides the work into dispatches: a first pass with one sample for every pixel, then passes with several
/// samples. Each pass consists of runs of pixels whose size follows the measured speed. A render that stops
/// early has about the same number of samples in every pixel.
class Schedule {
  public:
    /// Schedules these samples of `pixels` pixels, with at most maxPixels pixels and maxSamples samples of a
    /// pixel in one dispatch.
    Schedule(std::uint32_t pixels, SampleRange samples, std::uint32_t maxPixels, std::uint32_t maxSamples);

    /// Resumes from a state in which `taken` samples of each pixel have been traced, from samples.begin on.
    /// Must be called before the first next().
    void resume(std::span<const std::uint32_t> taken);

    /// The next range, with at most `laneSamples` samples of a pixel; empty when all have been handed out.
    /// `secondsPerSample`: as measured so far; 0: not measured yet.
    std::optional<WorkRange> next(double secondsPerSample, std::uint32_t laneSamples, Wanted wanted);

    /// Returns a range to the schedule because it must be traced again.
    void retry(WorkRange range);

    /// Records that a range has been traced.
    void traced(const WorkRange& range) { unsettled_ -= range.again ? range.size() : 0; }

    /// Whether no range must be traced again, so that the traced samples of all pixels are free of gaps.
    bool settled() const { return unsettled_ == 0; }

  private:
    void chooseRun(double secondsPerSample);
    std::optional<WorkRange> take(std::vector<WorkRange>& waiting, std::uint32_t laneSamples,
                                  Wanted wanted) const;

    std::uint32_t pixels_, firstSample_, endSample_, maxPixels_, maxSamples_;
    std::uint32_t passBegin_, passEnd_;  // samples of the current pass
    std::uint32_t firstPixel_ = 0;       // of the current run
    std::uint32_t runPixels_ = 0,
                  runSamples_ = 0;  // size of the run; largest number of samples in a dispatch
    std::uint32_t nextSample_;
    std::uint64_t unsettled_ = 0;              // samples that must be traced again
    std::vector<WorkRange> retries_, behind_;  // behind_: samples that other pixels already have (resume)
};

}  // namespace duolux

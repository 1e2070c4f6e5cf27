#pragma once

#include <cstdint>
#include <optional>
#include <vector>

namespace duolux {

/// A range of work: samples [firstSample, firstSample + samples) of the slots [firstSlot, firstSlot + slots).
struct WorkRange {
    std::uint32_t firstSlot = 0, slots = 0;
    std::uint32_t firstSample = 0, samples = 0;

    std::uint64_t size() const { return std::uint64_t{slots} * samples; }
};

/// A dispatch should take about this long: short enough for watchdogs and a prompt stop, long enough to hide
/// its cost.
inline constexpr double kDispatchSeconds = 0.1;

/// Cuts the work into dispatches: a first pass of one sample for every slot, then passes of several, each in
/// runs of slots whose size follows the measured speed. What is stopped early has about as many samples
/// everywhere.
class Schedule {
  public:
    /// At most maxSlots slots and maxSamples samples of a slot in one dispatch.
    Schedule(std::uint32_t slots, std::uint32_t spp, std::uint32_t maxSlots, std::uint32_t maxSamples);

    /// The next range, of at most `laneSamples` samples of a slot; nothing when all have been handed out.
    /// `secondsPerSample`: measured so far, 0: not yet. `firstPassOnly`: only work of the first pass, which
    /// everything else can do without.
    std::optional<WorkRange> next(double secondsPerSample, std::uint32_t laneSamples, bool firstPassOnly);

    /// Takes back a range that was handed out and has to be traced again.
    void retry(const WorkRange& range) { retries_.push_back(range); }

  private:
    void chooseRun(double secondsPerSample);

    std::uint32_t slots_, spp_, maxSlots_, maxSamples_;
    std::uint32_t passBegin_ = 0, passEnd_ = 1;    // the samples of the pass under way
    std::uint32_t firstSlot_ = 0;                  // of the run of slots under way
    std::uint32_t runSlots_ = 0, runSamples_ = 0;  // its size, and the most samples in one dispatch
    std::uint32_t nextSample_ = 0;
    std::vector<WorkRange> retries_;
};

}  // namespace duolux

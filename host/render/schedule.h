#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace duolux {

/// A range of work: samples [firstSample, firstSample + samples) of the slots [firstSlot, firstSlot + slots).
struct WorkRange {
    std::uint32_t firstSlot = 0, slots = 0;
    std::uint32_t firstSample = 0, samples = 0;
    bool again = false;  ///< was handed out before, or a larger range was that it is a part of

    std::uint64_t size() const { return std::uint64_t{slots} * samples; }
};

/// A dispatch should take about this long: short enough for watchdogs and a prompt stop, long enough to hide
/// its cost.
inline constexpr double kDispatchSeconds = 0.1;

/// What a schedule is asked for.
enum class Wanted : std::uint8_t {
    kAll,
    kFirstPass,  ///< the first sample of every slot, which everything else can do without
    kRetries     ///< only what is to be traced again, so that no slot's samples have gaps
};

/// Cuts the work into dispatches: a first pass of one sample for every slot, then passes of several, each in
/// runs of slots whose size follows the measured speed. What is stopped early has about as many samples
/// everywhere.
class Schedule {
  public:
    /// Samples [firstSample, endSample) of every slot. At most maxSlots slots and maxSamples samples of a
    /// slot in one dispatch.
    Schedule(std::uint32_t slots, std::uint32_t firstSample, std::uint32_t endSample, std::uint32_t maxSlots,
             std::uint32_t maxSamples);

    /// Goes on from a state in which so many samples of each slot have been taken, from firstSample on.
    /// Before anything was handed out.
    void resume(std::span<const std::uint32_t> taken);

    /// The next range, of at most `laneSamples` samples of a slot; nothing when all have been handed out.
    /// `secondsPerSample`: measured so far, 0: not yet.
    std::optional<WorkRange> next(double secondsPerSample, std::uint32_t laneSamples, Wanted wanted);

    /// Takes back a range that was handed out and has to be traced again.
    void retry(WorkRange range);

    /// A range that was handed out has been traced.
    void traced(const WorkRange& range) { unsettled_ -= range.again ? range.size() : 0; }

    /// Nothing is to be traced again, so that no slot's samples have gaps among those that have been traced.
    bool settled() const { return unsettled_ == 0; }

  private:
    void chooseRun(double secondsPerSample);
    std::optional<WorkRange> take(std::vector<WorkRange>& waiting, std::uint32_t laneSamples,
                                  Wanted wanted) const;

    std::uint32_t slots_, firstSample_, endSample_, maxSlots_, maxSamples_;
    std::uint32_t passBegin_, passEnd_;            // the samples of the pass under way
    std::uint32_t firstSlot_ = 0;                  // of the run of slots under way
    std::uint32_t runSlots_ = 0, runSamples_ = 0;  // its size, and the most samples in one dispatch
    std::uint32_t nextSample_;
    std::uint64_t unsettled_ = 0;              // samples of slots that are to be traced again
    std::vector<WorkRange> retries_, behind_;  // behind_: what slots lack of what others have had
};

}  // namespace duolux

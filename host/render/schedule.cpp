#include "host/render/schedule.h"

#include <algorithm>
#include <cmath>

namespace duolux {

namespace {

constexpr std::uint32_t kFirstSlots = 256;  // before any speed is known
constexpr std::uint32_t kGranularity = 64;  // runs are multiples of so many slots

}  // namespace

Schedule::Schedule(std::uint32_t slots, std::uint32_t spp, std::uint32_t maxSlots, std::uint32_t maxSamples)
    : slots_(slots), spp_(spp), maxSlots_(maxSlots), maxSamples_(maxSamples) {}

void Schedule::chooseRun(double secondsPerSample) {
    double slots = kFirstSlots;
    runSamples_ = std::min(maxSamples_, passEnd_ - passBegin_);
    if (secondsPerSample > 0.0) {
        const double samples = kDispatchSeconds / secondsPerSample;  // in one dispatch
        runSamples_ = static_cast<std::uint32_t>(
            std::clamp(std::floor(samples / kGranularity), 1.0, static_cast<double>(runSamples_)));
        slots = std::max(std::floor(samples / runSamples_ / kGranularity), 1.0) * kGranularity;
    }
    runSlots_ = static_cast<std::uint32_t>(
        std::min({slots, static_cast<double>(maxSlots_), static_cast<double>(slots_ - firstSlot_)}));
}

std::optional<WorkRange> Schedule::next(double secondsPerSample, std::uint32_t laneSamples,
                                        bool firstPassOnly) {
    for (std::size_t i = 0; i < retries_.size(); ++i) {
        WorkRange& waiting = retries_[i];
        if (firstPassOnly && waiting.firstSample > 0) continue;
        WorkRange range = waiting;
        range.samples = std::min(range.samples, laneSamples);
        waiting.firstSample += range.samples;
        waiting.samples -= range.samples;
        if (waiting.samples == 0) retries_.erase(retries_.begin() + static_cast<std::ptrdiff_t>(i));
        return range;
    }
    if (passBegin_ >= spp_ || (firstPassOnly && passBegin_ > 0)) return std::nullopt;
    if (nextSample_ == passBegin_) chooseRun(secondsPerSample);
    const WorkRange range{firstSlot_, runSlots_, nextSample_,
                          std::min({runSamples_, laneSamples, passEnd_ - nextSample_})};
    nextSample_ += range.samples;
    if (nextSample_ == passEnd_) {
        firstSlot_ += runSlots_;
        if (firstSlot_ == slots_) {
            firstSlot_ = 0;
            passBegin_ = passEnd_;
            passEnd_ += std::min(maxSamples_, spp_ - passBegin_);
        }
        nextSample_ = passBegin_;
    }
    return range;
}

}  // namespace duolux

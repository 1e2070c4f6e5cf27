#include "host/render/schedule.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace duolux {

namespace {

constexpr std::uint32_t kFirstPixels = 256;    // size of a run before the speed is known
constexpr std::uint32_t kGranularity = 64;     // the size of a run is a multiple of this
constexpr std::uint32_t kBehindPixels = 2048;  // pixels in a resumed range

}  // namespace

Schedule::Schedule(std::uint32_t pixels, SampleRange samples, std::uint32_t maxPixels,
                   std::uint32_t maxSamples)
    : pixels_(pixels),
      firstSample_(samples.begin),
      endSample_(samples.end),
      maxPixels_(maxPixels),
      maxSamples_(maxSamples),
      passBegin_(samples.begin),
      passEnd_(samples.begin + 1),
      nextSample_(samples.begin) {}

void Schedule::retry(WorkRange range) {
    if (!range.again) unsettled_ += range.size();
    range.again = true;
    retries_.push_back(range);
}

void Schedule::resume(std::span<const std::uint32_t> taken) {
    const std::uint32_t wanted = endSample_ - firstSample_;
    const std::uint32_t most = std::min(*std::max_element(taken.begin(), taken.end()), wanted);
    if (most == 0) return;
    for (std::uint32_t begin = 0; begin < pixels_;) {
        std::uint32_t end = begin + 1;
        while (end < pixels_ && end - begin < std::min(kBehindPixels, maxPixels_) &&
               taken[end] == taken[begin])
            ++end;
        for (std::uint32_t s = taken[begin]; s < most; s += maxSamples_)
            behind_.push_back({begin, end - begin, firstSample_ + s, std::min(maxSamples_, most - s)});
        begin = end;
    }
    std::reverse(behind_.begin(), behind_.end());  // taken from the back
    passBegin_ = nextSample_ = firstSample_ + most;
    passEnd_ = passBegin_ + std::min(maxSamples_, endSample_ - passBegin_);
}

void Schedule::chooseRun(double secondsPerSample) {
    double pixels = kFirstPixels;
    runSamples_ = std::min(maxSamples_, passEnd_ - passBegin_);
    if (secondsPerSample > 0.0) {
        const double samples = kDispatchSeconds / secondsPerSample;  // in one dispatch
        runSamples_ = static_cast<std::uint32_t>(
            std::clamp(std::floor(samples / kGranularity), 1.0, static_cast<double>(runSamples_)));
        pixels = std::max(std::floor(samples / runSamples_ / kGranularity), 1.0) * kGranularity;
    }
    runPixels_ = static_cast<std::uint32_t>(
        std::min({pixels, static_cast<double>(maxPixels_), static_cast<double>(pixels_ - firstPixel_)}));
}

std::optional<WorkRange> Schedule::take(std::vector<WorkRange>& waiting, std::uint32_t laneSamples,
                                        Wanted wanted) const {
    const auto fits = [&](const WorkRange& w) {
        return wanted != Wanted::kFirstPass || w.firstSample == firstSample_;
    };
    const auto found = std::find_if(waiting.rbegin(), waiting.rend(), fits);
    if (found == waiting.rend()) return std::nullopt;
    WorkRange range = *found;
    range.samples = std::min({range.samples, laneSamples, wanted == Wanted::kFirstPass ? 1u : range.samples});
    found->firstSample += range.samples;
    found->samples -= range.samples;
    if (found->samples == 0) waiting.erase(std::next(found).base());
    return range;
}

std::optional<WorkRange> Schedule::next(double secondsPerSample, std::uint32_t laneSamples, Wanted wanted) {
    // Retries are handed out in every mode, because they leave gaps.
    if (const auto range = take(retries_, laneSamples, Wanted::kAll)) return range;
    if (wanted == Wanted::kRetries) return std::nullopt;
    if (const auto range = take(behind_, laneSamples, wanted)) return range;
    if (passBegin_ >= endSample_ || (wanted == Wanted::kFirstPass && passBegin_ > firstSample_))
        return std::nullopt;
    if (nextSample_ == passBegin_) chooseRun(secondsPerSample);
    const WorkRange range{firstPixel_, runPixels_, nextSample_,
                          std::min({runSamples_, laneSamples, passEnd_ - nextSample_})};
    nextSample_ += range.samples;
    if (nextSample_ == passEnd_) {
        firstPixel_ += runPixels_;
        if (firstPixel_ == pixels_) {
            firstPixel_ = 0;
            passBegin_ = passEnd_;
            passEnd_ += std::min(maxSamples_, endSample_ - passBegin_);
        }
        nextSample_ = passBegin_;
    }
    return range;
}

}  // namespace duolux

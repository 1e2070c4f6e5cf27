#include "host/render/render.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "host/base/error.h"
#include "host/gpu/device_scene.h"
#include "host/render/path_kernel.h"
#include "host/render/pixel_order.h"

namespace duolux {

namespace {

using Clock = std::chrono::steady_clock;

double secondsSince(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

// A dispatch should take about this long: short enough for watchdogs and a prompt stop, long enough to hide
// its cost.
constexpr double kDispatchSeconds = 0.1;

/// Cuts the work into dispatches: a first pass of one sample for every pixel, then passes of several, each
/// pass in runs of pixels whose size follows the measured speed. What is stopped early has about as many
/// samples everywhere.
class Schedule {
  public:
    Schedule(std::uint32_t slots, std::uint32_t spp, std::uint32_t maxSlots, std::uint32_t maxSamples)
        : slots_(slots), spp_(spp), maxSlots_(maxSlots), maxSamples_(maxSamples) {}

    bool done() const { return firstSample_ >= spp_; }
    bool inFirstPass() const { return firstSample_ == 0; }

    /// The next range; secondsPerSample <= 0: not known yet.
    WorkRange next(double secondsPerSample) {
        const WorkRange range{firstSlot_, chooseSlots(secondsPerSample * samples_), firstSample_, samples_};
        firstSlot_ += range.slots;
        if (firstSlot_ == slots_) {
            firstSlot_ = 0;
            firstSample_ += samples_;
            samples_ = std::min(maxSamples_, spp_ - firstSample_);
        }
        return range;
    }

    /// Takes at most so many samples of a pixel in one dispatch, from the next pass on.
    void limitSamples(std::uint32_t samples) { maxSamples_ = std::min(maxSamples_, samples); }

  private:
    std::uint32_t chooseSlots(double secondsPerSlot) const {
        constexpr double kUnit = 256.0;  // so that few teams of lanes have less than a full share
        double slots = secondsPerSlot > 0.0 ? kDispatchSeconds / secondsPerSlot : 4.0 * kUnit;
        slots = std::max(std::floor(slots / kUnit), 1.0) * kUnit;
        return static_cast<std::uint32_t>(
            std::min({slots, static_cast<double>(maxSlots_), static_cast<double>(slots_ - firstSlot_)}));
    }

    std::uint32_t slots_, spp_, maxSlots_, maxSamples_;
    std::uint32_t firstSample_ = 0, samples_ = 1;  // the pass under way
    std::uint32_t firstSlot_ = 0;
};

class Renderer {
  public:
    Renderer(Device& device, const Scene& scene, const RenderControl& control)
        : device_(device),
          scene_(scene),
          control_(control),
          pixels_(pixelOrder(scene.render.width, scene.render.height)),
          deviceScene_(uploadScene(device, scene)),
          film_(scene.render.width, scene.render.height, deviceScene_.quantum) {}

    RenderOutput run() {
        const Clock::time_point pipelineStart = Clock::now();
        const std::uint32_t maxSlots = std::min<std::uint32_t>(
            static_cast<std::uint32_t>(pixels_.size()),
            control_.maxPixelsPerDispatch > 0 ? control_.maxPixelsPerDispatch : kMaxSlots);
        PathKernel kernel(device_, deviceScene_, scene_, pixels_, maxSlots);
        statistics_.pipelineSeconds = secondsSince(pipelineStart);
        statistics_.buildSeconds = deviceScene_.buildSeconds;
        statistics_.uploadSeconds = deviceScene_.uploadSeconds;
        statistics_.effectiveBounces = deviceScene_.traits.effectiveBounces;
        statistics_.deviceBytes = deviceScene_.deviceBytes() + kernel.deviceBytes();

        trace(kernel);

        const double samples = static_cast<double>(std::max<std::uint64_t>(statistics_.samples, 1));
        statistics_.lastBounceRadiance = lastBounce_ / samples;
        statistics_.previousBounceRadiance = previousBounce_ / samples;
        statistics_.meanRadiance = meanDisplayed();
        statistics_.filmOverflowed = film_.overflowed() || clamped_;
        return {std::move(film_), statistics_};
    }

  private:
    static constexpr std::uint32_t kMaxSlots = 1u << 18;

    void trace(PathKernel& kernel) {
        const std::uint32_t maxSamples =
            control_.maxSamplesPerDispatch > 0
                ? std::min(PathKernel::kMaxSamples, control_.maxSamplesPerDispatch)
                : PathKernel::kMaxSamples;
        Schedule schedule(static_cast<std::uint32_t>(pixels_.size()), scene_.render.spp, kernel.maxSlots(),
                          maxSamples);
        start_ = lastReceived_ = Clock::now();
        unsigned submitted = 0;
        unsigned received = 0;
        std::vector<WorkRange> cutShort;
        for (;;) {
            // Keep two dispatches in flight, so that the device works while the host adds up.
            while (submitted - received < 2 && !schedule.done() && !statistics_.stopped) {
                if (outOfTime(schedule, secondsSince(start_))) {
                    statistics_.stopped = true;
                    break;
                }
                kernel.submit(submitted++ % 2, schedule.next(secondsPerSample_));
            }
            if (submitted == received) break;
            if (const std::optional<WorkRange> cut = receive(kernel, received++ % 2)) {
                cutShort.push_back(*cut);
                schedule.limitSamples(kernel.teamSamples());
            }
            if (!statistics_.stopped) reportProgress();
        }
        for (const WorkRange& range : cutShort)
            redo(kernel, range);
        reportProgress();
    }

    bool outOfTime(const Schedule& schedule, double elapsed) const {
        return control_.timeLimit && !schedule.inFirstPass() &&
               elapsed + kDispatchSeconds > *control_.timeLimit;
    }

    /// Waits for a dispatch and adds up what it has traced; or returns what the driver has cut short, to be
    /// traced again with a smaller share for each team.
    std::optional<WorkRange> receive(PathKernel& kernel, unsigned lane) {
        const PathKernel::Results results = kernel.wait(lane);
        if (statistics_.dispatches++ == 0) statistics_.firstDispatchSeconds = secondsSince(start_);
        statistics_.longestDispatchSeconds =
            std::max(statistics_.longestDispatchSeconds, results.deviceSeconds);
        statistics_.deviceSeconds += results.deviceSeconds;
        // Without timestamps the time since the last dispatch came back has to do.
        const Clock::time_point now = Clock::now();
        const double measured = results.deviceSeconds > 0.0
                                    ? results.deviceSeconds
                                    : std::chrono::duration<double>(now - lastReceived_).count();
        lastReceived_ = now;
        const double seconds = measured / static_cast<double>(results.range.size());
        secondsPerSample_ = secondsPerSample_ > 0.0 ? 0.5 * (secondsPerSample_ + seconds) : seconds;
        if (results.complete) {
            add(results);
            return std::nullopt;
        }
        if (results.teamSamples == 1) {
            throw MachineError(
                fmt::format("tracing paths failed on {} ({}): the driver cut a single path short; render "
                            "with fewer bounces than {}",
                            device_.info().name, device_.info().driver, scene_.render.bounces));
        }
        kernel.limitTeamSamples(std::min(kernel.teamSamples(), results.teamSamples / 2));
        ++statistics_.dispatchesCutShort;
        return results.range;
    }

    /// Some drivers end all loops of an invocation after a fixed number of iterations, without a word. A
    /// dispatch that this happened to is thrown away and traced again.
    void redo(PathKernel& kernel, WorkRange range) {
        while (range.samples > 0) {
            reportProgress();
            if (statistics_.stopped) return;
            WorkRange part = range;
            part.samples = std::min(range.samples, kernel.teamSamples());
            kernel.submit(0, part);
            if (receive(kernel, 0)) continue;
            range.firstSample += part.samples;
            range.samples -= part.samples;
        }
    }

    /// Tells the caller, who may stop the render.
    void reportProgress() {
        statistics_.renderSeconds = secondsSince(start_);
        if (!control_.onProgress) return;
        const RenderProgress progress{statistics_.samples, std::uint64_t{scene_.render.spp} * pixels_.size(),
                                      statistics_.renderSeconds};
        const bool finished = progress.samplesDone == progress.samplesTotal;
        if (!control_.onProgress(progress) && !finished) statistics_.stopped = true;
    }

    void add(const PathKernel::Results& results) {
        sums_.resize(results.slots.size());
        const auto number = [](std::uint32_t low, std::uint32_t high) {
            return static_cast<std::int64_t>(std::uint64_t{high} << 32 | low);
        };
        for (std::size_t i = 0; i < results.slots.size(); ++i) {
            const shared::SlotResult& r = results.slots[i];
            for (std::size_t c = 0; c < 3; ++c) {
                sums_[i].invisible[c] = number(r.invisible[2 * c], r.invisible[2 * c + 1]);
                sums_[i].visible[c] = number(r.visible[2 * c], r.visible[2 * c + 1]);
            }
            statistics_.nonFiniteSamples += r.nonFinite;
            clamped_ = clamped_ || r.clamped > 0;
            statistics_.cameraRays += r.cameraRays;
            statistics_.bounceRays += r.bounceRays;
            statistics_.shadowRays += r.shadowRays;
            statistics_.emitterRays += r.emitterRays;
            lastBounce_ += static_cast<double>(r.lastBounce);
            previousBounce_ += static_cast<double>(r.previousBounce);
        }
        const std::span<const std::uint32_t> pixels(pixels_.data() + results.range.firstSlot,
                                                    results.range.slots);
        film_.add(pixels, sums_, results.range.samples);
        statistics_.samples += results.range.size();
    }

    double meanDisplayed() const {
        const RadianceImage image = film_.resolve();
        double total = 0.0;
        for (const glm::vec3& c : image.displayed(scene_.display))
            total += (static_cast<double>(c.x) + static_cast<double>(c.y) + static_cast<double>(c.z)) / 3.0;
        return total / static_cast<double>(pixels_.size());
    }

    Device& device_;
    const Scene& scene_;
    const RenderControl& control_;
    std::vector<std::uint32_t> pixels_;
    DeviceScene deviceScene_;
    Film film_;
    RenderStatistics statistics_;
    Clock::time_point start_, lastReceived_;
    double secondsPerSample_ = 0.0;
    bool clamped_ = false;
    double lastBounce_ = 0.0, previousBounce_ = 0.0;
    std::vector<Film::PixelSum> sums_;
};

}  // namespace

bool RenderStatistics::stillGrowing() const {
    return lastBounceRadiance > 0.01 * std::abs(meanRadiance);
}

RenderOutput render(Device& device, const Scene& scene, const RenderControl& control) {
    return Renderer(device, scene, control).run();
}

}  // namespace duolux

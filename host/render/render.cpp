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
        const bool closedForm = chooseClosedForm();
        PathKernel kernel(device_, deviceScene_, scene_, pixels_, maxSlots, closedForm);
        statistics_.directLightInClosedForm = closedForm;
        statistics_.pipelineSeconds = secondsSince(pipelineStart);
        statistics_.buildSeconds = deviceScene_.buildSeconds;
        statistics_.uploadSeconds = deviceScene_.uploadSeconds;
        statistics_.effectiveBounces = deviceScene_.traits.effectiveBounces;
        statistics_.limitedByBounces = deviceScene_.traits.limitedByBounces;
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

    bool chooseClosedForm() const {
        const bool applies = deviceScene_.closedFormApplies;
        if (control_.directLight == DirectLight::kClosedForm && !applies) {
            throw UsageError(fmt::format(
                "{}: direct light has no closed form here; it needs surfaces that hide nothing (`local`, "
                "`shadowless`), flat normals, and from 1 to {} emitting triangles",
                scene_.source.string(), kMostClosedFormLights));
        }
        // Where light is reflected again and again, direct light is a small part of the noise: on the Cornell
        // box `shadowless` in closed form has 7 % less variance, and takes 10 % longer.
        const bool pays = !deviceScene_.traits.invisibleScatters;
        return applies && (control_.directLight == DirectLight::kClosedForm ||
                           (pays && control_.directLight == DirectLight::kAuto));
    }

    void trace(PathKernel& kernel) {
        const std::uint32_t maxSamples =
            control_.maxSamplesPerDispatch > 0
                ? std::min(PathKernel::kMaxSamples, control_.maxSamplesPerDispatch)
                : PathKernel::kMaxSamples;
        Schedule schedule(static_cast<std::uint32_t>(pixels_.size()), scene_.render.spp, kernel.maxSlots(),
                          maxSamples);
        if (control_.maxSamplesPerLane > 0) kernel.limitLaneSamples(control_.maxSamplesPerLane);
        start_ = lastReceived_ = Clock::now();
        unsigned submitted = 0;
        unsigned received = 0;
        bool timeIsUp = false;
        for (;;) {
            // Keep two dispatches in flight, so that the device works while the host adds up.
            while (submitted - received < 2 && !statistics_.stopped) {
                timeIsUp = timeIsUp || (control_.timeLimit &&
                                        secondsSince(start_) + kDispatchSeconds > *control_.timeLimit);
                const auto range = schedule.next(secondsPerSample_, kernel.laneSamples(), timeIsUp);
                if (!range) break;
                kernel.submit(submitted++ % 2, *range);
            }
            if (submitted == received) break;
            if (const auto range = receive(kernel, received++ % 2)) schedule.retry(*range);
            reportProgress();
        }
        statistics_.stopped = statistics_.samples < std::uint64_t{scene_.render.spp} * pixels_.size();
        reportProgress();
    }

    /// Waits for a dispatch and adds up what it has traced; or returns what the driver has cut short, to be
    /// traced again with a smaller share for each team.
    std::optional<WorkRange> receive(PathKernel& kernel, unsigned place) {
        const PathKernel::Results results = kernel.wait(place);
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
        // Some drivers end all loops of an invocation after a fixed number of iterations, without a word.
        // What this happened to is thrown away and traced again.
        if (results.laneSamples == 1) {
            throw MachineError(fmt::format(
                "tracing paths failed on {} ({}): the driver ended the loops of a single path; render "
                "with fewer bounces than {}, or with fewer surfaces that light passes through",
                device_.info().name, device_.info().driver, scene_.render.bounces));
        }
        kernel.limitLaneSamples(results.laneSamples / 2);
        ++statistics_.dispatchesCutShort;
        return results.range;
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

bool RenderStatistics::cutOffByBounces() const {
    const double negligible = 0.01 * std::abs(meanRadiance);
    if (!limitedByBounces || effectiveBounces == 0) return false;
    if (lastBounceRadiance > negligible) return true;
    // Between parallel surfaces only every other bounce may reach the camera: a term that vanishes all at
    // once says nothing of the next.
    return effectiveBounces > 2 && previousBounceRadiance > negligible &&
           lastBounceRadiance < 0.01 * previousBounceRadiance;
}

RenderOutput render(Device& device, const Scene& scene, const RenderControl& control) {
    return Renderer(device, scene, control).run();
}

}  // namespace duolux

#include <fmt/format.h>

#include <algorithm>

#include "host/base/error.h"
#include "host/render/context.h"
#include "host/render/film_quantum.h"
#include "host/render/path_tracer_kernel.h"
#include "host/render/pixel_order.h"

namespace duolux {

namespace {

class PathTracer {
  public:
    explicit PathTracer(RenderContext& context)
        : context_(context), pixels_(pixelOrder(context.film.width(), context.film.height())) {}

    void run() {
        const Clock::time_point pipelineStart = Clock::now();
        const RenderControl& control = context_.control;
        RenderStatistics& statistics = context_.statistics;
        const std::uint32_t maxPixels = std::min<std::uint32_t>(static_cast<std::uint32_t>(pixels_.size()),
                                                                control.limits.maxPixelsPerDispatch > 0
                                                                    ? control.limits.maxPixelsPerDispatch
                                                                    : PathTracerKernel::kMaxPixels);
        statistics.directLightInClosedForm = chooseClosedForm();
        context_.stage("creating kernels");
        PathTracerKernel kernel(context_.inputs(), pixels_, maxPixels, statistics.directLightInClosedForm);
        statistics.pipelineSeconds = secondsSince(pipelineStart);
        statistics.deviceBytes = context_.deviceScene.deviceBytes() + kernel.deviceBytes();
        trace(kernel);
    }

  private:
    bool chooseClosedForm() const {
        const bool applies = context_.deviceScene.transport.closedFormApplies;
        const DirectLight wanted = context_.control.directLight;
        if (wanted == DirectLight::kClosedForm && !applies) {
            throw UsageError(
                fmt::format("{}: direct light has no closed form in this scene; it requires diffuse surfaces "
                            "that cast no shadows (`local`, `shadowless`), flat normals, and 1 to {} "
                            "emitters (triangles, point lights)",
                            context_.scene.source.string(), kMostClosedFormEmitters));
        }
        // With several bounces, direct light contributes little of the noise: on the Cornell box,
        // `shadowless` in closed form has 7 % less variance and takes 10 % longer.
        const bool pays = !context_.deviceScene.transport.traits.invisibleScatters;
        return applies && (wanted == DirectLight::kClosedForm || (pays && wanted == DirectLight::kAuto));
    }

    void trace(PathTracerKernel& kernel) {
        const RenderControl& control = context_.control;
        RenderStatistics& statistics = context_.statistics;
        const std::uint32_t maxSamples =
            control.limits.maxSamplesPerDispatch > 0
                ? std::min(PathTracerKernel::kMaxSamples, control.limits.maxSamplesPerDispatch)
                : PathTracerKernel::kMaxSamples;
        Schedule schedule(static_cast<std::uint32_t>(pixels_.size()), context_.range, kernel.maxPixels(),
                          maxSamples);
        if (context_.samplesResumed > 0) schedule.resume(samplesOfPixels());
        if (control.limits.maxSamplesPerLane > 0) kernel.limitLaneSamples(control.limits.maxSamplesPerLane);
        statistics.lanePaths = kernel.laneSamples();
        context_.begin();
        context_.stage("taking a first look");
        if (control.resume == nullptr) context_.film.setQuantum(chooseQuantum(kernel));
        unsigned submitted = 0;
        unsigned received = 0;
        bool timeIsUp = false;
        for (;;) {
            // Two dispatches are kept in flight, so that the device works while the host sums results.
            while (submitted - received < 2) {
                timeIsUp = timeIsUp || context_.timeIsUp();
                Wanted wanted = timeIsUp ? Wanted::kFirstPass : Wanted::kAll;
                if (statistics.stopped) wanted = Wanted::kRetries;
                const auto range = schedule.next(context_.secondsPerSample, kernel.laneSamples(), wanted);
                if (!range) break;
                kernel.submit(submitted++ % 2, *range, context_.film.quantum());
            }
            if (submitted == received) break;
            receive(kernel, received++ % 2, schedule);
            statistics.gaps = !schedule.settled();
            context_.reportProgress();
            if (schedule.settled()) context_.offerCheckpoint();
        }
        statistics.stopped = statistics.samples < context_.samplesTotal();
        context_.reportProgress();
    }

    /// Chooses the quantum by the first samples of a few pixels, which do not depend on the range of samples
    /// to be traced.
    float chooseQuantum(PathTracerKernel& kernel) {
        constexpr std::uint32_t kSamples = 4096;
        const std::uint32_t end = kernel.firstLookPixel() + kernel.lookPixels();
        const std::uint32_t wanted = std::min(PathTracerKernel::kMaxSamples, kSamples / kernel.lookPixels());
        return findQuantum(context_.deviceScene.transport.brightestEmission, [&](float quantum) {
            FirstLook sum;
            WorkRange range{kernel.firstLookPixel(), 0, 0, 1};
            while (range.firstSample < wanted) {
                range.pixels = std::min(kernel.maxPixels(), end - range.firstPixel);
                kernel.submit(0, range, quantum);
                const PathTracerKernel::Results results = kernel.wait(0);
                context_.received(results.deviceSeconds, range.size());
                if (!results.complete) {
                    takeLess(kernel, results);
                    continue;
                }
                const FirstLook look = kernel.look(0);
                sum.invisible += look.invisible;
                sum.visible += look.visible;
                sum.samples += look.samples;
                sum.clamped = sum.clamped || look.clamped;
                range.firstPixel += range.pixels;
                if (range.firstPixel < end) continue;
                range.firstPixel = kernel.firstLookPixel();
                ++range.firstSample;
            }
            return sum;
        });
    }

    /// Reduces the work per lane. Some drivers silently end the loops of an invocation after a fixed number
    /// of iterations.
    void takeLess(PathTracerKernel& kernel, const PathTracerKernel::Results& results) {
        if (results.laneSamples == 1) context_.failCutShort();
        kernel.limitLaneSamples(results.laneSamples / 2);
        ++context_.statistics.dispatchesCutShort;
    }

    std::vector<std::uint32_t> samplesOfPixels() const {
        std::vector<std::uint32_t> samples;
        samples.reserve(pixels_.size());
        for (std::uint32_t pixel : pixels_)
            samples.push_back(context_.film.samplesOf(pixel));
        return samples;
    }

    /// Waits for a dispatch and adds its results. If the driver ended its loops early, the dispatch is traced
    /// again with less work per team.
    void receive(PathTracerKernel& kernel, unsigned slot, Schedule& schedule) {
        const PathTracerKernel::Results results = kernel.wait(slot);
        context_.received(results.deviceSeconds, results.range.size());
        if (results.complete) {
            add(kernel.addTo(context_.film, slot), results.range);
            schedule.traced(results.range);
            return;
        }
        takeLess(kernel, results);
        schedule.retry(results.range);
    }

    void add(const PathTracerKernel::Totals& totals, const WorkRange& range) {
        RenderStatistics& statistics = context_.statistics;
        statistics.samples += range.size();
        statistics.nonFiniteSamples += totals.nonFinite;
        statistics.filmOverflowed = statistics.filmOverflowed || totals.clamped;
        statistics.cameraRays += totals.cameraRays;
        statistics.bounceRays += totals.bounceRays;
        statistics.shadowRays += totals.shadowRays;
        statistics.emitterRays += totals.emitterRays;
        context_.lastBounce += totals.lastBounce;
        context_.previousBounce += totals.previousBounce;
    }

    RenderContext& context_;
    std::vector<std::uint32_t> pixels_;
};

}  // namespace

void tracePaths(RenderContext& context) {
    context.stage("ordering pixels");
    PathTracer(context).run();
}

}  // namespace duolux

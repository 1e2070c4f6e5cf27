#include <algorithm>

#include "host/render/context.h"
#include "host/render/film_quantum.h"
#include "host/render/light_tracer_kernel.h"
#include "host/render/schedule.h"

namespace duolux {

namespace {

// Light paths are traced in batches of a few dispatches, all of which add to one film on the device. A batch
// whose dispatches were all complete is added to the film of the render; if the driver cut one short, the
// batch is discarded and traced again with less work per lane.
class LightTracer {
  public:
    explicit LightTracer(RenderContext& context) : context_(context) {}

    void run() {
        const Clock::time_point pipelineStart = Clock::now();
        const RenderControl& control = context_.control;
        RenderStatistics& statistics = context_.statistics;
        const std::uint32_t maxPaths =
            control.limits.maxPixelsPerDispatch > 0 ? control.limits.maxPixelsPerDispatch : kMaxPaths;
        context_.stage("creating kernels");
        LightTracerKernel kernel(context_.inputs(), maxPaths, control.limits);
        if (control.limits.maxSamplesPerLane > 0) kernel.limitLanePaths(control.limits.maxSamplesPerLane);
        statistics.lanePaths = kernel.lanePaths();
        statistics.pipelineSeconds = secondsSince(pipelineStart);
        statistics.deviceBytes = context_.deviceScene.deviceBytes() + kernel.deviceBytes();
        trace(kernel);
    }

  private:
    static constexpr std::uint32_t kMaxPaths = 1u << 18;  // of one dispatch
    static constexpr std::uint32_t kFirstPaths = 512;     // before any speed is known
    static constexpr std::uint32_t kMostDispatches = 16;  // of one batch: a second or two
    // Of one batch: the largest mean that a pixel may have (2^58 quanta a path) then fits 63 bits.
    static constexpr std::uint64_t kMostPathsPerPixel = 32;

    /// Exact, so that a sum over lanes does not depend on which lane traced which path.
    __extension__ using Int128 = __int128;

    /// What a batch adds to the statistics.
    struct Batch {
        std::uint64_t paths = 0;
        std::uint64_t nonFinite = 0, lightRays = 0, bounceRays = 0, shadowRays = 0;
        Int128 lastBounce = 0, previousBounce = 0;  // in units of shared::kStatisticsQuanta
        bool clamped = false;
        bool complete = true;
    };

    void trace(LightTracerKernel& kernel) {
        RenderStatistics& statistics = context_.statistics;
        context_.begin();
        context_.stage("taking a first look");
        // Without emitters, all paths are dark.
        if (context_.deviceScene.transport.emitterChoices == 0) {
            context_.film.countLightPaths(context_.samplesTotal());
            statistics.samples = context_.samplesTotal();
        } else if (context_.control.resume == nullptr) {
            context_.film.setQuantum(chooseQuantum(kernel));
        }
        std::uint32_t dispatches = 1;
        while (statistics.samples < context_.samplesTotal() && !statistics.stopped && !finishEarly(0)) {
            const Batch batch = traceBatch(kernel, dispatches);
            if (batch.complete) {
                takeOver(kernel, batch);
                dispatches = std::min(2 * dispatches, kMostDispatches);
            } else {
                kernel.clearFilm();
                dispatches = 1;
            }
            context_.reportProgress();
            context_.offerCheckpoint();
        }
        statistics.stopped = statistics.samples < context_.samplesTotal();
        context_.reportProgress();
    }

    /// Chooses the quantum by the first paths of the whole render, which do not depend on the range of paths
    /// to be traced.
    float chooseQuantum(LightTracerKernel& kernel) {
        constexpr std::uint64_t kPaths = 4096;
        return findQuantum(context_.deviceScene.transport.brightestEmission, [&](float quantum) {
            FirstLook look;
            while (look.samples < kPaths) {
                const std::uint32_t count = dispatchPaths(kernel, kPaths - look.samples);
                kernel.submit(0, {look.samples, count}, quantum);
                const LightTracerKernel::Results results = kernel.wait(0);
                context_.received(results.deviceSeconds, count);
                if (!results.complete) {
                    takeLess(kernel, results);
                    continue;
                }
                look.samples += count;
                for (const shared::LaneResult& lane : results.lanes) {
                    const auto sum = [](const std::uint32_t(&words)[2]) {
                        return static_cast<double>(signed64(words[0], words[1])) *
                               static_cast<double>(shared::kStatisticsQuanta);
                    };
                    look.invisible += sum(lane.invisible);
                    look.visible += sum(lane.visible);
                    look.clamped = look.clamped || lane.clamped > 0;
                }
            }
            kernel.clearFilm();
            return look;
        });
    }

    void takeLess(LightTracerKernel& kernel, const LightTracerKernel::Results& results) {
        if (results.lanePaths == 1) context_.failCutShort();
        kernel.limitLanePaths(results.lanePaths / 2);
        ++context_.statistics.dispatchesCutShort;
    }

    /// Whether to stop for lack of time. At least one path per pixel is traced. `underWay`: paths of the
    /// batch.
    bool finishEarly(std::uint64_t underWay) const {
        return context_.timeIsUp() && context_.film.lightPaths() + underWay >= context_.pixels();
    }

    /// The number of the first path that has not been traced.
    std::uint64_t nextPath() const {
        return context_.range.begin * context_.pixels() + context_.film.lightPaths();
    }

    std::uint32_t dispatchPaths(const LightTracerKernel& kernel, std::uint64_t left) const {
        double paths = kFirstPaths;
        if (context_.secondsPerSample > 0.0)
            paths = std::max(kDispatchSeconds / context_.secondsPerSample, 64.0);
        return static_cast<std::uint32_t>(
            std::min({paths, static_cast<double>(kernel.maxPaths()), static_cast<double>(left)}));
    }

    Batch traceBatch(LightTracerKernel& kernel, std::uint32_t dispatches) {
        Batch batch;
        const std::uint64_t end = nextPath() + context_.samplesTotal() - context_.statistics.samples;
        const std::uint64_t begin = nextPath();
        const std::uint64_t batchEnd = std::min(end, begin + kMostPathsPerPixel * context_.pixels());
        std::uint64_t next = begin;
        unsigned submitted = 0;
        unsigned received = 0;
        for (;;) {
            // Two dispatches are kept in flight, so that the device never waits.
            while (submitted - received < 2 && submitted < dispatches && next < batchEnd && batch.complete &&
                   !(submitted > 0 && (context_.statistics.stopped || finishEarly(next - begin)))) {
                const PathRange range{next, dispatchPaths(kernel, batchEnd - next)};
                kernel.submit(submitted++ % 2, range, context_.film.quantum());
                next += range.count;
            }
            if (submitted == received) return batch;
            receive(kernel, received++ % 2, batch);
            if (batch.complete) context_.reportProgress(batch.paths);
        }
    }

    void receive(LightTracerKernel& kernel, unsigned slot, Batch& batch) {
        const LightTracerKernel::Results results = kernel.wait(slot);
        context_.received(results.deviceSeconds, results.range.count);
        if (!results.complete) {
            takeLess(kernel, results);
            batch.complete = false;
            return;
        }
        batch.paths += results.range.count;
        for (const shared::LaneResult& lane : results.lanes) {
            batch.nonFinite += lane.nonFinite;
            batch.lightRays += lane.lightRays;
            batch.bounceRays += lane.bounceRays;
            batch.shadowRays += lane.shadowRays;
            batch.lastBounce += signed64(lane.lastBounce[0], lane.lastBounce[1]);
            batch.previousBounce += signed64(lane.previousBounce[0], lane.previousBounce[1]);
            batch.clamped = batch.clamped || lane.clamped > 0;
        }
    }

    void takeOver(LightTracerKernel& kernel, const Batch& batch) {
        RenderStatistics& statistics = context_.statistics;
        kernel.takeFilm(context_.film, statistics.gaps);
        context_.film.countLightPaths(batch.paths);
        statistics.samples += batch.paths;
        statistics.nonFiniteSamples += batch.nonFinite;
        statistics.lightRays += batch.lightRays;
        statistics.bounceRays += batch.bounceRays;
        statistics.shadowRays += batch.shadowRays;
        statistics.filmOverflowed = statistics.filmOverflowed || batch.clamped;
        const double unit = static_cast<double>(context_.film.quantum() * shared::kStatisticsQuanta);
        context_.lastBounce += static_cast<double>(batch.lastBounce) * unit;
        context_.previousBounce += static_cast<double>(batch.previousBounce) * unit;
        kernel.clearFilm();
    }

    RenderContext& context_;
};

}  // namespace

void traceLightPaths(RenderContext& context) {
    LightTracer(context).run();
}

}  // namespace duolux

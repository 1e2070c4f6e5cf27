#include "host/render/render.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <new>
#include <vector>

#include "host/base/error.h"
#include "host/base/memory.h"
#include "host/render/context.h"
#include "host/render/schedule.h"
#include "host/scene/validate.h"

namespace duolux {

namespace {

double meanDisplayed(const Film& film, glm::vec2 display) {
    const ImageRows rows = film.rows();
    std::vector<glm::vec3> invisible(film.width()), visible(film.width());
    double total = 0.0;
    for (std::uint32_t y = 0; y < film.height(); ++y) {
        rows.read(y, invisible, visible);
        for (std::size_t x = 0; x < film.width(); ++x) {
            const glm::vec3 c = display.x * invisible[x] + display.y * visible[x];
            total += (static_cast<double>(c.x) + static_cast<double>(c.y) + static_cast<double>(c.z)) / 3.0;
        }
    }
    return total / (static_cast<double>(film.width()) * film.height());
}

}  // namespace

const char* nameOf(DirectLight directLight) {
    switch (directLight) {
        case DirectLight::kAuto:
            return "auto";
        case DirectLight::kSampled:
            return "sampled";
        case DirectLight::kClosedForm:
            return "closed-form";
    }
    return "";
}

std::uint64_t RenderContext::samplesTotal() const {
    const std::uint64_t all = range.size() * pixels();
    return all - std::min(all, samplesResumed);
}

bool RenderContext::timeIsUp() const {
    return control.timeLimit && seconds() + kDispatchSeconds > *control.timeLimit;
}

void RenderContext::received(double deviceSeconds, std::uint64_t samples) {
    const Clock::time_point now = Clock::now();
    if (statistics.dispatches++ == 0) statistics.firstDispatchSeconds = seconds();
    statistics.longestDispatchSeconds = std::max(statistics.longestDispatchSeconds, deviceSeconds);
    statistics.deviceSeconds += deviceSeconds;
    // Without timestamps, the time since the previous dispatch finished is used instead.
    const double measured =
        deviceSeconds > 0.0 ? deviceSeconds : std::chrono::duration<double>(now - lastReceived).count();
    lastReceived = now;
    const double each = measured / static_cast<double>(samples);
    secondsPerSample = secondsPerSample > 0.0 ? 0.5 * (secondsPerSample + each) : each;
}

void RenderContext::reportProgress(std::uint64_t underWay) {
    statistics.renderSeconds = seconds();
    if (!control.onProgress) return;
    const RenderProgress progress{statistics.samples + underWay, samplesTotal(), statistics.renderSeconds};
    const bool finished = progress.samplesDone == progress.samplesTotal;
    if (!control.onProgress(progress) && !finished) statistics.stopped = true;
}

void RenderContext::offerCheckpoint() {
    const Clock::time_point now = Clock::now();
    if (!control.onCheckpoint ||
        now - lastCheckpoint < std::chrono::duration<double>(control.checkpointSeconds))
        return;
    summarise();
    control.onCheckpoint(film, statistics);
    lastCheckpoint = Clock::now();
}

void RenderContext::summarise() {
    const double samples =
        static_cast<double>(std::max<std::uint64_t>(samplesResumed + statistics.samples, 1));
    statistics.lastBounceRadiance = lastBounce / samples;
    statistics.previousBounceRadiance = previousBounce / samples;
    statistics.meanRadiance = meanDisplayed(film, scene.display);
    statistics.filmOverflowed = statistics.filmOverflowed || film.overflowed();
}

void RenderContext::failCutShort() const {
    throw DeviceError(fmt::format(
        "tracing paths failed on {} ({}): the driver ended the loops of a single path, which are too long; "
        "expected {}fewer surfaces that overlap, that are slender, or that light passes through, or a driver "
        "without such a limit: of Mesa's lavapipe, 25.0 has none",
        device.info().name, device.info().driver,
        settings.bounces > 0 ? fmt::format("fewer bounces than {}, ", settings.bounces) : ""));
}

bool RenderStatistics::cutOffByBounces() const {
    const double negligible = 0.01 * std::abs(meanRadiance);
    if (!limitedByBounces || effectiveBounces == 0) return false;
    if (lastBounceRadiance > negligible) return true;
    // Between parallel surfaces, only every second bounce may reach the camera, so a term that is suddenly
    // zero does not bound the next one.
    return effectiveBounces > 2 && previousBounceRadiance > negligible &&
           lastBounceRadiance < 0.01 * previousBounceRadiance;
}

namespace {

/// The film of a render; the integrator sets its quantum.
Film makeFilm(const RenderSettings& settings) {
    try {
        return Film(settings.width, settings.height, 1.0f, settings.layers);
    } catch (const std::bad_alloc&) {
        const std::uint64_t bytes = std::uint64_t{settings.width} * settings.height *
                                    (sizeof(Film::PixelSum) + sizeof(std::uint32_t) +
                                     channelsOf(settings.layers) * sizeof(std::int64_t));
        throw outOfMemory(
            fmt::format("a film of {}x{} pixels takes {} MiB", settings.width, settings.height, bytes >> 20),
            "expected a smaller size, or more memory");
    }
}

void trace(RenderContext& context) {
    try {
        if (context.settings.integrator == Integrator::kLightTracer) {
            traceLightPaths(context);
        } else {
            tracePaths(context);
        }
    } catch (const std::bad_alloc&) {
        throw outOfMemory("rendering", "expected a smaller size, or more memory");
    }
}

/// Handles an error of trace(): throws a RenderFailure with the samples so far, in which the error is nested,
/// or the error itself if there are no samples.
[[noreturn]] void failWithFilm(RenderContext& context, const MachineError& error) {
    if (context.film.totalSamples() + context.film.lightPaths() == 0) throw;
    context.statistics.stopped = true;
    context.summarise();
    std::throw_with_nested(RenderFailure(error.what(), {std::move(context.film), context.statistics}));
}

}  // namespace

RenderOutput renderOnDevice(Device& device, const Scene& scene, const DeviceScene& deviceScene,
                            const RenderSettings& settings, const RenderControl& control) {
    validate(settings);
    if (settings.layers != 0 && settings.integrator == Integrator::kLightTracer) {
        throw UsageError(
            fmt::format("{}: the light tracer traces no camera rays, from which layers are filled",
                        scene.source.string()));
    }
    const SampleRange range = control.samples.value_or(SampleRange{0, settings.spp});
    if (range.begin >= range.end || range.end > RenderSettings::kMostSpp) {
        throw UsageError(fmt::format("{}: the range of samples from {} to {} is {}", scene.source.string(),
                                     range.begin, range.end,
                                     range.begin >= range.end ? "empty" : "beyond the largest number, 2^24"));
    }
    if (control.onStage) control.onStage("preparing the film");
    RenderContext context{device, scene, settings, control, deviceScene, range, makeFilm(settings), {}};
    if (control.resume != nullptr) {
        const RenderState& state = *control.resume;
        if (state.film.width() != settings.width || state.film.height() != settings.height ||
            state.film.layers() != settings.layers) {
            throw UsageError(fmt::format(
                "{}: the film to resume from has {}x{} pixels{}; expected {}x{} and the layers of "
                "the settings",
                scene.source.string(), state.film.width(), state.film.height(),
                state.film.layers() == settings.layers ? "" : " and other layers", settings.width,
                settings.height));
        }
        context.film = state.film;
        context.samplesResumed = state.film.totalSamples() + state.film.lightPaths();
        context.lastBounce = state.lastBounceRadiance * static_cast<double>(context.samplesResumed);
        context.previousBounce = state.previousBounceRadiance * static_cast<double>(context.samplesResumed);
        context.statistics.filmOverflowed = state.filmOverflowed;
    }
    RenderStatistics& statistics = context.statistics;
    statistics.tuning = context.deviceScene.tuning;
    statistics.buildSeconds = context.deviceScene.buildSeconds;
    statistics.uploadSeconds = context.deviceScene.uploadSeconds;
    statistics.shrunkImages = context.deviceScene.atlas.warning;
    const std::uint32_t mostScatterings = context.deviceScene.transport.traits.mostScatterings;
    statistics.effectiveBounces = std::min(settings.bounces, mostScatterings);
    statistics.limitedByBounces = settings.bounces < mostScatterings;
    try {
        trace(context);
    } catch (const MachineError& e) {
        failWithFilm(context, e);
    }
    context.summarise();
    return {std::move(context.film), statistics};
}

}  // namespace duolux

#include "host/render/render.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>

#include "host/base/error.h"
#include "host/render/context.h"
#include "host/render/schedule.h"

namespace duolux {

namespace {

double meanDisplayed(const Film& film, glm::vec2 display) {
    const RadianceImage image = film.resolve();
    double total = 0.0;
    for (const glm::vec3& c : image.displayed(display))
        total += (static_cast<double>(c.x) + static_cast<double>(c.y) + static_cast<double>(c.z)) / 3.0;
    return total / (static_cast<double>(film.width()) * film.height());
}

}  // namespace

std::uint64_t RenderContext::samplesTotal() const {
    const std::uint64_t all = (scene.render.spp - control.firstSample) * pixels();
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
    // Without timestamps the time since the last dispatch came back has to do.
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
    throw MachineError(
        fmt::format("tracing paths failed on {} ({}): the driver ended the loops of a single path; render "
                    "with fewer bounces "
                    "than {}, or with fewer surfaces that light passes through",
                    device.info().name, device.info().driver, scene.render.bounces));
}

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
    DeviceScene deviceScene = uploadScene(device, scene, control.tuning);
    const float quantum = deviceScene.quantum;
    RenderContext context{device,
                          scene,
                          control,
                          std::move(deviceScene),
                          Film(scene.render.width, scene.render.height, quantum),
                          {}};
    if (control.resume != nullptr) {
        const RenderState& state = *control.resume;
        assert(state.film.quantum() == quantum && state.film.width() == scene.render.width &&
               state.film.height() == scene.render.height);
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
    statistics.effectiveBounces = context.deviceScene.traits.effectiveBounces;
    statistics.limitedByBounces = context.deviceScene.traits.limitedByBounces;
    if (scene.render.integrator == Integrator::kLight) {
        shoot(context);
    } else {
        gather(context);
    }
    context.summarise();
    return {std::move(context.film), statistics};
}

}  // namespace duolux

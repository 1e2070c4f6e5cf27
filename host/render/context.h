#pragma once

#include <chrono>

#include "host/gpu/device_scene.h"
#include "host/render/render.h"

namespace duolux {

/// A render under way: what the two integrators have in common.
struct RenderContext {
    using Clock = std::chrono::steady_clock;

    Device& device;
    const Scene& scene;
    const RenderControl& control;
    DeviceScene deviceScene;
    Film film;
    RenderStatistics statistics;
    /// Displayed radiance of paths with the largest number of scattering events, and with one fewer: sums
    /// over samples, of the means of the channels.
    double lastBounce = 0.0, previousBounce = 0.0;
    Clock::time_point start{}, lastReceived{}, lastCheckpoint{};
    double secondsPerSample = 0.0;  ///< on the device, as measured so far; 0: not yet

    std::uint64_t pixels() const { return std::uint64_t{film.width()} * film.height(); }
    /// Samples or light paths to take, without what was resumed.
    std::uint64_t samplesTotal() const;
    std::uint64_t samplesResumed = 0;

    void begin() {
        if (control.onStart) control.onStart();
        start = lastReceived = lastCheckpoint = Clock::now();
    }
    double seconds() const { return std::chrono::duration<double>(Clock::now() - start).count(); }

    /// A dispatch begun now might not end within the time limit.
    bool timeIsUp() const;

    /// Takes note of the time that a dispatch took, which is back; `samples`: paths in it.
    void received(double deviceSeconds, std::uint64_t samples);

    /// Tells the caller, who may stop the render. `underWay`: samples that the statistics do not count yet.
    void reportProgress(std::uint64_t underWay = 0);

    /// Has the caller keep what there is, if it is time. Only while no pixel's samples have gaps.
    void offerCheckpoint();

    /// Takes the sums over samples into the statistics.
    void summarise();

    /// The driver ended the loops of dispatches in which a lane had one path alone.
    [[noreturn]] void failCutShort() const;
};

/// Gathering: takes all samples of all pixels.
void gather(RenderContext& context);

/// Shooting: traces as many light paths as there would be samples.
void shoot(RenderContext& context);

}  // namespace duolux

#pragma once

#include "host/base/clock.h"
#include "host/device_scene/device_scene.h"
#include "host/render/kernel_setup.h"
#include "host/render/render.h"

namespace duolux {

/// The state of a running render, shared by both integrators.
struct RenderContext {
    Device& device;
    const Scene& scene;
    const RenderSettings& settings;
    const RenderControl& control;
    const DeviceScene& deviceScene;
    SampleRange range;  ///< to trace, including those that were resumed
    Film film;
    RenderStatistics statistics;
    /// Displayed radiance of paths with the largest number of scattering events, and with one fewer: sums
    /// over samples of the mean of the channels.
    double lastBounce = 0.0, previousBounce = 0.0;
    Clock::time_point start{}, lastReceived{}, lastCheckpoint{};
    double secondsPerSample = 0.0;  ///< on the device, as measured so far; 0: not measured yet

    RenderInputs inputs() const { return {device, deviceScene, scene, settings}; }
    std::uint64_t pixels() const { return std::uint64_t{film.width()} * film.height(); }
    /// Number of samples or light paths to trace, excluding those that were resumed.
    std::uint64_t samplesTotal() const;
    std::uint64_t samplesResumed = 0;

    void stage(std::string_view what) const {
        if (control.onStage) control.onStage(what);
    }
    void begin() {
        if (control.onStart) control.onStart();
        start = lastReceived = lastCheckpoint = Clock::now();
    }
    double seconds() const { return secondsSince(start); }

    /// Whether a dispatch that starts now could exceed the time limit.
    bool timeIsUp() const;

    /// Records the time of a finished dispatch; `samples`: number of its paths.
    void received(double deviceSeconds, std::uint64_t samples);

    /// Reports progress to the caller, who may stop the render. `underWay`: samples in flight, which the
    /// statistics do not count yet.
    void reportProgress(std::uint64_t underWay = 0);

    /// Calls onCheckpoint if it is due. Only while the samples of all pixels are free of gaps.
    void offerCheckpoint();

    /// Computes the statistics from the sums over samples.
    void summarise();

    /// Throws because the driver ended the loops of a dispatch in which each lane had a single path.
    [[noreturn]] void failCutShort() const;
};

/// Renders a scene that is on the device: duolux::render but for the upload.
RenderOutput renderOnDevice(Device& device, const Scene& scene, const DeviceScene& deviceScene,
                            const RenderSettings& settings, const RenderControl& control);

/// Path tracer: traces all samples of all pixels.
void tracePaths(RenderContext& context);

/// Light tracer: traces as many light paths as the path tracer would trace samples.
void traceLightPaths(RenderContext& context);

}  // namespace duolux

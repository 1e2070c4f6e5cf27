#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "host/base/error.h"
#include "host/base/named.h"
#include "host/device_scene/tuning.h"
#include "host/film/film.h"
#include "host/film/sample_range.h"
#include "host/scene/scene.h"
#include "host/vk/device.h"

namespace duolux {

/// The progress of a render; passed to RenderControl::onProgress after every dispatch.
struct RenderProgress {
    /// Samples of all pixels, or light paths, excluding resumed ones.
    std::uint64_t samplesDone = 0, samplesTotal = 0;
    double seconds = 0.0;  ///< since the first dispatch
};

/// How direct light is computed.
enum class DirectLight : std::uint8_t {
    kAuto,       ///< closed form where it applies and is faster (`local`), otherwise sampled
    kSampled,    ///< next-event estimation with multiple importance sampling
    kClosedForm  ///< Lambert's polygon formula; only where DeviceScene::closedFormApplies
};

const char* nameOf(DirectLight directLight);  ///< "auto", "sampled", "closed-form"
template <>
inline constexpr std::array kValuesOf<DirectLight>{DirectLight::kAuto, DirectLight::kSampled,
                                                   DirectLight::kClosedForm};

struct RenderStatistics;

/// The state of a render from which another render can resume.
struct RenderState {
    Film film;
    double lastBounceRadiance = 0.0, previousBounceRadiance = 0.0;  ///< as in RenderStatistics
    bool filmOverflowed = false;
};

/// Limits for tests, with which the image stays bitwise identical. 0: only the renderer's own limit.
struct TestLimits {
    std::uint32_t maxSamplesPerDispatch = 0;  ///< of one pixel
    std::uint32_t maxPixelsPerDispatch = 0;   ///< or light paths
    std::uint32_t maxSamplesPerLane = 0;      ///< in one dispatch, over all pixels of a lane
    std::uint32_t filmBandPixels = 0;         ///< in one buffer of the light tracer's film
    bool noInt64Atomics = false;
};

struct RenderControl {
    /// The samples to trace, at least one per pixel; by default the first RenderSettings::spp.
    std::optional<SampleRange> samples;
    /// The state to resume from. Scene, samples.begin and all settings except spp must be identical. If the
    /// state has more samples than are to be traced, its film is the result.
    const RenderState* resume = nullptr;
    /// Called about every checkpointSeconds with the film so far, from the rendering thread. What it throws
    /// ends the render.
    std::function<void(const Film&, const RenderStatistics&)> onCheckpoint;
    double checkpointSeconds = 60.0;
    DirectLight directLight = DirectLight::kAuto;
    TuningChoice tuning;
    /// Called before each stage of the preparations with what it does, for example "building trees".
    std::function<void(std::string_view)> onStage;
    /// Called once before the first dispatch; until then no work can be lost.
    std::function<void()> onStart;
    /// Called periodically from the rendering thread; returning false stops the render cleanly.
    std::function<bool(const RenderProgress&)> onProgress;
    /// The render stops before this many seconds have passed, but not before every pixel has one sample
    /// (light tracer: before there are as many light paths as pixels).
    std::optional<double> timeLimit;
    TestLimits limits;
};

struct RenderStatistics {
    Tuning tuning;
    std::uint32_t lanePaths = 0;  ///< the largest number of paths of a lane in one dispatch
    double buildSeconds = 0.0;    ///< BVH
    double uploadSeconds = 0.0;
    double pipelineSeconds = 0.0;         ///< creating the pipeline (some drivers compile the kernel here)
    double firstDispatchSeconds = 0.0;    ///< wall time of the first dispatch (some drivers compile here)
    double renderSeconds = 0.0;           ///< wall time from the first dispatch to the last
    double deviceSeconds = 0.0;           ///< by timestamps, summed over dispatches
    double longestDispatchSeconds = 0.0;  ///< by timestamps
    std::uint64_t dispatches = 0;
    std::uint64_t dispatchesCutShort = 0;  ///< ended early by the driver and traced again in smaller parts
    std::uint64_t samples = 0;             ///< of all pixels, or light paths; excluding resumed ones
    /// Numbers of rays: from the camera, from emitters, from surfaces, to emitters or to the camera, and
    /// those that only search for emitters.
    std::uint64_t cameraRays = 0, lightRays = 0, bounceRays = 0, shadowRays = 0, emitterRays = 0;
    std::uint64_t nonFiniteSamples = 0;  ///< dropped; 0 unless something is wrong
    bool filmOverflowed = false;         ///< some radiance exceeded Film::largestRadiance
    std::uint64_t deviceBytes = 0;       ///< peak
    std::string shrunkImages;            ///< as AtlasPlan::warning
    /// Displayed radiance (mean over pixels and channels) of the last allowed bounce, of the bounce before
    /// it, and of the whole image.
    double lastBounceRadiance = 0.0, previousBounceRadiance = 0.0, meanRadiance = 0.0;
    std::uint32_t effectiveBounces =
        0;  ///< scattering events that can contribute: at most the `bounces` of the settings
    bool directLightInClosedForm = false;
    bool stopped = false;  ///< ended before all samples were traced
    /// The samples of some pixels, or the light paths, have gaps in their numbers. The image is valid, but no
    /// render can resume from the film.
    bool gaps = false;

    bool limitedByBounces = false;  ///< paths with more scattering events than `bounces` could contribute

    /// Whether the bounce limit truncated a series whose terms were not yet negligible (above 1 % of the
    /// image).
    bool cutOffByBounces() const;
};

struct RenderOutput {
    Film film;
    RenderStatistics statistics;
};

/// The device or the machine failed after some samples were traced; output() holds these. The error that
/// ended the render, for example a DeviceError, is nested: std::rethrow_if_nested.
class RenderFailure : public MachineError {
  public:
    RenderFailure(const std::string& line, RenderOutput output)
        : MachineError(line), output_(std::make_shared<RenderOutput>(std::move(output))) {}
    RenderOutput& output() const { return *output_; }  ///< shared by copies

  private:
    std::shared_ptr<RenderOutput> output_;
};

/// Renders a scene once; see Renderer for more. The film includes the resumed samples. Identical scene,
/// settings, seed and device give a bitwise identical image. Throws InputError as duolux::validate. Throws
/// UsageError if the range of samples is empty, if direct light in closed form is requested but does not
/// apply, if the light tracer is asked for layers, or if the device does not support the requested tuning.
/// Throws DeviceError with the stage and the driver if the device fails, MemoryError if memory runs out, or
/// RenderFailure once there are samples.
RenderOutput render(Device& device, const Scene& scene, const RenderSettings& settings,
                    const RenderControl& control = {});

/// The same with the settings of its files.
inline RenderOutput render(Device& device, const LoadedScene& scene, const RenderControl& control = {}) {
    return render(device, scene, scene.settings, control);
}

}  // namespace duolux

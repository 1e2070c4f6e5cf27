#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "host/base/error.h"
#include "host/film/film.h"
#include "host/gpu/tuning.h"
#include "host/scene/scene.h"
#include "host/vk/device.h"

namespace duolux {

/// Where a render stands; passed to RenderControl::onProgress after every dispatch. Samples are light paths
/// if the scene's integrator shoots.
struct RenderProgress {
    /// Over all pixels, without what was resumed.
    std::uint64_t samplesDone = 0, samplesTotal = 0;
    double seconds = 0.0;  ///< since the first dispatch
};

/// How light from emitters to a surface is found.
enum class DirectLight : std::uint8_t {
    kAuto,       ///< in closed form where that applies and pays (`local`), sampled elsewhere
    kSampled,    ///< next-event estimation with multiple importance sampling
    kClosedForm  ///< Lambert's polygon formula; only where DeviceScene::closedFormApplies
};

struct RenderStatistics;

/// How far a render has come.
struct RenderState {
    Film film;
    double lastBounceRadiance = 0.0, previousBounceRadiance = 0.0;  ///< as in RenderStatistics
    bool filmOverflowed = false;
};

struct RenderControl {
    /// Samples [firstSample, spp) of every pixel, or the light paths of the same numbers times the number of
    /// pixels.
    std::uint32_t firstSample = 0;
    /// To go on from: of the same scene, settings but spp, and firstSample.
    const RenderState* resume = nullptr;
    /// Called about every checkpointSeconds with what there is, from the rendering thread.
    std::function<void(const Film&, const RenderStatistics&)> onCheckpoint;
    double checkpointSeconds = 60.0;
    DirectLight directLight = DirectLight::kAuto;
    TuningChoice tuning;
    /// Called once before the first dispatch: until then there is nothing to lose.
    std::function<void()> onStart;
    /// Called now and then from the rendering thread; returning false stops the render cleanly.
    std::function<bool(const RenderProgress&)> onProgress;
    /// Stops before this many seconds of rendering have passed; every pixel has at least one sample all the
    /// same, or there are as many light paths as pixels.
    std::optional<double> timeLimit;
    /// For tests; 0: no limit but the renderer's own. None changes a bit of the image.
    std::uint32_t maxSamplesPerDispatch = 0;  ///< of one pixel
    std::uint32_t maxPixelsPerDispatch = 0;   ///< or light paths
    std::uint32_t maxSamplesPerLane = 0;      ///< in one dispatch, over all pixels that a lane takes
    std::uint32_t filmBandPixels = 0;         ///< of one buffer of the film that light paths add to
    bool noInt64Atomics = false;
};

struct RenderStatistics {
    Tuning tuning;
    std::uint32_t lanePaths = 0;  ///< that a lane took at most in one dispatch
    double buildSeconds = 0.0;    ///< BVH
    double uploadSeconds = 0.0;
    double pipelineSeconds = 0.0;       ///< creating the pipeline (and compiling, on drivers that do it then)
    double firstDispatchSeconds = 0.0;  ///< wall, of the first dispatch (some drivers compile in it)
    double renderSeconds = 0.0;         ///< wall, first dispatch to last
    double deviceSeconds = 0.0;         ///< by timestamps, summed over dispatches
    double longestDispatchSeconds = 0.0;  ///< by timestamps
    std::uint64_t dispatches = 0;
    std::uint64_t dispatchesCutShort = 0;  ///< thrown away and traced again in smaller parts
    std::uint64_t samples = 0;             ///< pixel samples taken, or light paths
    std::uint64_t cameraRays = 0, lightRays = 0, bounceRays = 0, shadowRays = 0, emitterRays = 0;
    std::uint64_t nonFiniteSamples = 0;  ///< dropped; 0 unless something is wrong
    bool filmOverflowed = false;         ///< some light was brighter than Film::largestRadiance
    std::uint64_t deviceBytes = 0;       ///< peak
    /// Radiance (mean over pixels and channels, displayed) that the last allowed bounce added, and the one
    /// before it.
    double lastBounceRadiance = 0.0, previousBounceRadiance = 0.0, meanRadiance = 0.0;
    std::uint32_t effectiveBounces =
        0;  ///< scattering events that can contribute: at most the scene's `bounces`
    bool directLightInClosedForm = false;
    bool stopped = false;  ///< ended before all samples were taken
    /// Some pixels lack samples, or light paths, that come before others which they have: the film shows what
    /// there is, but no render can go on from it.
    bool gaps = false;

    bool limitedByBounces = false;  ///< more scattering events than `bounces` could contribute

    /// The bounce limit cut off a series whose terms were not yet negligible (more than 1 % of the image).
    bool cutOffByBounces() const;
};

struct RenderOutput {
    Film film;
    RenderStatistics statistics;
};

/// The device or the machine failed when there were samples already, which are not lost.
class RenderFailure : public MachineError {
  public:
    RenderFailure(const std::string& line, RenderOutput output)
        : MachineError(line), output_(std::make_shared<RenderOutput>(std::move(output))) {}
    RenderOutput& output() const { return *output_; }  ///< shared by copies

  private:
    std::shared_ptr<RenderOutput> output_;
};

/// Renders the scene with its integrator. The film holds what was resumed, too. Throws UsageError if the
/// direct light is asked for in closed form where there is none, or the device lacks what tuning asks for.
/// Same scene, settings, seed and device give the same bits. Throws MachineError naming the stage and the
/// driver if the device fails, a RenderFailure once there are samples.
RenderOutput render(Device& device, const Scene& scene, const RenderControl& control = {});

}  // namespace duolux

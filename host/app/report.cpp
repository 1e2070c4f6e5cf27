#include "host/app/report.h"

#include <sys/resource.h>

#include <nlohmann/json.hpp>

#include "host/base/version.h"
#include "host/cli/json.h"
#include "host/device_scene/json.h"
#include "host/scene/hash.h"

namespace duolux {

namespace {

std::uint64_t peakHostBytes() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024u;
}

double perSecond(std::uint64_t count, double seconds) {
    return seconds > 0.0 ? static_cast<double>(count) / seconds * 1e-6 : 0.0;
}

}  // namespace

std::string renderReport(const LoadedScene& scene, SampleRange samples, const DeviceInfo& device,
                         const RenderStatistics& statistics, const StageSeconds& seconds) {
    const std::uint64_t rays = statistics.cameraRays + statistics.lightRays + statistics.bounceRays +
                               statistics.shadowRays + statistics.emitterRays;
    const bool lightTracer = scene.settings.integrator == Integrator::kLightTracer;
    const char* directLight =
        lightTracer
            ? "light paths"
            : nameOf(statistics.directLightInClosedForm ? DirectLight::kClosedForm : DirectLight::kSampled);
    nlohmann::ordered_json report;
    report["version"] = 1;
    report["program"] = {{"name", "duolux"}, {"version", versionString()}, {"commit", commitString()}};
    report["scene"] = {{"file", scene.source.string()},
                       {"hash", hashScene(scene)},
                       {"triangles", scene.geometry.triangles.size()},
                       {"materials", scene.materials.size()},
                       {"origin", {scene.origin.x, scene.origin.y, scene.origin.z}}};
    report["settings"] = {{"width", scene.settings.width},
                          {"height", scene.settings.height},
                          {"spp", samples.size()},
                          {"sample_range", {samples.begin, samples.end}},
                          {"bounces", scene.settings.bounces},
                          {"effective_bounces", statistics.effectiveBounces},
                          {"seed", scene.settings.seed},
                          {"sampler", nameOf(scene.settings.sampler)},
                          {"integrator", nameOf(scene.settings.integrator)},
                          {"direct_light", directLight},
                          {"layers", namesOf(scene.settings.layers)},
                          {"reflectance", describeReflectance(scene.reflectance)}};
    report["device"] = toJson(device);
    report["tuning"] = toJson(statistics.tuning);
    report["tuning"]["lane_paths"] = statistics.lanePaths;  // the final value
    report["seconds"] = {{"load", seconds.load},
                         {"build", statistics.buildSeconds},
                         {"upload", statistics.uploadSeconds},
                         {"pipeline", statistics.pipelineSeconds},
                         {"first_dispatch", statistics.firstDispatchSeconds},
                         {"render", statistics.renderSeconds},
                         {"write", seconds.write},
                         {"total", seconds.total}};
    report["device_seconds"] = {{nameOf(scene.settings.integrator), statistics.deviceSeconds}};
    report["dispatches"] = {{"count", statistics.dispatches},
                            {"longest_seconds", statistics.longestDispatchSeconds},
                            {"cut_short", statistics.dispatchesCutShort}};
    report["samples"] = {{"taken", statistics.samples},
                         {"non_finite", statistics.nonFiniteSamples},
                         {"overflowed_film", statistics.filmOverflowed},
                         {"complete", !statistics.stopped}};
    report["rays"] = {{"camera", statistics.cameraRays},   {"light", statistics.lightRays},
                      {"bounce", statistics.bounceRays},   {"shadow", statistics.shadowRays},
                      {"emitter", statistics.emitterRays}, {"total", rays}};
    report["Mrays_per_second"] = perSecond(rays, statistics.renderSeconds);
    report["Msamples_per_second"] = perSecond(statistics.samples, statistics.renderSeconds);
    report["radiance"] = {{"mean", statistics.meanRadiance},
                          {"last_bounce", statistics.lastBounceRadiance},
                          {"previous_bounce", statistics.previousBounceRadiance},
                          {"cut_off_by_bounces", statistics.cutOffByBounces()}};
    report["peak_bytes"] = {{"host", peakHostBytes()}, {"device", statistics.deviceBytes}};
    report["warnings"] = textsOf(scene.warnings);
    return jsonText(report);
}

}  // namespace duolux

#pragma once

#include <string>

#include "host/render/render.h"
#include "host/scene/scene.h"
#include "host/vk/device_info.h"

namespace duolux {

/// Durations in seconds of the stages that only the command measures.
struct StageSeconds {
    double load = 0.0, write = 0.0, total = 0.0;
};

/// The statistics of a render of these samples as JSON (format version 1), with a newline at the end.
std::string renderReport(const LoadedScene& scene, SampleRange samples, const DeviceInfo& device,
                         const RenderStatistics& statistics, const StageSeconds& seconds);

}  // namespace duolux

#pragma once

#include <string>
#include <vector>

#include "host/render/render.h"

namespace duolux {

/// "light paths" or "samples".
const char* samplesName(const RenderSettings& settings);

/// Warnings about a finished render of these samples. `failed`: it was ended by an error, which is reported
/// elsewhere; `interrupted`: by a signal.
std::vector<std::string> resultWarnings(const RenderSettings& settings, SampleRange samples,
                                        const RenderOutput& output, bool failed, bool interrupted);

/// A warning if so few of a number of light paths start at some emitting material that its light is missing
/// from the picture; empty otherwise.
std::string dimEmitterWarning(const Scene& scene, std::uint64_t lightPaths);

/// Adds a warning to the scene's if a light tracer would not show what some surface reflects.
void warnOfSmoothSurfaces(LoadedScene& scene);

}  // namespace duolux

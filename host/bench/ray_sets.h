#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "host/gpu/device_scene.h"
#include "host/scene/scene.h"
#include "host/vk/device.h"
#include "shaders/shared/trace_layout.h"

namespace duolux {

/// Rays of one kind, always the same for a scene.
struct RaySet {
    std::string name;
    std::uint32_t mode;  ///< shared::kTrace...
    std::vector<shared::TraceRay> rays;
};

/// Of the sets of a scene in which something emits and something is hit.
inline constexpr const char* kRaySetNames[] = {"primary", "diffuse", "shadow", "crossings"};

/// The rays that a path tracer of this scene asks for first, of a picture of width x height pixels:
/// `primary`: from the camera, in the order in which pixels are rendered (coherent);
/// `diffuse`: from where these hit, by the cosine (incoherent);
/// `shadow`: from there to a point of an emitter, by area (only where something emits);
/// `crossings`: the primary ones, to be followed through all surfaces.
std::vector<RaySet> makeRaySets(const Device& device, const Scene& scene, const DeviceScene& deviceScene,
                                std::uint32_t width, std::uint32_t height);

}  // namespace duolux

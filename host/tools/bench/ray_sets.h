#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "host/device_scene/device_scene.h"
#include "host/scene/scene.h"
#include "host/vk/device.h"
#include "shaders/shared/trace_layout.h"

namespace duolux {

/// Rays of one kind; deterministic for a scene.
struct RaySet {
    std::string name;
    std::uint32_t mode;  ///< shared::kTrace...
    std::vector<shared::TraceRay> rays;
};

/// Of the sets of a scene in which something emits and something is hit.
inline constexpr const char* kRaySetNames[] = {"primary", "diffuse", "shadow", "crossings"};

/// The first rays of a path tracer for an image of width x height pixels of this scene:
/// `primary`: from the camera, in the order in which pixels are rendered (coherent);
/// `diffuse`: from the hits of these rays, cosine-distributed (incoherent);
/// `shadow`: from the same hits to points on emitters, uniform in area (only if something emits);
/// `crossings`: the primary rays, followed through all surfaces.
std::vector<RaySet> makeRaySets(const Device& device, const Scene& scene, const DeviceScene& deviceScene,
                                std::uint32_t width, std::uint32_t height);

}  // namespace duolux

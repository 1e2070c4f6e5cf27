#pragma once

#include <vector>

#include "host/gpu/device_scene.h"
#include "host/scene/scene.h"
#include "host/vk/kernel.h"

namespace duolux {

// Inputs that the kernels of both integrators need for a scene.

/// The uniform block, shared::PathParams.
Buffer uploadParams(const Device& device, const DeviceScene& deviceScene, const Scene& scene);

/// The scene's buffers and the uniform block.
std::vector<Binding> sceneBindings(const DeviceScene& deviceScene, const Buffer& params);

/// The specialisation constants of both kernels.
std::vector<Specialization> sceneSpecialization(const DeviceScene& deviceScene, const Scene& scene);

/// Number of paths that a lane traces in one dispatch.
std::uint32_t lanePaths(const DeviceScene& deviceScene);

}  // namespace duolux

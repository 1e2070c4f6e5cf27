#pragma once

#include <vector>

#include "host/device_scene/device_scene.h"
#include "host/scene/scene.h"
#include "host/vk/device.h"
#include "host/vk/kernel.h"

namespace duolux {

// Inputs that the kernels of both integrators need for a scene.

/// What is rendered, on which device.
struct RenderInputs {
    const Device& device;
    const DeviceScene& deviceScene;  ///< made from `scene`
    const Scene& scene;
    const RenderSettings& settings;
};

/// The uniform block, shared::PathParams. Throws MachineError if memory does not suffice.
Buffer uploadParams(const RenderInputs& inputs);

/// The scene's buffers and the uniform block.
std::vector<Binding> sceneBindings(const DeviceScene& deviceScene, const Buffer& params);

/// The specialisation constants of both kernels.
std::vector<Specialization> sceneSpecialization(const RenderInputs& inputs);

/// Number of paths that a lane traces in one dispatch.
std::uint32_t lanePaths(const DeviceScene& deviceScene);

}  // namespace duolux

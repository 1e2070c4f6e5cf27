#pragma once

#include <cstdint>

#include "host/scene/scene.h"
#include "shaders/shared/camera_layout.h"

namespace duolux {

/// The record of a camera for an image of width x height pixels of a scene with these bounds.
shared::DeviceCamera deviceCamera(const Camera& camera, std::uint32_t width, std::uint32_t height,
                                  const Bounds& bounds);

/// The kind of camera, one of shared::kCamera..., as a specialisation constant of the kernels.
std::uint32_t deviceKind(CameraType type);

}  // namespace duolux

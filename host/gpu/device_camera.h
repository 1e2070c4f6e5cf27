#pragma once

#include <cstdint>

#include "host/scene/scene.h"
#include "shaders/shared/camera_layout.h"

namespace duolux {

/// A camera's record, for a picture of width x height pixels of a scene with these bounds.
shared::DeviceCamera deviceCamera(const Camera& camera, std::uint32_t width, std::uint32_t height,
                                  const Bounds& bounds);

/// Its kind, one of shared::kCamera...: a constant of the kernels.
std::uint32_t deviceKind(CameraType type);

}  // namespace duolux

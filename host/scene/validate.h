#pragma once

#include "host/scene/scene.h"

namespace duolux {

/// Checks what `Scene` promises, for scenes that a program fills in: loaders make valid scenes. Indices are
/// in range, sizes agree, numbers are finite and within the ranges of their fields, and the camera has a
/// view. Throws InputError with the first field that is wrong, for example "materials[2].roughness". The time
/// is linear in the size of the scene: about 10 ms for 500,000 triangles.
void validate(const Scene& scene);

/// The same without Scene::geometry, which must be valid.
void validateExceptGeometry(const Scene& scene);

/// Checks that settings are within the ranges that their fields state. Throws UsageError with the first that
/// is not.
void validate(const RenderSettings& settings);

}  // namespace duolux

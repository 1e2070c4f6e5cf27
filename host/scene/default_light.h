#pragma once

#include "host/scene/scene.h"

namespace duolux {

/// Some triangle has a material that emits.
bool anyEmitter(const Scene& scene);

/// Adds a rectangular luminaire above, beside and behind the camera, which faces what the camera sees; it
/// cannot come into the picture, and emits no visible light. Its radiance is such that a white surface in the
/// middle of the scene shows about 0.8 where it faces the luminaire. Needs the scene's camera and geometry.
void addDefaultLight(Scene& scene);

}  // namespace duolux

#pragma once

#include "host/view/view_samples.h"

namespace duolux {

/// Some triangle has a material that emits.
bool anyEmitter(const Scene& scene);

/// How brightly the emitters light what a camera sees, or the surface as a whole if that is more: what white
/// would show, or emits, up to 1, on average.
float brightnessFor(const Camera& camera, float aspect, const Surface& surface,
                    const Illumination& illumination, const ViewSamples& samples);

/// Adds a rectangular luminaire above, beside and behind the camera, which faces what the camera sees; it
/// cannot come into the picture, and emits no visible light. Where walls are in the way it stands in the
/// roomiest place around the camera that is not in view. Its radiance is such that a white surface in the
/// middle of the scene shows about 0.8 where it faces the luminaire, or in a closed room, where light comes
/// back from all sides, what the camera sees shows half of that on average. Needs the scene's camera and
/// geometry; `surface` is without it.
void addDefaultLight(Scene& scene, const Surface& surface);

}  // namespace duolux

#pragma once

#include "host/view/view_samples.h"

namespace duolux {

/// How brightly the emitters light the surfaces that a camera sees, or the whole surface if that is brighter:
/// the mean, up to 1, of the radiance that white would reflect plus the emitted radiance.
float brightnessFor(const Camera& camera, float aspect, const Surface& surface,
                    const Illumination& illumination, const ViewSamples& samples);

/// Adds a rectangular lamp above, beside and behind the camera. It faces the surfaces that the camera sees,
/// is out of view, and emits no visible light. If walls are in the way, it is placed out of view where there
/// is the most clearance around the camera. A white surface in the middle of the scene that faces the lamp
/// reflects a radiance of about 0.8. In a closed room, where walls return the light, the mean of white
/// surfaces in view is half of this. Requires the scene's camera and geometry; `surface` excludes the lamp.
void addLamp(LoadedScene& scene, const Surface& surface);

}  // namespace duolux

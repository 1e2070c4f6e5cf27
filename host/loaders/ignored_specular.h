#pragma once

#include "host/scene/scene.h"

namespace duolux {

/// Adds a warning if a material both transmits light and scales its dielectric reflection: what transmits
/// reflects by its index of refraction alone.
void warnOfIgnoredSpecular(LoadedScene& scene);

}  // namespace duolux

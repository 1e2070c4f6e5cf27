#pragma once

#include "host/scene/scene.h"

namespace duolux {

/// Adds a warning if a material has images, but some of its triangles have no texture coordinates, or not the
/// second ones that an image uses.
void warnOfMissingUvs(LoadedScene& scene);

}  // namespace duolux

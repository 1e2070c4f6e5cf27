#pragma once

#include <vector>

#include "host/view/surface.h"

namespace duolux {

/// The triangles of the surface's scene in the surface's coordinates. If there are more than 20,000, they are
/// simplified by vertex clustering (Rossignac and Borrel, "Multi-resolution 3D approximations for rendering
/// complex scenes", 1993), except for emitting ones.
std::vector<Surface::Triangle> simplifiedTriangles(const Surface& surface);

}  // namespace duolux

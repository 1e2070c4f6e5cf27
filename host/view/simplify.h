#pragma once

#include <vector>

#include "host/view/surface.h"

namespace duolux {

/// The triangles of the surface's scene in its coordinates; where there are more than some 20,000, those
/// that vertex clustering leaves (Rossignac and Borrel, "Multi-resolution 3D approximations for rendering
/// complex scenes", 1993), and all that emit.
std::vector<Surface::Triangle> simplifiedTriangles(const Surface& surface, std::size_t framedTriangles);

}  // namespace duolux

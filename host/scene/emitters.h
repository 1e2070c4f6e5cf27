#pragma once

#include <cstdint>
#include <vector>

#include "host/scene/scene.h"

namespace duolux {

bool emits(const Scene& scene, std::size_t triangle);

/// Whether anything emits, be it a triangle or a point.
bool anyEmitter(const Scene& scene);

/// The triangles that emit, ascending.
std::vector<std::uint32_t> emittingTriangles(const Scene& scene);

}  // namespace duolux

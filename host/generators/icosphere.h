#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace duolux {

struct Icosphere {
    std::vector<glm::dvec3> positions;  ///< on the unit sphere
    std::vector<glm::uvec3> triangles;  ///< counter-clockwise from outside
};

/// An icosahedron with each edge divided into `frequency` parts: 20 frequency^2 triangles of similar shape,
/// with 10 frequency^2 + 2 shared vertices.
Icosphere makeIcosphere(std::uint32_t frequency);

}  // namespace duolux

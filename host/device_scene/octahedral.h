#pragma once

#include <cstdint>
#include <glm/glm.hpp>

namespace duolux {

/// A unit vector in two snorm16: see shaders/lib/octahedral.glsl.
std::uint32_t octahedralEncode(glm::vec3 n);

/// The same numbers as on the device.
glm::vec3 octahedralDecode(std::uint32_t bits);

}  // namespace duolux

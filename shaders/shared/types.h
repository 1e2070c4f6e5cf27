// Lets one header describe a structure to C++ (through GLM) and to GLSL (scalar block layout).
// A shared header includes this first and puts its declarations between DUOLUX_BEGIN and DUOLUX_END.
#ifndef DUOLUX_SHADERS_SHARED_TYPES_H
#define DUOLUX_SHADERS_SHARED_TYPES_H

#ifdef __cplusplus
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>

namespace duolux::shared {
using uint = std::uint32_t;
using glm::vec2;
using glm::vec3;
using glm::vec4;
}  // namespace duolux::shared

#define DUOLUX_CONST inline constexpr
#define DUOLUX_BEGIN namespace duolux::shared {
#define DUOLUX_END }
#else
#define DUOLUX_CONST const
#define DUOLUX_BEGIN
#define DUOLUX_END
#endif

#endif

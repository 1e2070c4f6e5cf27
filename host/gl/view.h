#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>

#include "host/scene/scene.h"

namespace duolux {

/// Where in its pixel pass `index` of `count` samples, from the top left corner, in [0, 1): Hammersley's
/// points, so that edges of any direction are met at `count` different places.
glm::vec2 jitterOf(std::uint32_t index, std::uint32_t count);

/// OpenGL's eye coordinates for the scene's camera.
glm::mat4 viewMatrix(const Camera& camera);

/// OpenGL's clip coordinates, such that the centre of a pixel of the image shows what `jitter` (in pixels
/// from the top left corner of the pixel) does; of the part of the image that `window` (left, top, width,
/// height as fractions) tells.
glm::mat4 projectionMatrix(const Scene& scene, glm::vec2 jitter, const std::array<float, 4>& window);

}  // namespace duolux

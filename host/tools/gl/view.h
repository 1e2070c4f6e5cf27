#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>

#include "host/scene/scene.h"

namespace duolux {

/// The sample position of pass `index` in a pixel, from the top left corner, in [0, 1): the R2 sequence of M.
/// Roberts ("The Unreasonable Effectiveness of Quasirandom Sequences", 2018), so that edges of any direction,
/// including diagonals, are sampled at as many positions as there are passes.
glm::vec2 jitterOf(std::uint32_t index);

/// OpenGL's eye coordinates for the scene's camera.
glm::mat4 viewMatrix(const Camera& camera);

/// OpenGL's clip coordinates, such that the centre of a pixel of the image shows what `jitter` (in pixels
/// from the top left corner of the pixel) does; of the part of the image that `window` (left, top, width,
/// height as fractions) tells.
glm::mat4 projectionMatrix(const Scene& scene, const RenderSettings& settings, glm::vec2 jitter,
                           const std::array<float, 4>& window);

}  // namespace duolux

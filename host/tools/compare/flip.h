#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace duolux {

/// Pixels per degree of visual angle: a monitor 0.7 m wide with 3840 pixels, seen from 0.7 m.
inline constexpr double kFlipPixelsPerDegree = 67.0206432765823;

/// LDR-FLIP per pixel, from 0 (no difference seen) to 1: Andersson, Nilsson, Akenine-Moeller, Oskarsson,
/// Astroem, Fairchild, "FLIP: A Difference Evaluator for Alternating Images", Proc. ACM Comput. Graph.
/// Interact. Tech. (HPG) 3(2), 2020. Both images hold sRGB-encoded values in [0, 1], width * height each,
/// rows from the top.
std::vector<float> flip(const std::vector<glm::vec3>& test, const std::vector<glm::vec3>& reference,
                        std::uint32_t width, std::uint32_t height,
                        double pixelsPerDegree = kFlipPixelsPerDegree);

}  // namespace duolux

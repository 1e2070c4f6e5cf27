#pragma once

#include <cmath>
#include <cstdint>

#include "host/view/illumination.h"

namespace duolux {

/// Axes of a camera, unit and orthogonal.
struct ViewFrame {
    glm::vec3 forward, right, up;

    explicit ViewFrame(const Camera& camera)
        : forward(glm::normalize(camera.target - camera.position)),
          right(glm::normalize(glm::cross(forward, camera.up))),
          up(glm::cross(right, forward)) {}
};

inline float aspectOf(const RenderSettings& render) {
    return static_cast<float>(render.width) / static_cast<float>(render.height);
}

inline constexpr int kLooksAcross = 20;  ///< rays of lookThrough in each direction

/// Calls visit(point, number from 1 on) with what a camera sees, by a few rays spread over its picture.
template <typename Visit>
void lookThrough(const Camera& camera, float aspect, const Surface& surface, const Visit& visit) {
    const ViewFrame frame(camera);
    const float tangent = std::tan(0.5f * glm::radians(camera.vfov));
    const glm::vec3 eye = surface.toLocal(glm::dvec3(camera.position));
    for (int i = 0; i < kLooksAcross * kLooksAcross; ++i) {
        const float x = (static_cast<float>(i % kLooksAcross) + 0.5f) * 2.0f / kLooksAcross - 1.0f;
        const float y = (static_cast<float>(i / kLooksAcross) + 0.5f) * 2.0f / kLooksAcross - 1.0f;
        const glm::vec3 direction =
            glm::normalize(frame.forward + tangent * (aspect * x * frame.right + y * frame.up));
        if (const auto hit = surface.firstHit(eye, direction))
            visit(pointOf(surface, eye, direction, *hit), static_cast<std::uint32_t>(i + 1));
    }
}

}  // namespace duolux

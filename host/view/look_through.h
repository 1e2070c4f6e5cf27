#pragma once

#include <cstdint>

#include "host/scene/image_plane.h"
#include "host/view/illumination.h"

namespace duolux {

/// The axes of a camera; orthonormal.
struct ViewFrame {
    glm::vec3 forward, right, up;

    explicit ViewFrame(const Camera& camera)
        : forward(glm::normalize(camera.target - camera.position)),
          right(glm::normalize(glm::cross(forward, camera.up))),
          up(glm::cross(right, forward)) {}
};

inline constexpr int kLooksAcross = 20;  ///< rays of lookThrough in each direction

/// Calls visit(point, number), with numbers from 1 on, for the points that a camera sees by a few rays spread
/// over its image.
template <typename Visit>
void lookThrough(const Camera& camera, float aspect, const Surface& surface, const Visit& visit) {
    const ImagePlane plane = imagePlane(camera, static_cast<double>(aspect));
    for (int i = 0; i < kLooksAcross * kLooksAcross; ++i) {
        const float x = (static_cast<float>(i % kLooksAcross) + 0.5f) * 2.0f / kLooksAcross - 1.0f;
        const float y = (static_cast<float>(i / kLooksAcross) + 0.5f) * 2.0f / kLooksAcross - 1.0f;
        const auto [origin, direction] = cameraRay(camera, plane, {x, y});
        const glm::vec3 eye = surface.toLocal(glm::dvec3(origin));
        if (const auto hit = surface.firstHit(eye, direction))
            visit(pointOf(surface, eye, direction, *hit), static_cast<std::uint32_t>(i + 1));
    }
}

}  // namespace duolux

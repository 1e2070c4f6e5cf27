#include "host/scene/frame_camera.h"

#include <algorithm>
#include <cmath>

namespace duolux {

Camera frameCamera(const Scene& scene) {
    constexpr float kElevation = 0.3f;  // tangent of the angle above the horizon: 17 degrees
    constexpr float kMargin = 1.05f;
    const Bounds bounds = boundsOf(scene.geometry);
    const float aspect = static_cast<float>(scene.render.width) / static_cast<float>(scene.render.height);
    const glm::vec3 centre = 0.5f * (bounds.lower + bounds.upper);
    const glm::vec3 half = 0.5f * (bounds.upper - bounds.lower);

    Camera camera;
    const glm::vec3 backward = glm::normalize(glm::vec3(0.0f, kElevation, 1.0f));
    const glm::vec3 right(1.0f, 0.0f, 0.0f);
    const glm::vec3 up = glm::cross(backward, right);
    const float tangentY = std::tan(0.5f * glm::radians(camera.vfov)) / kMargin;
    const float tangentX = tangentY * aspect;
    float distance = 0.0f;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::vec3 sign(corner & 1 ? 1.0f : -1.0f, corner & 2 ? 1.0f : -1.0f, corner & 4 ? 1.0f : -1.0f);
        const glm::vec3 offset = sign * half;
        const float reach =
            std::max(std::abs(glm::dot(offset, right)) / tangentX, std::abs(glm::dot(offset, up)) / tangentY);
        distance = std::max(distance, glm::dot(offset, backward) + reach);
    }
    camera.position = centre + distance * backward;
    camera.target = centre;
    camera.up = glm::vec3(0.0f, 1.0f, 0.0f);
    return camera;
}

}  // namespace duolux

#include "host/scene/image_plane.h"

#include <cmath>

namespace duolux {

// In double precision, so that each number is rounded once.
ImagePlane imagePlane(const Camera& camera, std::uint32_t width, std::uint32_t height) {
    const glm::dvec3 forward = glm::normalize(glm::dvec3(camera.target) - glm::dvec3(camera.position));
    const glm::dvec3 right = glm::normalize(glm::cross(forward, glm::dvec3(camera.up)));
    const double half = std::tan(glm::radians(static_cast<double>(camera.vfov)) / 2.0);
    const double aspect = static_cast<double>(width) / height;
    return {glm::vec3(forward), glm::vec3(right * (half * aspect)),
            glm::vec3(glm::cross(right, forward) * half), static_cast<float>(4.0 * half * half * aspect)};
}

}  // namespace duolux

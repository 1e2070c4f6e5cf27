#include "host/scene/image_plane.h"

#include <cmath>

namespace duolux {

namespace {

/// Half the height of the image plane.
double halfHeight(const Camera& camera) {
    switch (camera.type) {
        case CameraType::kPerspective:
            return std::tan(glm::radians(static_cast<double>(camera.vfov)) / 2.0);
        case CameraType::kOrthographic:
            return static_cast<double>(camera.height) / 2.0;
    }
    return 0.0;
}

}  // namespace

// Computed in double precision, so that each result is rounded once.
ImagePlane imagePlane(const Camera& camera, double aspect) {
    const glm::dvec3 forward = glm::normalize(glm::dvec3(camera.target) - glm::dvec3(camera.position));
    const glm::dvec3 right = glm::normalize(glm::cross(forward, glm::dvec3(camera.up)));
    const double half = halfHeight(camera);
    return {glm::vec3(forward), glm::vec3(right * (half * aspect)),
            glm::vec3(glm::cross(right, forward) * half), static_cast<float>(4.0 * half * half * aspect)};
}

ImagePlane imagePlane(const Camera& camera, std::uint32_t width, std::uint32_t height) {
    return imagePlane(camera, static_cast<double>(width) / height);
}

CameraRay cameraRay(const Camera& camera, const ImagePlane& plane, glm::vec2 point) {
    const glm::vec3 across = point.x * plane.right + point.y * plane.up;
    switch (camera.type) {
        case CameraType::kPerspective:
            return {camera.position, glm::normalize(plane.forward + across)};
        case CameraType::kOrthographic:
            return {camera.position + across, plane.forward};
    }
    return {};
}

bool hasParallelRays(CameraType type) {
    switch (type) {
        case CameraType::kPerspective:
            return false;
        case CameraType::kOrthographic:
            return true;
    }
    return false;
}

RayStart rayStart(const Camera& camera, const Bounds& bounds) {
    constexpr double kFar = 8.0;  // distance relative to the size of the scene
    const glm::dvec3 position(camera.position);
    const glm::dvec3 forward = glm::normalize(glm::dvec3(camera.target) - position);
    const glm::dvec3 lower = glm::dvec3(bounds.lower) - position, upper = glm::dvec3(bounds.upper) - position;
    // The depth of the corner of the bounds that is nearest along the axis.
    const double nearest =
        glm::dot(forward, glm::mix(upper, lower, glm::greaterThan(forward, glm::dvec3(0.0))));
    const double size = glm::length(upper - lower);
    if (!(nearest > kFar * size)) return {camera.position, 0.0f};
    const auto depth = static_cast<float>(nearest - size);
    return {glm::vec3(position + static_cast<double>(depth) * forward), depth};
}

}  // namespace duolux

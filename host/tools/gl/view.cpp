#include "host/tools/gl/view.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>

#include "host/scene/image_plane.h"

namespace duolux {

glm::vec2 jitterOf(std::uint32_t index) {
    constexpr double kPlastic = 1.32471795724474602596;  // the root of x^3 = x + 1
    const auto fraction = [](double x) {
        return std::min(static_cast<float>(x - std::floor(x)), 0.99999994f);
    };
    return {fraction(0.5 + index / kPlastic), fraction(0.5 + index / (kPlastic * kPlastic))};
}

glm::mat4 viewMatrix(const Camera& camera) {
    const ImagePlane plane = imagePlane(camera, 1.0);
    const glm::vec3 eye = cameraRay(camera, plane, glm::vec2(0.0f)).origin;
    const glm::mat3 axes =
        glm::transpose(glm::mat3(glm::normalize(plane.right), glm::normalize(plane.up), -plane.forward));
    glm::mat4 view(axes);
    view[3] = glm::vec4(-(axes * eye), 1.0f);
    return view;
}

glm::mat4 projectionMatrix(const Scene& scene, const RenderSettings& settings, glm::vec2 jitter,
                           const std::array<float, 4>& window) {
    const Camera& camera = scene.camera;
    const Bounds bounds = boundsOf(scene.geometry);
    const ImagePlane plane = imagePlane(camera, settings.width, settings.height);
    const glm::vec3 eye = cameraRay(camera, plane, glm::vec2(0.0f)).origin;
    float nearest = std::numeric_limits<float>::max();
    float farthest = 0.0f;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::vec3 p((corner & 1) != 0 ? bounds.upper.x : bounds.lower.x,
                          (corner & 2) != 0 ? bounds.upper.y : bounds.lower.y,
                          (corner & 4) != 0 ? bounds.upper.z : bounds.lower.z);
        const float depth = glm::dot(p - eye, plane.forward);
        nearest = std::min(nearest, depth);
        farthest = std::max(farthest, depth);
    }
    const float size = glm::length(bounds.upper - bounds.lower);
    farthest = std::max(farthest, size * 1e-3f) * 1.001f;
    nearest = std::max(nearest * 0.999f, farthest * 1e-4f);

    const float widening = hasParallelRays(camera.type) ? 1.0f : nearest;
    const float halfWidth = widening * glm::length(plane.right);
    const float halfHeight = widening * glm::length(plane.up);
    // Fragments are evaluated at pixel centres, so the image is shifted by the sample's offset from the
    // centre.
    const glm::vec2 moved =
        (jitter - 0.5f) / glm::vec2(settings.width, settings.height) * glm::vec2(window[2], window[3]);
    const auto x = [&](float fraction) { return (2.0f * (fraction + moved.x) - 1.0f) * halfWidth; };
    const auto y = [&](float fraction) { return (1.0f - 2.0f * (fraction + moved.y)) * halfHeight; };
    const float left = x(window[0]), right = x(window[0] + window[2]);
    const float bottom = y(window[1] + window[3]), top = y(window[1]);
    switch (camera.type) {
        case CameraType::kPerspective:
            return glm::frustum(left, right, bottom, top, nearest, farthest);
        case CameraType::kOrthographic:
            return glm::ortho(left, right, bottom, top, nearest, farthest);
    }
    return glm::mat4(1.0f);
}

}  // namespace duolux

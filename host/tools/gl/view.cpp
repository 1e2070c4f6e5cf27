#include "host/tools/gl/view.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>

namespace duolux {

glm::vec2 jitterOf(std::uint32_t index) {
    constexpr double kPlastic = 1.32471795724474602596;  // the root of x^3 = x + 1
    const auto fraction = [](double x) {
        return std::min(static_cast<float>(x - std::floor(x)), 0.99999994f);
    };
    return {fraction(0.5 + index / kPlastic), fraction(0.5 + index / (kPlastic * kPlastic))};
}

glm::mat4 viewMatrix(const Camera& camera) {
    return glm::lookAt(camera.position, camera.target, camera.up);
}

glm::mat4 projectionMatrix(const Scene& scene, const RenderSettings& settings, glm::vec2 jitter,
                           const std::array<float, 4>& window) {
    const Camera& camera = scene.camera;
    const Bounds bounds = boundsOf(scene.geometry);
    const glm::vec3 forward = glm::normalize(camera.target - camera.position);
    float nearest = std::numeric_limits<float>::max();
    float farthest = 0.0f;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::vec3 p((corner & 1) != 0 ? bounds.upper.x : bounds.lower.x,
                          (corner & 2) != 0 ? bounds.upper.y : bounds.lower.y,
                          (corner & 4) != 0 ? bounds.upper.z : bounds.lower.z);
        const float depth = glm::dot(p - camera.position, forward);
        nearest = std::min(nearest, depth);
        farthest = std::max(farthest, depth);
    }
    const float size = glm::length(bounds.upper - bounds.lower);
    farthest = std::max(farthest, size * 1e-3f) * 1.001f;
    nearest = std::max(nearest * 0.999f, farthest * 1e-4f);

    const float aspect = settings.aspect();
    const bool parallel = camera.type == CameraType::kOrthographic;
    const float halfHeight =
        parallel ? 0.5f * camera.height : std::tan(glm::radians(camera.vfov) / 2.0f) * nearest;
    const float halfWidth = halfHeight * aspect;
    // A fragment is computed at the centre of its pixel: the image is moved by what the sample is off it.
    const glm::vec2 moved =
        (jitter - 0.5f) / glm::vec2(settings.width, settings.height) * glm::vec2(window[2], window[3]);
    const auto x = [&](float fraction) { return (2.0f * (fraction + moved.x) - 1.0f) * halfWidth; };
    const auto y = [&](float fraction) { return (1.0f - 2.0f * (fraction + moved.y)) * halfHeight; };
    if (parallel) {
        return glm::ortho(x(window[0]), x(window[0] + window[2]), y(window[1] + window[3]), y(window[1]),
                          nearest, farthest);
    }
    return glm::frustum(x(window[0]), x(window[0] + window[2]), y(window[1] + window[3]), y(window[1]),
                        nearest, farthest);
}

}  // namespace duolux

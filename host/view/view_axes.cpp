#include "host/view/view_axes.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

namespace duolux {

namespace {

constexpr float kAzimuth = 30.0f, kElevation = 26.0f;  // of the preferred view, in degrees

}  // namespace

ViewAxes::ViewAxes(const glm::dvec3& upwards) : up(glm::normalize(upwards)) {
    const glm::vec3 ahead =
        std::abs(up.z) < 0.9f ? glm::vec3(0.0f, 0.0f, 1.0f) : glm::vec3(0.0f, -1.0f, 0.0f);
    front = glm::normalize(ahead - glm::dot(ahead, up) * up);
    right = glm::cross(up, front);
}

glm::vec3 ViewAxes::direction(float azimuth, float elevation) const {
    const float a = glm::radians(azimuth), e = glm::radians(elevation);
    return std::cos(e) * (std::cos(a) * front + std::sin(a) * right) + std::sin(e) * up;
}

glm::vec3 ViewAxes::upFor(const glm::vec3& forward) const {
    constexpr float kSmallestSine = 1e-3f;
    return glm::length(glm::cross(forward, up)) > kSmallestSine ? up : -front;
}

std::pair<glm::vec3, glm::vec3> ViewAxes::across(const glm::vec3& forward) const {
    const glm::vec3 cameraRight = glm::normalize(glm::cross(forward, upFor(forward)));
    return {cameraRight, glm::cross(cameraRight, forward)};
}

std::vector<OutsideDirection> outsideDirections(const ViewAxes& axes) {
    std::vector<OutsideDirection> directions;
    const glm::vec3 liked = axes.direction(kAzimuth, kElevation);
    const auto add = [&](float azimuth, float elevation, float preference) {
        const glm::vec3 direction = axes.direction(azimuth, elevation);
        const float angle = std::acos(glm::clamp(glm::dot(direction, liked), -1.0f, 1.0f));
        const float steep = std::max(0.0f, elevation - kElevation) / 90.0f;
        directions.push_back(
            {direction, preference * (1.0f - 0.15f * angle / glm::pi<float>() - 0.4f * steep)});
    };
    for (int k = 0; k < 12; ++k) {
        const float azimuth = 30.0f * static_cast<float>(k);
        const bool straight = k % 3 == 0;  // horizontal, as into an open box
        for (const float elevation : {straight ? 0.0f : 8.0f, 22.0f, 35.0f, 50.0f})
            add(azimuth, elevation, straight && elevation > 0.0f ? 0.93f : 1.0f);
        if (straight) {
            add(azimuth, 65.0f, 0.9f);  // into deep hollows
            add(azimuth + 30.0f, -25.0f, 0.35f);
        }
    }
    return directions;
}

std::vector<glm::vec3> lookAround(const ViewAxes& axes) {
    std::vector<glm::vec3> directions;
    for (int k = 0; k < 24; ++k)
        directions.push_back(axes.direction(15.0f * static_cast<float>(k), -4.0f));
    return directions;
}

glm::vec3 onSphere(int index, int count) {
    // A spherical Fibonacci lattice.
    const float z = 1.0f - (2.0f * static_cast<float>(index) + 1.0f) / static_cast<float>(count);
    const float phi = static_cast<float>(index) * glm::two_pi<float>() * 0.6180339887f;
    const float r = std::sqrt(std::max(0.0f, 1.0f - z * z));
    return {r * std::cos(phi), r * std::sin(phi), z};
}

}  // namespace duolux

#include "host/scene/camera_choice.h"

namespace duolux {

std::optional<CameraChoice::Contradiction> CameraChoice::contradiction() const {
    constexpr double kSmallestSine = 1e-4;
    const char* const across = "expected a vector that is not parallel to the view direction";
    if (up && *up == glm::dvec3(0.0)) return Contradiction{"up has no direction", across};
    switch (type.value_or(CameraType::kPerspective)) {
        case CameraType::kPerspective:
            if (!height) break;
            return Contradiction{"a perspective camera has no height",
                                 "expected \"vfov\", or \"type\": \"orthographic\""};
        case CameraType::kOrthographic:
            if (!vfov) break;
            return Contradiction{"an orthographic camera has no angle of view",
                                 "expected \"height\", the height of the image in scene units"};
    }
    if (!position || !target) return std::nullopt;
    const glm::dvec3 view = *target - *position;
    if (view == glm::dvec3(0.0)) {
        return Contradiction{"position and target are the same", "expected a target to look at"};
    }
    if (!up) return std::nullopt;
    const double sine = glm::length(glm::cross(view, *up)) / (glm::length(view) * glm::length(*up));
    if (sine >= kSmallestSine) return std::nullopt;
    return Contradiction{"up is parallel to the view direction", across};
}

}  // namespace duolux

#include "host/scene/camera_choice.h"

namespace duolux {

CameraChoice CameraChoice::overriddenBy(const CameraChoice& other) const {
    CameraChoice result = *this;
    // A camera with a further part does not compile until the part is added here.
    auto& [position0, target0, up0, vfov0, type0, height0, upwards0] = result;
    const auto& [position1, target1, up1, vfov1, type1, height1, upwards1] = other;
    static_cast<void>(upwards0);  // is a property of the scene
    static_cast<void>(upwards1);
    const auto take = [](auto& part, const auto& overriding) {
        if (overriding) part = overriding;
    };
    take(position0, position1);
    take(target0, target1);
    take(up0, up1);
    take(vfov0, vfov1);
    take(type0, type1);
    take(height0, height1);
    return result;
}

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

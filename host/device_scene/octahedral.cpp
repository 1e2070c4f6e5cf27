#include "host/device_scene/octahedral.h"

#include <algorithm>
#include <cmath>

namespace duolux {

std::uint32_t octahedralEncode(glm::vec3 n) {
    n /= std::abs(n.x) + std::abs(n.y) + std::abs(n.z);
    glm::vec2 e(n.x, n.y);
    if (n.z < 0.0f) {
        e = {(1.0f - std::abs(n.y)) * (n.x >= 0.0f ? 1.0f : -1.0f),
             (1.0f - std::abs(n.x)) * (n.y >= 0.0f ? 1.0f : -1.0f)};
    }
    const auto snorm = [](float x) {
        return static_cast<std::uint32_t>(std::lround(glm::clamp(x, -1.0f, 1.0f) * 32767.0f)) & 0xffffu;
    };
    return snorm(e.x) | snorm(e.y) << 16;
}

glm::vec3 octahedralDecode(std::uint32_t bits) {
    const auto snorm = [](std::uint32_t half) {
        return static_cast<float>(static_cast<std::int16_t>(half)) * (1.0f / 32767.0f);
    };
    const glm::vec2 e(snorm(bits & 0xffffu), snorm(bits >> 16));
    glm::vec3 n(e, 1.0f - std::abs(e.x) - std::abs(e.y));
    const float fold = std::max(-n.z, 0.0f);
    n.x += n.x >= 0.0f ? -fold : fold;
    n.y += n.y >= 0.0f ? -fold : fold;
    return glm::normalize(n);
}

}  // namespace duolux

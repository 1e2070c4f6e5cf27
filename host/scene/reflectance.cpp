#include "host/scene/reflectance.h"

#include <fmt/format.h>

#include <array>

namespace duolux {

Reflectance blendReflectance(float t, float o) {
    Reflectance reflectance;
    reflectance.opaque.m00 = glm::vec3(o);
    reflectance.opaque.m10 = glm::vec3(1.0f);
    reflectance.transparent.m00 = glm::vec3(t);
    return reflectance;
}

std::span<const Preset> presets() {
    static constexpr std::array<Preset, 4> kPresets{{{"local", 1.0f, 0.0f},
                                                     {"global", 0.0f, 1.0f},
                                                     {"shadowless", 1.0f, 1.0f},
                                                     {"one-bounce", 0.0f, 0.0f}}};
    return kPresets;
}

std::optional<Reflectance> presetReflectance(std::string_view name) {
    for (const Preset& preset : presets()) {
        if (preset.name == name) return blendReflectance(preset.t, preset.o);
    }
    return std::nullopt;
}

std::string describeReflectance(const Reflectance& reflectance) {
    for (const Preset& preset : presets()) {
        if (reflectance == blendReflectance(preset.t, preset.o)) return std::string(preset.name);
    }
    const float t = reflectance.transparent.m00.x;
    const float o = reflectance.opaque.m00.x;
    if (reflectance == blendReflectance(t, o)) return fmt::format("blend {},{}", t, o);
    return "matrices";
}

}  // namespace duolux

#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace duolux {

/// A 2x2 matrix per colour channel: entry ij maps component j to component i, 0 = invisible, 1 = visible;
/// each entry holds the three channels (r, g, b). Entries are finite and >= 0.
struct ReflectanceMatrix {
    glm::vec3 m00{0.0f}, m01{0.0f}, m10{0.0f}, m11{0.0f};

    bool operator==(const ReflectanceMatrix&) const = default;
};

/// F = opaque f_opaque + transparent f_transp (theory of the paper's eqs. 14-23 in its general form).
struct Reflectance {
    ReflectanceMatrix opaque;
    ReflectanceMatrix transparent;

    bool operator==(const Reflectance&) const = default;
};

/// The point (t, o) of the reflectance square: O = [[o,0],[1,0]], T = [[t,0],[0,0]]. t and o are >= 0.
Reflectance blendReflectance(float t, float o);

struct Preset {
    std::string_view name;
    float t, o;
};

/// local (eq. 14), global (eq. 19), shadowless (eq. 21), one-bounce (eq. 23).
std::span<const Preset> presets();

/// Empty if there is no preset with this name.
std::optional<Reflectance> presetReflectance(std::string_view name);

/// "local", "blend 0.5,0.25" or "matrices": the name of the reflectance in reports and metadata.
std::string describeReflectance(const Reflectance& reflectance);

}  // namespace duolux

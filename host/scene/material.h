#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <string>

#include "host/scene/reflectance.h"

namespace duolux {

enum class Sides : std::uint8_t { kFront, kBoth };

/// "front" or "both".
const char* nameOf(Sides sides);

/// Radiance that a surface emits, in W sr^-1 m^-2 (scene units), components >= 0 (paper, eq. 9).
struct Emission {
    glm::vec3 invisible{0.0f};
    glm::vec3 visible{0.0f};
    Sides sides = Sides::kFront;

    bool any() const { return glm::any(glm::greaterThan(invisible + visible, glm::vec3(0.0f))); }
    bool operator==(const Emission&) const = default;
};

/// f_opaque and what the surface emits. Today's BSDF is diffuse: f_opaque = diffuse / pi.
struct Material {
    std::string name;
    glm::vec3 diffuse{0.8f};     ///< albedo per channel, 0..1
    Sides sides = Sides::kBoth;  ///< kFront: f_opaque acts only on the side the winding makes the front
    Emission emission;
    std::optional<Reflectance> reflectance;  ///< overrides the scene's reflectance if set

    bool operator==(const Material&) const = default;
};

/// Calls visit(name, field) for every field of a material but its name, in the order that people read: what
/// hashes, compares or shows materials goes by this list. A field that is missing here does not compile.
template <typename Visit>
void forEachField(const Material& material, Visit&& visit) {
    const auto& [name, diffuse, sides, emission, reflectance] = material;
    static_cast<void>(name);
    visit("diffuse", diffuse);
    visit("sides", sides);
    visit("emission", emission);
    visit("reflectance", reflectance);
}

}  // namespace duolux

#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <string>

#include "host/base/named.h"
#include "host/scene/reflectance.h"

namespace duolux {

enum class Sides : std::uint8_t { kFront, kBoth };

/// "front" or "both".
const char* nameOf(Sides sides);
template <>
inline constexpr std::array kValuesOf<Sides>{Sides::kFront, Sides::kBoth};

/// Radiance that a surface emits, in W sr^-1 m^-2 (scene units), components >= 0 (paper, eq. 9).
struct Emission {
    glm::vec3 invisible{0.0f};
    glm::vec3 visible{0.0f};
    Sides sides = Sides::kFront;

    bool any() const { return glm::any(glm::greaterThan(invisible + visible, glm::vec3(0.0f))); }
    bool operator==(const Emission&) const = default;
};

/// f_opaque and what the surface emits. f_opaque is a mixture of a diffuse and a metallic BSDF
/// (shaders/lib/bsdf/), the base of glTF 2.0's metallic-roughness model.
struct Material {
    std::string name;
    glm::vec3 baseColor{0.8f};   ///< 0..1: diffuse albedo, and a metal's reflectance at normal incidence
    float metallic = 0.0f;       ///< 0..1: the fraction of metal
    float roughness = 1.0f;      ///< 0..1, of the metal: the square root of GGX's alpha
    Sides sides = Sides::kBoth;  ///< kFront: f_opaque acts only on the side the winding makes the front
    Emission emission;
    std::optional<Reflectance> reflectance;  ///< overrides the scene's reflectance if set

    bool operator==(const Material&) const = default;
};

/// Calls visit(name, field) for every field of a material but its name, in the order that people read: what
/// hashes, compares or shows materials goes by this list. A field that is missing here does not compile.
template <typename Visit>
void forEachField(const Material& material, Visit&& visit) {
    const auto& [name, baseColor, metallic, roughness, sides, emission, reflectance] = material;
    static_cast<void>(name);
    visit("base_color", baseColor);
    visit("metallic", metallic);
    visit("roughness", roughness);
    visit("sides", sides);
    visit("emission", emission);
    visit("reflectance", reflectance);
}

/// The fraction of uniform light that f_opaque returns, per channel: for metals the mean of Schlick's Fresnel
/// reflectance, b + (1 - b) / 21.
inline glm::vec3 meanAlbedo(const Material& material) {
    const glm::vec3 metal = material.baseColor + (1.0f - material.baseColor) / 21.0f;
    return material.metallic > 0.0f ? glm::mix(material.baseColor, metal, material.metallic)
                                    : material.baseColor;
}

}  // namespace duolux

#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "host/base/named.h"
#include "host/scene/reflectance.h"
#include "host/scene/texture.h"

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

enum class AlphaMode : std::uint8_t {
    kOpaque,  ///< alpha is ignored
    kMask,    ///< the surface is there where alpha >= Alpha::cutoff
    kBlend    ///< the surface is there with the fraction alpha
};

/// "opaque", "mask" or "blend".
const char* nameOf(AlphaMode mode);
template <>
inline constexpr std::array kValuesOf<AlphaMode>{AlphaMode::kOpaque, AlphaMode::kMask, AlphaMode::kBlend};

/// Coverage: how much of the surface is there. Light passes through the rest unchanged.
struct Alpha {
    AlphaMode mode = AlphaMode::kOpaque;
    float value = 1.0f;   ///< fraction
    float cutoff = 0.5f;  ///< >= 0

    bool operator==(const Alpha&) const = default;
};

/// What an image may scale. Normals have no numbers of their own: they bend the shading normal, of the
/// clearcoat or of what is below it.
enum class MaterialInput : std::uint8_t {
    kBaseColor,
    kAlpha,
    kMetallic,
    kRoughness,
    kSpecular,
    kSpecularColor,
    kTransmission,
    kClearcoat,
    kClearcoatRoughness,
    kSheenColor,
    kSheenRoughness,
    kAnisotropy,  ///< red and green: direction in tangent space, blue: strength
    kNormal,
    kEmission,
    kClearcoatNormal
};

/// "base_color", "alpha" ..., as in scene files.
const char* nameOf(MaterialInput input);
template <>
inline constexpr std::array kValuesOf<MaterialInput>{
    MaterialInput::kBaseColor,    MaterialInput::kAlpha,          MaterialInput::kMetallic,
    MaterialInput::kRoughness,    MaterialInput::kSpecular,       MaterialInput::kSpecularColor,
    MaterialInput::kTransmission, MaterialInput::kClearcoat,      MaterialInput::kClearcoatRoughness,
    MaterialInput::kSheenColor,   MaterialInput::kSheenRoughness, MaterialInput::kAnisotropy,
    MaterialInput::kNormal,       MaterialInput::kEmission,       MaterialInput::kClearcoatNormal};

struct MaterialTexture {
    MaterialInput input = MaterialInput::kBaseColor;
    Texture texture;
    std::uint32_t channel = 0;  ///< 0..3: red, green, blue, alpha; of inputs that are one number

    bool operator==(const MaterialTexture&) const = default;
};

/// f_opaque, coverage, and what the surface emits: glTF 2.0's metallic-roughness model with its extensions
/// (Khronos, "glTF 2.0 Specification", appendix B). Fractions are from 0 to 1.
struct Material {
    std::string name;
    glm::vec3 baseColor{0.8f};  ///< fraction: diffuse albedo, and a metal's reflectance at normal incidence
    float metallic = 0.0f;      ///< the fraction of metal
    float roughness = 1.0f;     ///< fraction: the square root of GGX's alpha
    float ior = 1.5f;           ///< index of refraction of the dielectric, 1..kLargestIor
    float specular = 0.0f;      ///< fraction of the dielectric's reflection
    glm::vec3 specularColor{1.0f};  ///< scales the dielectric's reflectance at normal incidence, >= 0
    float transmission = 0.0f;      ///< the fraction of the light that enters the dielectric and is refracted
    bool thin = false;  ///< refraction through a wall without thickness: no bending, no attenuation
    glm::vec3 attenuationColor{1.0f};  ///< fraction: what is left of white light after attenuationDistance
    float attenuationDistance = std::numeric_limits<float>::infinity();  ///< scene units, > 0
    float clearcoat = 0.0f;                                              ///< fraction
    float clearcoatRoughness = 0.0f;                                     ///< fraction
    glm::vec3 sheenColor{0.0f};                                          ///< fraction
    float sheenRoughness = 0.0f;                                         ///< fraction
    float anisotropy = 0.0f;          ///< fraction: stretches reflections along the tangent
    float anisotropyRotation = 0.0f;  ///< degrees, counter-clockwise from the tangent
    Alpha alpha;
    float normalScale = 1.0f;           ///< of the x and y of normals in the image
    float clearcoatNormalScale = 1.0f;  ///< the same of those of the clearcoat
    Sides sides = Sides::kBoth;  ///< kFront: f_opaque acts only on the side the winding makes the front
    Emission emission;
    bool unlit = false;                      ///< colours of vertices scale the emission, too
    std::optional<Reflectance> reflectance;  ///< overrides the scene's reflectance if set
    std::vector<MaterialTexture> textures;   ///< at most one per input, ascending

    static constexpr float kLargestIor = 10.0f;

    bool operator==(const Material&) const = default;
};

inline bool hasTexture(const Material& material, MaterialInput input) {
    for (const MaterialTexture& texture : material.textures) {
        if (texture.input == input) return true;
    }
    return false;
}

/// Whether the whole surface has the base colour and reflects it diffusely, without images. All fields by
/// name: a further one does not compile until it is handled here.
bool isPlainDiffuse(const Material& material);

/// Calls visit(name, field) for every field of a material but its name, in the order that people read: what
/// hashes, compares or shows materials goes by this list. A field that is missing here does not compile.
template <typename Visit>
void forEachField(const Material& material, Visit&& visit) {
    const auto& [name, baseColor, metallic, roughness, ior, specular, specularColor, transmission, thin,
                 attenuationColor, attenuationDistance, clearcoat, clearcoatRoughness, sheenColor,
                 sheenRoughness, anisotropy, anisotropyRotation, alpha, normalScale, clearcoatNormalScale,
                 sides, emission, unlit, reflectance, textures] = material;
    static_cast<void>(name);
    visit("base_color", baseColor);
    visit("metallic", metallic);
    visit("roughness", roughness);
    visit("ior", ior);
    visit("specular", specular);
    visit("specular_color", specularColor);
    visit("transmission", transmission);
    visit("thin", thin);
    visit("attenuation_color", attenuationColor);
    visit("attenuation_distance", attenuationDistance);
    visit("clearcoat", clearcoat);
    visit("clearcoat_roughness", clearcoatRoughness);
    visit("sheen_color", sheenColor);
    visit("sheen_roughness", sheenRoughness);
    visit("anisotropy", anisotropy);
    visit("anisotropy_rotation", anisotropyRotation);
    visit("alpha", alpha);
    visit("normal", normalScale);
    visit("clearcoat_normal", clearcoatNormalScale);
    visit("sides", sides);
    visit("emission", emission);
    visit("unlit", unlit);
    visit("reflectance", reflectance);
    visit("textures", textures);
}

}  // namespace duolux

#include "host/loaders/json_surface.h"

#include <fmt/format.h>

#include <algorithm>
#include <initializer_list>
#include <optional>
#include <string>
#include <vector>

#include "host/scene/mesh.h"

namespace duolux {

namespace {

constexpr double kLargestFactor = 1e6;
constexpr double kLargestAngle = 1e6;  // degrees

ReflectanceMatrix readMatrix(const JsonNode& node) {
    const char* const shape = "expected [[m00, m01], [m10, m11]]";
    const std::string entry = fmt::format("expected a number or [r, g, b], from 0 to {:g}", kLargestFactor);
    const std::vector<JsonNode> rows = node.elements(shape, 2);
    const std::vector<JsonNode> invisible = rows[0].elements(shape, 2);
    const std::vector<JsonNode> visible = rows[1].elements(shape, 2);
    return {invisible[0].colour(0.0, kLargestFactor, entry), invisible[1].colour(0.0, kLargestFactor, entry),
            visible[0].colour(0.0, kLargestFactor, entry), visible[1].colour(0.0, kLargestFactor, entry)};
}

Reflectance readPreset(const JsonNode& node) {
    std::vector<std::string> names;
    for (const Preset& preset : presets())
        names.emplace_back(preset.name);
    const Preset& preset = presets()[node.choice(names)];
    return blendReflectance(preset.t, preset.o);
}

Reflectance readBlend(const JsonNode& node) {
    const std::string remedy = "expected [t, o], two numbers from 0 to 1";
    const std::vector<JsonNode> point = node.elements(remedy, 2);
    return blendReflectance(static_cast<float>(point[0].number(0.0, 1.0, remedy)),
                            static_cast<float>(point[1].number(0.0, 1.0, remedy)));
}

/// What is not given is left as it is.
void readComponents(const JsonNode& node, const char* quantity, glm::vec3& invisible, glm::vec3& visible) {
    const std::string remedy =
        fmt::format("expected {}: a number or [r, g, b], from 0 to {:g}", quantity, kLargestRadiance);
    if (const auto value = node.find("invisible")) invisible = value->colour(0.0, kLargestRadiance, remedy);
    if (const auto value = node.find("visible")) visible = value->colour(0.0, kLargestRadiance, remedy);
}

}  // namespace

Reflectance readReflectance(const JsonNode& node) {
    const char* const kinds =
        R"(expected {"preset": name}, {"blend": [t, o]} or {"opaque": M, "transparent": M})";
    node.expectKeys({"preset", "blend", "opaque", "transparent"});
    const std::optional<JsonNode> preset = node.find("preset");
    const std::optional<JsonNode> blend = node.find("blend");
    const bool matrices = node.find("opaque") || node.find("transparent");
    const int given = (preset ? 1 : 0) + (blend ? 1 : 0) + (matrices ? 1 : 0);
    if (given == 0) node.fail("is empty", kinds);
    if (given > 1) node.fail("mixes several kinds", kinds);
    if (preset) return readPreset(*preset);
    if (blend) return readBlend(*blend);
    Reflectance reflectance;
    reflectance.opaque = readMatrix(node.require("opaque", kinds));
    reflectance.transparent = readMatrix(node.require("transparent", kinds));
    return reflectance;
}

void readEmission(const JsonNode& node, Emission& emission) {
    node.expectKeys({"invisible", "visible", "sides"});
    readComponents(node, "a radiance", emission.invisible, emission.visible);
    if (const auto sides = node.find("sides")) emission.sides = sides->choice<Sides>();
}

void readIntensity(const JsonNode& node, PointEmitter& emitter) {
    node.expectKeys({"invisible", "visible"});
    readComponents(node, "a radiant intensity", emitter.invisible, emitter.visible);
}

namespace {

/// Reads the numbers of a material that are given.
class MaterialReader {
  public:
    explicit MaterialReader(const JsonNode& node) : node_(node) {}

    void fraction(const char* key, float& field) const {
        number(key, 0.0, 1.0, "expected a number from 0 to 1", field);
    }
    void number(const char* key, double low, double high, const std::string& remedy, float& field) const {
        if (const auto value = node_.find(key)) field = static_cast<float>(value->number(low, high, remedy));
    }
    void colour(const char* key, double high, const std::string& remedy, glm::vec3& field) const {
        if (const auto value = node_.find(key)) field = value->colour(0.0, high, remedy);
    }
    bool has(std::initializer_list<const char*> keys) const {
        return std::any_of(keys.begin(), keys.end(),
                           [&](const char* key) { return node_.find(key).has_value(); });
    }

  private:
    const JsonNode& node_;
};

void readAlpha(const JsonNode& node, Alpha& alpha) {
    node.expectKeys({"mode", "value", "cutoff"});
    if (const auto mode = node.find("mode")) alpha.mode = mode->choice<AlphaMode>();
    MaterialReader(node).fraction("value", alpha.value);
    MaterialReader(node).number("cutoff", 0.0, kLargestFactor, "expected a number from 0", alpha.cutoff);
}

}  // namespace

void readMaterial(const JsonNode& node, Material& material) {
    node.expectKeys({"alpha",
                     "anisotropy",
                     "anisotropy_rotation",
                     "attenuation_color",
                     "attenuation_distance",
                     "base_color",
                     "clearcoat",
                     "clearcoat_roughness",
                     "diffuse",
                     "emission",
                     "ior",
                     "metallic",
                     "normal",
                     "reflectance",
                     "roughness",
                     "sheen_color",
                     "sheen_roughness",
                     "sides",
                     "specular",
                     "specular_color",
                     "thin",
                     "transmission"});
    const MaterialReader reader(node);
    const auto baseColor = node.find("base_color"), diffuse = node.find("diffuse");
    if (baseColor && diffuse) diffuse->fail("is another name of base_color", "expected one of the two");
    const std::string albedo = "expected an albedo: a number or [r, g, b], from 0 to 1";
    const std::string fractions = "expected a number or [r, g, b], from 0 to 1";
    reader.colour(diffuse ? "diffuse" : "base_color", 1.0, albedo, material.baseColor);
    reader.fraction("metallic", material.metallic);
    reader.fraction("roughness", material.roughness);
    reader.number("ior", 1.0, static_cast<double>(Material::kLargestIor),
                  fmt::format("expected an index of refraction from 1 to {}", Material::kLargestIor),
                  material.ior);
    // Whoever describes the surface of a dielectric wants it to reflect.
    if (reader.has({"roughness", "ior", "specular_color", "transmission", "anisotropy"}))
        material.specular = 1.0f;
    reader.fraction("specular", material.specular);
    reader.colour("specular_color", kLargestFactor,
                  fmt::format("expected a number or [r, g, b], from 0 to {:g}", kLargestFactor),
                  material.specularColor);
    reader.fraction("transmission", material.transmission);
    if (const auto thin = node.find("thin")) material.thin = thin->boolean();
    reader.colour("attenuation_color", 1.0, fractions, material.attenuationColor);
    if (const auto distance = node.find("attenuation_distance")) {
        const char* const remedy = "expected a distance in scene units, above 0";
        material.attenuationDistance =
            static_cast<float>(distance->number(0.0, static_cast<double>(kLargestCoordinate), remedy));
        if (!(material.attenuationDistance > 0.0f)) distance->failValue(remedy);
    }
    reader.fraction("clearcoat", material.clearcoat);
    reader.fraction("clearcoat_roughness", material.clearcoatRoughness);
    reader.colour("sheen_color", 1.0, fractions, material.sheenColor);
    reader.fraction("sheen_roughness", material.sheenRoughness);
    reader.fraction("anisotropy", material.anisotropy);
    reader.number("anisotropy_rotation", -kLargestAngle, kLargestAngle, "expected an angle in degrees",
                  material.anisotropyRotation);
    if (const auto alpha = node.find("alpha")) readAlpha(*alpha, material.alpha);
    if (const auto emission = node.find("emission")) readEmission(*emission, material.emission);
    if (const auto reflectance = node.find("reflectance"))
        material.reflectance = readReflectance(*reflectance);
    if (const auto sides = node.find("sides")) material.sides = sides->choice<Sides>();
}

}  // namespace duolux

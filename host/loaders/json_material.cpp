#include "host/loaders/json_material.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <initializer_list>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "host/loaders/json_surface.h"
#include "host/scene/material_textures.h"
#include "host/scene/mesh.h"

namespace duolux {

namespace {

constexpr double kLargestScale = 1e6;
constexpr double kLargestTurn = 1e6;  // degrees

constexpr const char* kOrImage = R"(, or {"image": file})";
constexpr const char* kFraction = "expected a number from 0 to 1";

/// Reads the properties of a material that are given.
class JsonMaterialReader {
  public:
    JsonMaterialReader(const JsonNode& node, Material& material, JsonImages& images)
        : node_(node), material_(material), images_(images) {}

    bool has(std::initializer_list<const char*> keys) const {
        return std::any_of(keys.begin(), keys.end(),
                           [&](const char* key) { return node_.find(key).has_value(); });
    }

    void number(const char* key, double low, double high, const std::string& remedy, float& field) const {
        if (const auto value = node_.find(key)) field = static_cast<float>(value->number(low, high, remedy));
    }

    void colour(const char* key, double high, const std::string& remedy, glm::vec3& field) const {
        if (const auto value = node_.find(key)) field = value->colour(0.0, high, remedy);
    }

    /// A fraction, or the channel of an image that a fraction scales.
    void fraction(const char* key, MaterialInput input, float& field) const {
        const auto value = node_.find(key);
        if (!value) return;
        if (!isImage(*value, kFraction)) {
            field = static_cast<float>(value->number(0.0, 1.0, std::string(kFraction) + kOrImage));
            removeTexture(material_, input);
            return;
        }
        // The channels of an anisotropy image have meanings of their own.
        const bool hasChannel = input != MaterialInput::kAnisotropy;
        MaterialTexture texture{input, {}, 0};
        texture.texture = hasChannel
                              ? readTexture(*value, ColourSpace::kLinear, images_, {"factor", "channel"})
                              : readTexture(*value, ColourSpace::kLinear, images_, {"factor"});
        static const std::array<std::string, 4> kChannels{"r", "g", "b", "a"};
        if (const auto channel = value->find("channel"))
            texture.channel = static_cast<std::uint32_t>(channel->choice(kChannels));
        const auto factor = value->find("factor");
        field = factor ? static_cast<float>(factor->number(0.0, 1.0, kFraction)) : 1.0f;
        setTexture(material_, texture);
    }

    /// A colour, or an image that a colour scales.
    void colour(const char* key, MaterialInput input, double high, const std::string& remedy,
                glm::vec3& field) const {
        const auto value = node_.find(key);
        if (!value) return;
        if (!isImage(*value, remedy)) {
            field = value->colour(0.0, high, remedy + kOrImage);
            removeTexture(material_, input);
            return;
        }
        setTexture(material_, {input, colourTexture(*value, high, remedy, field), 0});
    }

    /// {"image": FILE, "scale": number}; the scale alone is that of the image in the mesh file.
    void normal(const char* key, MaterialInput input, float& field) const {
        const auto value = node_.find(key);
        if (!value) return;
        const char* const remedy = R"(expected {"image": file, "scale": number})";
        if (!value->isObject() || !(value->find("image") || value->find("scale"))) value->failValue(remedy);
        if (value->find("image")) {
            field = 1.0f;
            setTexture(material_, {input, readTexture(*value, ColourSpace::kLinear, images_, {"scale"}), 0});
        } else {
            value->expectKeys({"image", "scale"});
            if (findTexture(material_, input) == nullptr)
                value->fail("scales an image that the material does not have", remedy);
        }
        JsonMaterialReader(*value, material_, images_)
            .number("scale", -kLargestScale, kLargestScale,
                    fmt::format("expected a number of at most {:g} in magnitude", kLargestScale), field);
    }

    void alpha() const {
        const auto value = node_.find("alpha");
        if (!value) return;
        value->expectKeys({"mode", "value", "cutoff"});
        const JsonMaterialReader reader(*value, material_, images_);
        reader.fraction("value", MaterialInput::kAlpha, material_.alpha.value);
        reader.number("cutoff", 0.0, kLargestScale,
                      fmt::format("expected a number from 0 to {:g}", kLargestScale), material_.alpha.cutoff);
        if (const auto mode = value->find("mode")) {
            material_.alpha.mode = mode->choice<AlphaMode>();
        } else if (material_.alpha.mode == AlphaMode::kOpaque) {
            // Whoever states an alpha wants it to have an effect.
            if (reader.has({"value"})) material_.alpha.mode = AlphaMode::kBlend;
            if (reader.has({"cutoff"})) material_.alpha.mode = AlphaMode::kMask;
        }
    }

    /// Both components share an image.
    void emission() const {
        const auto value = node_.find("emission");
        if (!value) return;
        value->expectKeys({"invisible", "visible", "sides"});
        Emission& emission = material_.emission;
        const std::string remedy =
            fmt::format("expected a radiance: a number or [r, g, b], from 0 to {:g}", kLargestRadiance);
        std::optional<Texture> shared;
        std::optional<JsonNode> plain;  // a component that is a number above 0
        for (const auto& [key, radiance] :
             {std::pair<const char*, glm::vec3*>("invisible", &emission.invisible),
              std::pair<const char*, glm::vec3*>("visible", &emission.visible)}) {
            const auto component = value->find(key);
            if (!component) continue;
            if (!isImage(*component, remedy)) {
                *radiance = component->colour(0.0, kLargestRadiance, remedy + kOrImage);
                if (*radiance != glm::vec3(0.0f)) plain = component;
                continue;
            }
            const Texture texture = colourTexture(*component, kLargestRadiance, remedy, *radiance);
            if (shared && texture != *shared) {
                component->fail("is another image than that of the other component",
                                "expected one image for both, with the same coordinates");
            }
            shared = texture;
        }
        if (shared && plain) {
            plain->fail("is a number beside an image for the other component",
                        "expected the same image with a \"factor\", or 0");
        }
        if (shared) setTexture(material_, {MaterialInput::kEmission, *shared, 0});
        if (plain) removeTexture(material_, MaterialInput::kEmission);
        if (const auto sides = value->find("sides")) emission.sides = sides->choice<Sides>();
    }

  private:
    /// Whether a value is an image; fails for other objects.
    static bool isImage(const JsonNode& value, const std::string& remedy) {
        if (!value.isObject()) return false;
        if (!value.find("image")) value.failValue(remedy + kOrImage);
        return true;
    }

    Texture colourTexture(const JsonNode& value, double high, const std::string& remedy,
                          glm::vec3& field) const {
        Texture texture = readTexture(value, ColourSpace::kSrgb, images_, {"factor"});
        const auto factor = value.find("factor");
        field = factor ? factor->colour(0.0, high, remedy) : glm::vec3(1.0f);
        return texture;
    }

    const JsonNode& node_;
    Material& material_;
    JsonImages& images_;
};

}  // namespace

void readMaterial(const JsonNode& node, Material& material, JsonImages& images) {
    node.expectKeys({"alpha",
                     "anisotropy",
                     "anisotropy_rotation",
                     "attenuation_color",
                     "attenuation_distance",
                     "base_color",
                     "clearcoat",
                     "clearcoat_normal",
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
                     "transmission",
                     "unlit"});
    const JsonMaterialReader reader(node, material, images);
    const auto baseColor = node.find("base_color"), diffuse = node.find("diffuse");
    if (baseColor && diffuse) diffuse->fail("is another name of base_color", "expected one of the two");
    const std::string albedo = "expected an albedo: a number or [r, g, b], from 0 to 1";
    const std::string fractions = "expected a number or [r, g, b], from 0 to 1";
    reader.colour(diffuse ? "diffuse" : "base_color", MaterialInput::kBaseColor, 1.0, albedo,
                  material.baseColor);
    reader.fraction("metallic", MaterialInput::kMetallic, material.metallic);
    reader.fraction("roughness", MaterialInput::kRoughness, material.roughness);
    reader.number("ior", 1.0, static_cast<double>(Material::kLargestIor),
                  fmt::format("expected an index of refraction from 1 to {}", Material::kLargestIor),
                  material.ior);
    // Whoever describes the surface of a dielectric wants it to reflect.
    if (reader.has({"roughness", "ior", "specular_color", "transmission", "anisotropy"}))
        material.specular = 1.0f;
    reader.fraction("specular", MaterialInput::kSpecular, material.specular);
    reader.colour("specular_color", MaterialInput::kSpecularColor, kLargestScale,
                  fmt::format("expected a number or [r, g, b], from 0 to {:g}", kLargestScale),
                  material.specularColor);
    reader.fraction("transmission", MaterialInput::kTransmission, material.transmission);
    if (const auto thin = node.find("thin")) material.thin = thin->boolean();
    reader.colour("attenuation_color", 1.0, fractions, material.attenuationColor);
    if (const auto distance = node.find("attenuation_distance")) {
        const char* const remedy = "expected a distance in scene units, above 0";
        material.attenuationDistance =
            static_cast<float>(distance->number(0.0, static_cast<double>(kLargestCoordinate), remedy));
        if (!(material.attenuationDistance > 0.0f)) distance->failValue(remedy);
    }
    reader.fraction("clearcoat", MaterialInput::kClearcoat, material.clearcoat);
    reader.fraction("clearcoat_roughness", MaterialInput::kClearcoatRoughness, material.clearcoatRoughness);
    reader.colour("sheen_color", MaterialInput::kSheenColor, 1.0, fractions, material.sheenColor);
    reader.fraction("sheen_roughness", MaterialInput::kSheenRoughness, material.sheenRoughness);
    reader.fraction("anisotropy", MaterialInput::kAnisotropy, material.anisotropy);
    reader.number("anisotropy_rotation", -kLargestTurn, kLargestTurn, "expected an angle in degrees",
                  material.anisotropyRotation);
    reader.normal("normal", MaterialInput::kNormal, material.normalScale);
    reader.normal("clearcoat_normal", MaterialInput::kClearcoatNormal, material.clearcoatNormalScale);
    reader.alpha();
    reader.emission();
    if (const auto unlit = node.find("unlit")) material.unlit = unlit->boolean();
    if (const auto reflectance = node.find("reflectance"))
        material.reflectance = readReflectance(*reflectance);
    if (const auto sides = node.find("sides")) material.sides = sides->choice<Sides>();
}

}  // namespace duolux

#include "host/loaders/gltf_material.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "host/scene/mesh.h"

namespace duolux {

namespace {

constexpr double kAnything = std::numeric_limits<double>::max();
constexpr double kLargestFactor = 1e6;
constexpr float kDefaultReflectance = 0.04f;  // at normal incidence, of an index of refraction of 1.5

/// The channels of an image.
constexpr std::uint32_t kRed = 0, kGreen = 1, kBlue = 2, kAlphaChannel = 3;

class GltfMaterialReader {
  public:
    GltfMaterialReader(const JsonNode& node, GltfTextures& textures, GltfNotes& notes)
        : node_(node), textures_(textures), notes_(notes) {}

    Material run(std::uint32_t index) {
        material_ = defaultGltfMaterial();
        material_.name = gltfMaterialName(node_, index);
        readAlpha();
        const auto old = extensionOf(node_, "KHR_materials_pbrSpecularGlossiness");
        if (old) readSpecularGlossiness(*old);
        if (const auto pbr = node_.find("pbrMetallicRoughness"); pbr && !old) readPbr(*pbr);
        normalTexture(node_, "normalTexture", MaterialInput::kNormal, material_.normalScale);
        readEmission();
        readDielectric();
        readVolume();
        readCoats();
        if (extensionOf(node_, "KHR_materials_unlit")) makeUnlit();
        std::sort(material_.textures.begin(), material_.textures.end(),
                  [](const auto& a, const auto& b) { return a.input < b.input; });
        return std::move(material_);
    }

  private:
    /// A number that should be in [low, high].
    double clamped(const JsonNode& value, double low, double high, const std::string& remedy) {
        const double number = value.number(-kAnything, kAnything, remedy);
        if (number < low || number > high)
            notes_.tolerate(value, "a factor is out of range", remedy,
                            "the nearest that is possible is used");
        return std::clamp(number, low, high);
    }

    void fraction(const JsonNode& node, const char* key, float& field) {
        if (const auto value = node.find(key))
            field = static_cast<float>(clamped(*value, 0.0, 1.0, "expected a number from 0 to 1"));
    }

    glm::vec3 colourOf(const JsonNode& value, std::size_t count, double high) {
        const std::string remedy = fmt::format("expected {} numbers from 0 to {:g}", count, high);
        const std::vector<JsonNode> numbers = value.elements(remedy, count);
        glm::vec3 colour;
        for (int i = 0; i < 3; ++i)
            colour[i] = static_cast<float>(clamped(numbers[static_cast<std::size_t>(i)], 0.0, high, remedy));
        return colour;
    }

    void colour(const JsonNode& node, const char* key, double high, glm::vec3& field) {
        if (const auto value = node.find(key)) field = colourOf(*value, 3, high);
    }

    void texture(const JsonNode& node, const char* key, MaterialInput input, std::uint32_t channel = kRed,
                 ColourSpace colourSpace = ColourSpace::kLinear, const ImageConversion& conversion = {}) {
        const auto info = node.find(key);
        if (!info) return;
        if (const auto read = textures_.read(*info, colourSpace, conversion))
            material_.textures.push_back({input, *read, channel});
    }

    void colourTexture(const JsonNode& node, const char* key, MaterialInput input) {
        texture(node, key, input, kRed, ColourSpace::kSrgb);
    }

    void readAlpha() {
        static const std::array<std::string, 3> kModes{"OPAQUE", "MASK", "BLEND"};
        constexpr std::array kValues{AlphaMode::kOpaque, AlphaMode::kMask, AlphaMode::kBlend};
        if (const auto mode = node_.find("alphaMode")) material_.alpha.mode = kValues[mode->choice(kModes)];
        if (const auto cutoff = node_.find("alphaCutoff")) {
            material_.alpha.cutoff =
                static_cast<float>(clamped(*cutoff, 0.0, kLargestFactor, "expected a number from 0"));
        }
    }

    void readBaseColor(const JsonNode& node, const char* factorKey, const char* textureKey) {
        if (const auto factor = node.find(factorKey)) {
            material_.baseColor = colourOf(*factor, 4, 1.0);
            const JsonNode alpha = factor->elements("expected 4 numbers")[3];
            material_.alpha.value =
                static_cast<float>(clamped(alpha, 0.0, 1.0, "expected a number from 0 to 1"));
        }
        colourTexture(node, textureKey, MaterialInput::kBaseColor);
        if (material_.alpha.mode != AlphaMode::kOpaque)
            texture(node, textureKey, MaterialInput::kAlpha, kAlphaChannel);
    }

    void readPbr(const JsonNode& pbr) {
        readBaseColor(pbr, "baseColorFactor", "baseColorTexture");
        fraction(pbr, "metallicFactor", material_.metallic);
        fraction(pbr, "roughnessFactor", material_.roughness);
        texture(pbr, "metallicRoughnessTexture", MaterialInput::kMetallic, kBlue);
        texture(pbr, "metallicRoughnessTexture", MaterialInput::kRoughness, kGreen);
    }

    /// An archived extension: a dielectric whose reflectance at normal incidence is a colour, which this
    /// model states relative to that of its index of refraction.
    void readSpecularGlossiness(const JsonNode& node) {
        readBaseColor(node, "diffuseFactor", "diffuseTexture");
        glm::vec3 reflectance(1.0f);
        colour(node, "specularFactor", 1.0, reflectance);
        float glossiness = 1.0f;
        fraction(node, "glossinessFactor", glossiness);
        material_.metallic = 0.0f;
        material_.roughness = 1.0f - glossiness;
        material_.specularColor = reflectance / kDefaultReflectance;
        colourTexture(node, "specularGlossinessTexture", MaterialInput::kSpecularColor);
        if (!node.find("specularGlossinessTexture")) return;
        texture(node, "specularGlossinessTexture", MaterialInput::kRoughness, kRed, ColourSpace::kLinear,
                {.kind = ImageConversion::Kind::kGlossiness, .channel = kAlphaChannel, .factor = glossiness});
        if (hasTexture(material_, MaterialInput::kRoughness)) material_.roughness = 1.0f;
    }

    void normalTexture(const JsonNode& node, const char* key, MaterialInput input, float& field) {
        const auto info = node.find(key);
        if (!info) return;
        texture(node, key, input);
        if (const auto scale = info->find("scale"))
            field = static_cast<float>(clamped(*scale, -kLargestFactor, kLargestFactor, "expected a number"));
    }

    void readEmission() {
        glm::dvec3 radiance(0.0);
        const auto factor = node_.find("emissiveFactor");
        const char* const remedy = "expected three numbers from 0";
        if (factor) radiance = factor->vector(0.0, kLargestRadiance, remedy);
        if (const auto extension = extensionOf(node_, "KHR_materials_emissive_strength")) {
            if (const auto strength = extension->find("emissiveStrength"))
                radiance *= strength->number(0.0, kLargestRadiance, "expected a number from 0");
        }
        if (!glm::all(glm::lessThanEqual(radiance, glm::dvec3(kLargestRadiance)))) {
            node_.fail("emits too much",
                       fmt::format("expected a radiance of at most {:g}", kLargestRadiance));
        }
        const auto doubleSided = node_.find("doubleSided");
        const bool isDoubleSided = doubleSided && doubleSided->boolean();
        if (radiance == glm::dvec3(0.0)) return;
        material_.emission = {glm::vec3(radiance), glm::vec3(radiance),
                              isDoubleSided ? Sides::kBoth : Sides::kFront};
        colourTexture(node_, "emissiveTexture", MaterialInput::kEmission);
    }

    void readDielectric() {
        bool reflectsAll = false;
        if (const auto extension = extensionOf(node_, "KHR_materials_ior")) {
            const auto ior = extension->find("ior");
            // An index of 0 stands for a reflectance of 1, that specularColor alone scales.
            reflectsAll = ior && ior->number(-kAnything, kAnything, "expected an index of refraction") == 0.0;
            if (ior && !reflectsAll) {
                material_.ior = static_cast<float>(clamped(
                    *ior, 1.0, static_cast<double>(Material::kLargestIor),
                    fmt::format("expected an index of refraction from 1 to {}", Material::kLargestIor)));
            }
        }
        if (const auto specular = extensionOf(node_, "KHR_materials_specular")) {
            fraction(*specular, "specularFactor", material_.specular);
            colour(*specular, "specularColorFactor", kLargestFactor, material_.specularColor);
            texture(*specular, "specularTexture", MaterialInput::kSpecular, kAlphaChannel);
            colourTexture(*specular, "specularColorTexture", MaterialInput::kSpecularColor);
        }
        if (reflectsAll) material_.specularColor /= kDefaultReflectance;
    }

    void readVolume() {
        const auto transmission = extensionOf(node_, "KHR_materials_transmission");
        if (transmission) {
            fraction(*transmission, "transmissionFactor", material_.transmission);
            texture(*transmission, "transmissionTexture", MaterialInput::kTransmission, kRed);
        }
        double thickness = 0.0;
        if (const auto volume = extensionOf(node_, "KHR_materials_volume")) {
            if (const auto given = volume->find("thicknessFactor"))
                thickness = given->number(0.0, kAnything, "expected a thickness, 0 or more");
            colour(*volume, "attenuationColor", 1.0, material_.attenuationColor);
            if (const auto distance = volume->find("attenuationDistance")) {
                const char* const remedy = "expected a distance above 0";
                material_.attenuationDistance =
                    static_cast<float>(std::min(distance->number(0.0, kAnything, remedy),
                                                static_cast<double>(std::numeric_limits<float>::max())));
                if (!(material_.attenuationDistance > 0.0f)) distance->failValue(remedy);
            }
        }
        material_.thin = transmission && thickness == 0.0;
    }

    void readCoats() {
        if (const auto coat = extensionOf(node_, "KHR_materials_clearcoat")) {
            fraction(*coat, "clearcoatFactor", material_.clearcoat);
            fraction(*coat, "clearcoatRoughnessFactor", material_.clearcoatRoughness);
            texture(*coat, "clearcoatTexture", MaterialInput::kClearcoat, kRed);
            texture(*coat, "clearcoatRoughnessTexture", MaterialInput::kClearcoatRoughness, kGreen);
            normalTexture(*coat, "clearcoatNormalTexture", MaterialInput::kClearcoatNormal,
                          material_.clearcoatNormalScale);
        }
        if (const auto sheen = extensionOf(node_, "KHR_materials_sheen")) {
            colour(*sheen, "sheenColorFactor", 1.0, material_.sheenColor);
            fraction(*sheen, "sheenRoughnessFactor", material_.sheenRoughness);
            colourTexture(*sheen, "sheenColorTexture", MaterialInput::kSheenColor);
            texture(*sheen, "sheenRoughnessTexture", MaterialInput::kSheenRoughness, kAlphaChannel);
        }
        if (const auto anisotropy = extensionOf(node_, "KHR_materials_anisotropy")) {
            fraction(*anisotropy, "anisotropyStrength", material_.anisotropy);
            if (const auto rotation = anisotropy->find("anisotropyRotation")) {
                const double radians =
                    rotation->number(-kLargestFactor, kLargestFactor, "expected an angle in radians");
                material_.anisotropyRotation = static_cast<float>(glm::degrees(radians));
            }
            texture(*anisotropy, "anisotropyTexture", MaterialInput::kAnisotropy);
        }
    }

    /// The camera sees the base colour, which lights nothing.
    void makeUnlit() {
        Material unlit = defaultGltfMaterial();
        unlit.name = material_.name;
        unlit.alpha = material_.alpha;
        unlit.baseColor = glm::vec3(0.0f);
        unlit.metallic = 0.0f;
        unlit.specular = 0.0f;
        unlit.emission = {glm::vec3(0.0f), material_.baseColor, Sides::kBoth};
        unlit.unlit = true;
        for (MaterialTexture texture : material_.textures) {
            if (texture.input == MaterialInput::kBaseColor)
                texture.input = MaterialInput::kEmission;
            else if (texture.input != MaterialInput::kAlpha)
                continue;
            unlit.textures.push_back(texture);
        }
        material_ = std::move(unlit);
    }

    const JsonNode& node_;
    GltfTextures& textures_;
    GltfNotes& notes_;
    Material material_;
};

}  // namespace

Material readGltfMaterial(const JsonNode& node, std::uint32_t index, GltfTextures& textures,
                          GltfNotes& notes) {
    return GltfMaterialReader(node, textures, notes).run(index);
}

std::string gltfMaterialName(const JsonNode& node, std::uint32_t index) {
    const auto name = node.find("name");
    if (name && !name->text("expected a name").empty()) return name->text("expected a name");
    return fmt::format("material {}", index);
}

Material defaultGltfMaterial() {
    Material material;
    material.name = kDefaultMaterialName;
    material.baseColor = glm::vec3(1.0f);
    material.metallic = 1.0f;
    material.roughness = 1.0f;
    material.specular = 1.0f;
    return material;
}

}  // namespace duolux

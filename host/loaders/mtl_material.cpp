#include "host/loaders/mtl_material.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "host/scene/material_textures.h"
#include "host/scene/roughness.h"

namespace duolux {

namespace {

/// Blender writes Ks 0.5 for every material: up to this, "illum 2" and "Ks" alone do not mean a shiny
/// surface.
constexpr double kUsualSpecular = 0.5;
/// The largest difference between the channels of a colour that counts as grey.
constexpr double kUnnoticedHue = 0.1;
/// Diffuse colours up to this are black.
constexpr double kBlack = 0.02;
/// Reflections as in a mirror are rough below this exponent, where highlights are wide.
constexpr double kMirrorExponent = 100.0;
/// The largest exponent that the format mentions: that of white in an image without a factor.
constexpr double kLargestExponent = 1000.0;
/// Where a physically based material does not say how rough its surface or sheen is.
constexpr double kUsualRoughness = 0.5;
/// The reflectance of a dielectric with index 1.5 at normal incidence: (0.5 / 2.5)^2.
constexpr double kReflectanceOfGlass = 0.04;

double largestOf(const glm::dvec3& colour) {
    return std::max({colour.x, colour.y, colour.z});
}

class MtlMapper {
  public:
    MtlMapper(const MtlValues& values, Material& material, MtlImages& images)
        : values_(values),
          material_(material),
          images_(images),
          model_(static_cast<int>(std::lround(values.illumination.value_or(2.0)))),
          opacity_(values.dissolve ? *values.dissolve : 1.0 - values.transparency.value_or(0.0)) {}

    std::vector<std::string_view> run() {
        material_.baseColor = glm::vec3(factor(values_.diffuse, MtlImage::kDiffuse, glm::dvec3(0.8)));
        setImage(MtlImage::kDiffuse, MaterialInput::kBaseColor);
        const glm::vec3 radiance(factor(values_.emission, MtlImage::kEmission, glm::dvec3(0.0)));
        material_.emission = {radiance, radiance, Sides::kFront};
        setImage(MtlImage::kEmission, MaterialInput::kEmission);
        mapNormal();
        if (isGlass()) {
            mapGlass();
        } else {
            mapCoverage();
            if (isPhysical()) {
                mapPhysical();
            } else {
                mapHighlight();
            }
        }
        mapLayers();
        if (hasImage(MtlImage::kExponent) && !usesExponents_) unused_.push_back("map_Ns");
        return std::move(unused_);
    }

  private:
    /// A factor that is absent or 0 beside an image is 1: exporters write such zeros.
    template <typename T>
    T factor(const std::optional<T>& value, MtlImage image, const T& absent) const {
        if (!values_.image(image)) return value.value_or(absent);
        return value && *value != T(0.0) ? *value : T(1.0);
    }

    /// `conversion`: without base and gain.
    void setImage(const MtlImageUse& use, MaterialInput input, std::uint32_t channel,
                  ImageConversion conversion = {}) {
        conversion.base = static_cast<float>(use.base);
        conversion.gain = static_cast<float>(use.gain);
        Texture texture = use.texture;
        texture.image = images_.indexOf(use.texture.image, conversion);
        setTexture(material_, {input, texture, channel});
    }
    void setImage(MtlImage image, MaterialInput input) {
        const auto& use = values_.image(image);
        if (use) setImage(*use, input, use->channel);
    }

    void mapNormal() {
        const auto& normal = values_.image(MtlImage::kNormal);
        const auto& bump = values_.image(MtlImage::kBump);
        if (normal) {
            setImage(*normal, MaterialInput::kNormal, 0);
            if (bump) unused_.insert(unused_.end(), {"map_bump", "map_Bump", "bump", "Bump"});
        } else if (bump) {
            ImageConversion conversion{.kind = ImageConversion::Kind::kHeights};
            conversion.channel = bump->hasChannel ? bump->channel : ImageConversion::kLuminance;
            conversion.repeats = bump->texture.wrapU == Wrap::kRepeat;
            setImage(*bump, MaterialInput::kNormal, 0, conversion);
        }
        const auto& used = normal ? normal : bump;
        if (used) material_.normalScale = static_cast<float>(used->scale);
    }

    /// By Ns and its image, if there is no other image of roughness. `absent`: without either.
    void setRoughness(double absent, double mirrorFrom) {
        const auto& image = values_.image(MtlImage::kExponent);
        if (!image) {
            const double exponent = values_.exponent.value_or(0.0);
            material_.roughness =
                static_cast<float>(!values_.exponent        ? absent
                                   : exponent >= mirrorFrom ? 0.0
                                                            : roughnessOfExponent(exponent));
            return;
        }
        usesExponents_ = true;
        const double exponent = values_.exponent.value_or(0.0);
        ImageConversion conversion{.kind = ImageConversion::Kind::kExponents};
        conversion.channel = image->channel;
        conversion.factor = static_cast<float>(exponent > 0.0 ? exponent : kLargestExponent);
        conversion.mirrorFrom = static_cast<float>(mirrorFrom);
        setImage(*image, MaterialInput::kRoughness, 0, conversion);
        material_.roughness = 1.0f;
    }

    /// By Pr and its image; if there are none, by Ns.
    void setPhysicalRoughness(double absent, double mirrorFrom) {
        if (!values_.roughness && !hasImage(MtlImage::kRoughness)) return setRoughness(absent, mirrorFrom);
        material_.roughness = static_cast<float>(factor(values_.roughness, MtlImage::kRoughness, 0.0));
        setImage(MtlImage::kRoughness, MaterialInput::kRoughness);
    }

    bool hasImage(MtlImage image) const { return values_.image(image).has_value(); }

    bool isPhysical() const {
        return values_.roughness || values_.metallic || hasImage(MtlImage::kRoughness) ||
               hasImage(MtlImage::kMetallic);
    }

    /// Models 4, 6, 7 and 9 refract. Maya writes "illum 4" with "Tf 1 1 1" and "Ni 1" for everything.
    bool isGlass() const {
        const bool refracts = model_ == 4 || model_ == 6 || model_ == 7 || model_ == 9;
        const bool filters = !values_.dissolve && !values_.transparency && values_.filter &&
                             largestOf(*values_.filter) > 0.0 && values_.ior.value_or(1.0) > 1.0;
        return refracts && !hasImage(MtlImage::kDissolve) && (opacity_ < kMtlOpaque || filters);
    }

    void mapGlass() {
        removeTexture(material_, MaterialInput::kBaseColor);
        if (hasImage(MtlImage::kDiffuse)) unused_.push_back("map_Kd");
        // A grey Kd is not missed: such glass is meant to be white.
        if (!values_.filter && values_.diffuse && isColoured(*values_.diffuse)) unused_.push_back("Kd");
        if (hasImage(MtlImage::kSpecular)) unused_.push_back("map_Ks");
        if (values_.metallic.value_or(0.0) > 0.0 || hasImage(MtlImage::kMetallic)) unused_.push_back("Pm");
        material_.transmission = material_.specular = 1.0f;
        material_.baseColor = glm::vec3(values_.filter.value_or(glm::dvec3(1.0)));
        material_.ior = static_cast<float>(values_.ior.value_or(1.5));
        setPhysicalRoughness(0.0, kMirrorExponent);
    }

    void mapCoverage() {
        if (values_.filter && !isWhiteOrBlack(*values_.filter)) unused_.push_back("Tf");
        const auto& image = values_.image(MtlImage::kDissolve);
        // Some programs write Tr 1 together with d 1 for opaque materials; d takes precedence.
        if (!image && !(opacity_ < kMtlOpaque)) return;
        material_.alpha.mode = AlphaMode::kBlend;
        material_.alpha.value = static_cast<float>(image && opacity_ == 0.0 ? 1.0 : opacity_);
        if (!image) return;
        // The alpha of an image of colours, otherwise an image of its own.
        const auto& diffuse = values_.image(MtlImage::kDiffuse);
        const bool isAlpha = diffuse && diffuse->texture.image == image->texture.image;
        setImage(*image, MaterialInput::kAlpha, isAlpha && !image->hasChannel ? 3u : image->channel);
    }

    static bool isColoured(const glm::dvec3& colour) {
        return largestOf(colour) - std::min({colour.x, colour.y, colour.z}) > kUnnoticedHue;
    }
    static bool isWhiteOrBlack(const glm::dvec3& filter) {
        return glm::all(glm::lessThanEqual(filter, glm::dvec3(0.0))) ||
               glm::all(glm::greaterThanEqual(filter, glm::dvec3(kMtlOpaque)));
    }

    void mapPhysical() {
        material_.specular = 1.0f;
        material_.metallic = static_cast<float>(factor(values_.metallic, MtlImage::kMetallic, 0.0));
        setImage(MtlImage::kMetallic, MaterialInput::kMetallic);
        setPhysicalRoughness(kUsualRoughness, kNoMirror);
        // Ni 1 is the default that exporters write.
        if (values_.ior.value_or(1.0) > 1.0) material_.ior = static_cast<float>(*values_.ior);
        if (hasImage(MtlImage::kSpecular)) unused_.push_back("map_Ks");
    }

    /// Ks is the reflectance at normal incidence: of a metal if there is nothing else, else of a dielectric.
    void mapHighlight() {
        const bool isMirror = model_ == 3 || model_ == 5 || model_ == 8;
        const bool hasHighlight = model_ >= 2 && model_ <= 9;
        const glm::dvec3 specular =
            values_.specular.value_or(glm::dvec3(hasImage(MtlImage::kSpecular) ? 1.0 : 0.0));
        const bool isLarge = largestOf(specular) > kUsualSpecular;
        const bool isShiny =
            largestOf(specular) > 0.0 && (isMirror || isLarge || hasImage(MtlImage::kSpecular));
        if (!hasHighlight || !isShiny) {
            if (hasImage(MtlImage::kSpecular)) unused_.push_back("map_Ks");
            return;
        }
        setRoughness(isMirror ? 0.0 : roughnessOfExponent(0.0), isMirror ? kMirrorExponent : kNoMirror);
        const bool isBlack = values_.diffuse && largestOf(*values_.diffuse) <= kBlack;
        if (isLarge && isBlack && !hasImage(MtlImage::kDiffuse)) {
            material_.metallic = 1.0f;
            material_.baseColor = glm::vec3(specular);
            setImage(MtlImage::kSpecular, MaterialInput::kBaseColor);
            return;
        }
        material_.specular = 1.0f;
        material_.specularColor = glm::vec3(specular / kReflectanceOfGlass);
        setImage(MtlImage::kSpecular, MaterialInput::kSpecularColor);
    }

    void mapLayers() {
        material_.clearcoat = static_cast<float>(factor(values_.clearcoat, MtlImage::kClearcoat, 0.0));
        setImage(MtlImage::kClearcoat, MaterialInput::kClearcoat);
        material_.clearcoatRoughness =
            static_cast<float>(factor(values_.clearcoatRoughness, MtlImage::kClearcoatRoughness, 0.0));
        setImage(MtlImage::kClearcoatRoughness, MaterialInput::kClearcoatRoughness);
        material_.sheenColor = glm::vec3(factor(values_.sheen, MtlImage::kSheen, glm::dvec3(0.0)));
        setImage(MtlImage::kSheen, MaterialInput::kSheenColor);
        if (material_.sheenColor != glm::vec3(0.0f))
            material_.sheenRoughness = static_cast<float>(kUsualRoughness);
        // Stretched across the tangent if negative.
        const double anisotropy = values_.anisotropy.value_or(0.0);
        material_.anisotropy = static_cast<float>(std::abs(anisotropy));
        if (anisotropy != 0.0) {
            material_.anisotropyRotation = static_cast<float>(
                360.0 * values_.anisotropyRotation.value_or(0.0) + (anisotropy < 0.0 ? 90.0 : 0.0));
        }
    }

    static constexpr double kNoMirror = std::numeric_limits<double>::infinity();

    const MtlValues& values_;
    Material& material_;
    MtlImages& images_;
    bool usesExponents_ = false;  ///< of the image of Ns
    int model_;                   ///< of illumination
    double opacity_;              ///< 1 if the file does not say
    std::vector<std::string_view> unused_;
};

}  // namespace

std::vector<std::string_view> mapMtl(const MtlValues& values, Material& material, MtlImages& images) {
    return MtlMapper(values, material, images).run();
}

}  // namespace duolux

#include "host/scene/scene.h"

#include <cassert>
#include <tuple>

#include "host/scene/fields.h"

namespace duolux {

const char* nameOf(Sides sides) {
    switch (sides) {
        case Sides::kFront:
            return "front";
        case Sides::kBoth:
            return "both";
    }
    return "";
}

const char* nameOf(AlphaMode mode) {
    switch (mode) {
        case AlphaMode::kOpaque:
            return "opaque";
        case AlphaMode::kMask:
            return "mask";
        case AlphaMode::kBlend:
            return "blend";
    }
    return "";
}

const char* nameOf(MaterialInput input) {
    switch (input) {
        case MaterialInput::kBaseColor:
            return "base_color";
        case MaterialInput::kAlpha:
            return "alpha";
        case MaterialInput::kMetallic:
            return "metallic";
        case MaterialInput::kRoughness:
            return "roughness";
        case MaterialInput::kSpecular:
            return "specular";
        case MaterialInput::kSpecularColor:
            return "specular_color";
        case MaterialInput::kTransmission:
            return "transmission";
        case MaterialInput::kClearcoat:
            return "clearcoat";
        case MaterialInput::kClearcoatRoughness:
            return "clearcoat_roughness";
        case MaterialInput::kSheenColor:
            return "sheen_color";
        case MaterialInput::kSheenRoughness:
            return "sheen_roughness";
        case MaterialInput::kAnisotropy:
            return "anisotropy";
        case MaterialInput::kNormal:
            return "normal";
        case MaterialInput::kEmission:
            return "emission";
        case MaterialInput::kClearcoatNormal:
            return "clearcoat_normal";
    }
    return "";
}

const char* nameOf(Wrap wrap) {
    switch (wrap) {
        case Wrap::kRepeat:
            return "repeat";
        case Wrap::kClamp:
            return "clamp";
        case Wrap::kMirror:
            return "mirror";
    }
    return "";
}

const char* nameOf(Filter filter) {
    switch (filter) {
        case Filter::kLinear:
            return "linear";
        case Filter::kNearest:
            return "nearest";
    }
    return "";
}

const char* nameOf(CameraType type) {
    switch (type) {
        case CameraType::kPerspective:
            return "perspective";
        case CameraType::kOrthographic:
            return "orthographic";
    }
    return "";
}

const char* nameOf(Sampler sampler) {
    switch (sampler) {
        case Sampler::kSobol:
            return "sobol";
        case Sampler::kIndependent:
            return "independent";
    }
    return "";
}

const char* nameOf(Integrator integrator) {
    switch (integrator) {
        case Integrator::kPathTracer:
            return "path";
        case Integrator::kLightTracer:
            return "light";
    }
    return "";
}

bool isPlainDiffuse(const Material& material) {
    const auto& [name, baseColor, metallic, roughness, ior, specular, specularColor, transmission, thin,
                 attenuationColor, attenuationDistance, clearcoat, clearcoatRoughness, sheenColor,
                 sheenRoughness, anisotropy, anisotropyRotation, alpha, normalScale, clearcoatNormalScale,
                 sides, emission, unlit, reflectance, textures] = material;
    static_cast<void>(std::tie(name, baseColor, sides, emission, unlit, reflectance));
    // Properties of lobes that are absent, and of images.
    static_cast<void>(std::tie(roughness, ior, specularColor, thin, attenuationColor, attenuationDistance,
                               clearcoatRoughness, sheenRoughness, anisotropy, anisotropyRotation,
                               normalScale, clearcoatNormalScale));
    return metallic == 0.0f && specular == 0.0f && transmission == 0.0f && clearcoat == 0.0f &&
           sheenColor == glm::vec3(0.0f) && alpha.mode == AlphaMode::kOpaque && textures.empty();
}

std::vector<bool> usedMaterials(const Geometry& geometry, std::size_t count) {
    std::vector<bool> used(count);
    for (const std::uint32_t material : geometry.materials)
        used[material] = true;
    return used;
}

void noteContent(Scene& scene) {
    scene.content = {scene.geometry.positions.size(), scene.geometry.triangles.size(),
                     scene.materials.size()};
}

void removeLamp(Scene& scene) {
    forEachField(scene.geometry, [&](const auto& field, auto& items) {
        switch (field.per) {
            case Per::kPosition:
                if (!items.empty()) items.resize(scene.content.positions);
                break;
            case Per::kTriangle:
                if (!items.empty()) items.resize(scene.content.triangles);
                break;
            case Per::kNormal:  // a lamp has neither
            case Per::kUv:
                break;
        }
    });
    scene.materials.resize(scene.content.materials);
}

Bounds boundsOf(const Geometry& geometry) {
    assert(!geometry.triangles.empty());
    const glm::vec3 first = geometry.positions[geometry.triangles[0].x];
    Bounds bounds{first, first};
    for (const glm::uvec3& triangle : geometry.triangles) {
        for (int i = 0; i < 3; ++i) {
            const glm::vec3& position = geometry.positions[triangle[i]];
            bounds.lower = glm::min(bounds.lower, position);
            bounds.upper = glm::max(bounds.upper, position);
        }
    }
    return bounds;
}

}  // namespace duolux

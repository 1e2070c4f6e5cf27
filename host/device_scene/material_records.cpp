#include "host/device_scene/material_records.h"

#include <algorithm>
#include <tuple>

namespace duolux {

namespace {

void storeMatrix(const ReflectanceMatrix& m, glm::vec4 (&out)[4]) {
    out[0] = glm::vec4(m.m00, 0.0f);
    out[1] = glm::vec4(m.m01, 0.0f);
    out[2] = glm::vec4(m.m10, 0.0f);
    out[3] = glm::vec4(m.m11, 0.0f);
}

/// Per scene unit: of white light, exp(-attenuation * distance) is the colour.
glm::vec3 attenuationOf(const glm::vec3& color, float distance) {
    constexpr float kDarkest = 1e-6f;
    return -glm::log(glm::clamp(color, kDarkest, 1.0f)) / distance;
}

std::uint32_t flagOf(AlphaMode mode) {
    switch (mode) {
        case AlphaMode::kOpaque:
            return 0;
        case AlphaMode::kMask:
            return shared::kMaterialAlphaMask;
        case AlphaMode::kBlend:
            return shared::kMaterialAlphaBlend;
    }
    return 0;
}

}  // namespace

std::vector<shared::DeviceMaterial> makeMaterialRecords(const Scene& scene) {
    std::vector<shared::DeviceMaterial> out;
    for (const Material& material : scene.materials) {
        // All fields by name: a further one does not compile until it is handled here.
        const auto& [name, baseColor, metallic, roughness, ior, specular, specularColor, transmission, thin,
                     attenuationColor, attenuationDistance, clearcoat, clearcoatRoughness, sheenColor,
                     sheenRoughness, anisotropy, anisotropyRotation, alpha, normalScale, clearcoatNormalScale,
                     sides, emission, unlit, ownReflectance, textures] = material;
        static_cast<void>(std::tie(name, emission, ownReflectance));  // elsewhere, or resolved below
        shared::DeviceMaterial d{};
        d.baseColor = baseColor;
        d.metallic = metallic;
        d.roughness = roughness;
        d.ior = std::max(ior, shared::kSmallestIor);
        d.specular = specular;
        d.specularColor = specularColor;
        d.transmission = transmission;
        d.attenuation = attenuationOf(attenuationColor, attenuationDistance);
        d.clearcoat = clearcoat;
        d.clearcoatRoughness = clearcoatRoughness;
        d.sheenColor = sheenColor;
        d.sheenRoughness = sheenRoughness;
        d.anisotropy = anisotropy;
        d.anisotropyRotation = glm::radians(anisotropyRotation);
        d.alpha = alpha.value;
        d.alphaCutoff = alpha.cutoff;
        d.normalScale = normalScale;
        d.clearcoatNormalScale = clearcoatNormalScale;
        d.flags = (sides == Sides::kBoth ? shared::kMaterialTwoSided : 0u) |
                  (thin ? shared::kMaterialThin : 0u) | flagOf(alpha.mode) |
                  (unlit ? shared::kMaterialUnlit : 0u);
        const Reflectance& reflectance = scene.reflectanceOf(material);
        storeMatrix(reflectance.opaque, d.opaque);
        storeMatrix(reflectance.transparent, d.transparent);
        out.push_back(d);
    }
    return out;
}

}  // namespace duolux

// Reads materials (DeviceMaterial). The kernel that includes this defines fetchMaterialTexel.
#ifndef DUOLUX_LIB_MATERIAL_GLSL
#define DUOLUX_LIB_MATERIAL_GLSL

#include "shaders/lib/bsdf/bsdf_types.glsl"
#include "shaders/lib/reflectance_matrix.glsl"
#include "shaders/lib/texture_groups.glsl"
#include "shaders/shared/material_layout.h"

uvec4 fetchMaterialTexel(uint index);

// Field by field as in DeviceMaterial.
struct Material {
    vec3 baseColor;
    uint flags;
    float metallic;
    float roughness;
    float anisotropy;
    float anisotropyRotation;
    vec3 specularColor;
    float specular;
    float transmission;
    float ior;
    float clearcoat;
    float clearcoatRoughness;
    vec3 sheenColor;
    float sheenRoughness;
    vec3 attenuation;
    float normalScale;
    float alpha;
    float alphaCutoff;
    uint firstTexture;
    uint textureCount;
};

// The compiler drops the fetches of what no lobe of the scene uses.
Material fetchMaterial(uint index) {
    uint texel = index * kMaterialTexels;
    uvec4 color = fetchMaterialTexel(texel + kMaterialBaseColorTexel);
    vec4 metallic = uintBitsToFloat(fetchMaterialTexel(texel + kMaterialMetallicTexel));
    vec4 specular = uintBitsToFloat(fetchMaterialTexel(texel + kMaterialSpecularTexel));
    vec4 transmission = uintBitsToFloat(fetchMaterialTexel(texel + kMaterialTransmissionTexel));
    vec4 sheen = uintBitsToFloat(fetchMaterialTexel(texel + kMaterialSheenTexel));
    vec4 attenuation = uintBitsToFloat(fetchMaterialTexel(texel + kMaterialAttenuationTexel));
    uvec4 alpha = fetchMaterialTexel(texel + kMaterialAlphaTexel);
    return Material(uintBitsToFloat(color.xyz), color.w, metallic.x, metallic.y, metallic.z, metallic.w, specular.xyz,
                    specular.w, transmission.x, transmission.y, transmission.z, transmission.w, sheen.xyz, sheen.w,
                    attenuation.xyz, attenuation.w, uintBitsToFloat(alpha.x), uintBitsToFloat(alpha.y), alpha.z,
                    alpha.w);
}

// `front`: the surface is seen from its front.
Bsdf bsdfOf(Material material, bool front) {
    float root = (material.ior - 1.0) / (material.ior + 1.0);
    float alpha = material.roughness * material.roughness;
    bool thin = (material.flags & kMaterialThin) != 0u;
    Bsdf bsdf;
    bsdf.baseColor = material.baseColor;
    bsdf.metallic = material.metallic;
    bsdf.roughness = material.roughness;
    // KHR_materials_specular.
    bsdf.f0 = min(material.specularColor * (root * root), vec3(1.0)) * material.specular;
    bsdf.specular = material.specular;
    bsdf.transmission = material.transmission;
    bsdf.eta = thin || front ? material.ior : 1.0 / material.ior;
    // What light does not enter has no inside: its layers lie on both sides (glTF 2.0, section 3.9.5).
    bool outside = front || material.transmission <= 0.0;
    bsdf.flags = (thin ? kBsdfThin : 0u) | (outside ? kBsdfOutside : 0u);
    bsdf.clearcoat = material.clearcoat;
    bsdf.clearcoatRoughness = material.clearcoatRoughness;
    bsdf.sheenColor = material.sheenColor;
    bsdf.sheenRoughness = material.sheenRoughness;
    // KHR_materials_anisotropy.
    bsdf.alpha = vec2(kAnisotropic ? mix(alpha, 1.0, material.anisotropy * material.anisotropy) : alpha, alpha);
    bsdf.tangent = vec3(0.0);
    bsdf.coatNormal = vec3(0.0);
    bsdf.attenuation = thin || material.transmission <= 0.0 ? vec3(0.0) : material.attenuation;
    return bsdf;
}

ReflectanceMatrix fetchMatrix(uint texel) {
    return ReflectanceMatrix(uintBitsToFloat(fetchMaterialTexel(texel).xyz),
                             uintBitsToFloat(fetchMaterialTexel(texel + 1u).xyz),
                             uintBitsToFloat(fetchMaterialTexel(texel + 2u).xyz),
                             uintBitsToFloat(fetchMaterialTexel(texel + 3u).xyz));
}

ReflectanceMatrix fetchOpaque(uint index) { return fetchMatrix(index * kMaterialTexels + kMaterialOpaqueTexel); }
ReflectanceMatrix fetchTransparent(uint index) {
    return fetchMatrix(index * kMaterialTexels + kMaterialTransparentTexel);
}

// How much of the surface is there.
float coverageOf(Material material) {
    if ((material.flags & kMaterialAlphaMask) != 0u) return material.alpha >= material.alphaCutoff ? 1.0 : 0.0;
    return (material.flags & kMaterialAlphaBlend) != 0u ? clamp(material.alpha, 0.0, 1.0) : 1.0;
}

bool materialScatters(Material material, bool front) { return front || (material.flags & kMaterialTwoSided) != 0u; }

#endif

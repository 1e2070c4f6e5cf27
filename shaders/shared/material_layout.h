// The record of a material, shared by C++ and GLSL.
#ifndef DUOLUX_SHADERS_SHARED_MATERIAL_LAYOUT_H
#define DUOLUX_SHADERS_SHARED_MATERIAL_LAYOUT_H

#include "shaders/shared/kernel_interface.h"

DUOLUX_BEGIN

DUOLUX_CONST uint kMaterialTexels = 16u;  // of 4 x uint32
// The texels of a DeviceMaterial, by their first field.
DUOLUX_CONST uint kMaterialBaseColorTexel = 0u;
DUOLUX_CONST uint kMaterialMetallicTexel = 1u;
DUOLUX_CONST uint kMaterialSpecularTexel = 2u;
DUOLUX_CONST uint kMaterialTransmissionTexel = 3u;
DUOLUX_CONST uint kMaterialSheenTexel = 4u;
DUOLUX_CONST uint kMaterialAttenuationTexel = 5u;
DUOLUX_CONST uint kMaterialAlphaTexel = 6u;
DUOLUX_CONST uint kMaterialOpaqueTexel = 7u;  // four
DUOLUX_CONST uint kMaterialTransparentTexel = 11u;
DUOLUX_CONST uint kMaterialCoatTexel = 15u;

// DeviceMaterial.flags.
DUOLUX_CONST uint kMaterialTwoSided = 1u;    // f_opaque acts on both sides
DUOLUX_CONST uint kMaterialThin = 2u;        // refraction through a wall without thickness
DUOLUX_CONST uint kMaterialAlphaMask = 4u;   // alpha is 0 below the cutoff, else 1
DUOLUX_CONST uint kMaterialAlphaBlend = 8u;  // without either of the two, alpha is 1
DUOLUX_CONST uint kMaterialUnlit = 16u;      // colours of vertices scale the emission

// Lobes.
DUOLUX_CONST uint kLobeDiffuse = 1u;
DUOLUX_CONST uint kLobeMetal = 2u;
DUOLUX_CONST uint kLobeDielectric = 4u;  // reflection on a diffuse surface
DUOLUX_CONST uint kLobeGlass = 8u;
DUOLUX_CONST uint kLobeClearcoat = 16u;
DUOLUX_CONST uint kLobeSheen = 32u;
DUOLUX_CONST uint kLobeAnisotropic = 64u;   // metal, dielectric or glass are stretched along the tangent
DUOLUX_CONST uint kLobeAttenuation = 128u;  // glass absorbs light inside
DUOLUX_CONST uint kAllLobes = 255u;
DUOLUX_CONST uint kLobesThatTransmit = kLobeGlass;  // scatter to the other side of the surface, too

// Microfacets whose GGX alpha (the square of the roughness) is below this are smooth.
DUOLUX_CONST float kSmoothAlpha = 1e-3f;
// The smallest index of refraction in a record; its reflectance at normal incidence is 2.5e-9. At exactly 1,
// all microfacets refract light in one direction, which has no density: rough glass would be black.
DUOLUX_CONST float kSmallestIor = 1.0001f;

#ifdef __cplusplus
struct DeviceMaterial {
    vec3 baseColor;
    uint flags;
    float metallic;
    float roughness;
    float anisotropy;
    float anisotropyRotation;  // radians, counter-clockwise from the tangent
    vec3 specularColor;
    float specular;
    float transmission;
    float ior;  // at least kSmallestIor
    float clearcoat;
    float clearcoatRoughness;
    vec3 sheenColor;
    float sheenRoughness;
    vec3 attenuation;  // per scene unit inside the object
    float normalScale;
    float alpha;
    float alphaCutoff;
    uint firstTexture;  // DeviceTexture
    uint textureCount;
    vec4 opaque[4];  // m00 m01 m10 m11 in xyz
    vec4 transparent[4];
    float clearcoatNormalScale;
    uint unused[3];
};
static_assert(sizeof(DeviceMaterial) == kMaterialTexels * 16);
static_assert(offsetof(DeviceMaterial, metallic) == kMaterialMetallicTexel * 16);
static_assert(offsetof(DeviceMaterial, specularColor) == kMaterialSpecularTexel * 16);
static_assert(offsetof(DeviceMaterial, transmission) == kMaterialTransmissionTexel * 16);
static_assert(offsetof(DeviceMaterial, sheenColor) == kMaterialSheenTexel * 16);
static_assert(offsetof(DeviceMaterial, attenuation) == kMaterialAttenuationTexel * 16);
static_assert(offsetof(DeviceMaterial, alpha) == kMaterialAlphaTexel * 16);
static_assert(offsetof(DeviceMaterial, opaque) == kMaterialOpaqueTexel * 16);
static_assert(offsetof(DeviceMaterial, transparent) == kMaterialTransparentTexel * 16);
static_assert(offsetof(DeviceMaterial, clearcoatNormalScale) == kMaterialCoatTexel * 16);
#endif

DUOLUX_END
#endif

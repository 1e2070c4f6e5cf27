// The record of a material, shared by C++ and GLSL.
#ifndef DUOLUX_SHADERS_SHARED_MATERIAL_LAYOUT_H
#define DUOLUX_SHADERS_SHARED_MATERIAL_LAYOUT_H

#include "shaders/shared/kernel_interface.h"

DUOLUX_BEGIN

DUOLUX_CONST uint kMaterialTexels = 10u;  // of 4 x uint32
// The first of the texels that hold a matrix.
DUOLUX_CONST uint kMaterialOpaqueTexel = 2u;
DUOLUX_CONST uint kMaterialTransparentTexel = 6u;

DUOLUX_CONST uint kMaterialTwoSided = 1u;  // f_opaque acts on both sides

// Lobes.
DUOLUX_CONST uint kLobeDiffuse = 1u;
DUOLUX_CONST uint kLobeConductor = 2u;
DUOLUX_CONST uint kLobesThatTransmit = 0u;  // scatter to the other side of the surface, too

// Metals whose GGX alpha (the square of the roughness) is below this are mirrors.
DUOLUX_CONST float kSmoothAlpha = 1e-3f;

#ifdef __cplusplus
struct DeviceMaterial {
    vec3 baseColor;
    uint flags;
    float metallic;
    float roughness;
    float unused[2];
    vec4 opaque[4];  // m00 m01 m10 m11 in xyz
    vec4 transparent[4];
};
static_assert(sizeof(DeviceMaterial) == kMaterialTexels * 16);
static_assert(offsetof(DeviceMaterial, opaque) == kMaterialOpaqueTexel * 16);
static_assert(offsetof(DeviceMaterial, transparent) == kMaterialTransparentTexel * 16);
#endif

DUOLUX_END
#endif

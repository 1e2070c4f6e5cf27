// Reads materials (DeviceMaterial). The kernel that includes this defines fetchMaterialTexel.
#ifndef DUOLUX_LIB_MATERIAL_GLSL
#define DUOLUX_LIB_MATERIAL_GLSL

#include "shaders/lib/bsdf.glsl"
#include "shaders/lib/light_matrix.glsl"
#include "shaders/shared/path_layout.h"

uvec4 fetchMaterialTexel(uint index);

struct Material {
    Bsdf bsdf;
    uint flags;
    Light emission;
    float lightPdfArea;
};

Material fetchMaterial(uint index) {
    uint texel = index * kMaterialTexels;
    uvec4 t0 = fetchMaterialTexel(texel);
    uvec4 t1 = fetchMaterialTexel(texel + 1u);
    uvec4 t2 = fetchMaterialTexel(texel + 2u);
    return Material(Bsdf(uintBitsToFloat(t0.xyz)), t0.w, Light(uintBitsToFloat(t1.xyz), uintBitsToFloat(t2.xyz)),
                    uintBitsToFloat(t1.w));
}

LightMatrix fetchMatrix(uint texel) {
    return LightMatrix(uintBitsToFloat(fetchMaterialTexel(texel).xyz), uintBitsToFloat(fetchMaterialTexel(texel + 1u).xyz),
                       uintBitsToFloat(fetchMaterialTexel(texel + 2u).xyz),
                       uintBitsToFloat(fetchMaterialTexel(texel + 3u).xyz));
}

LightMatrix fetchOpaque(uint index) { return fetchMatrix(index * kMaterialTexels + 3u); }
LightMatrix fetchTransparent(uint index) { return fetchMatrix(index * kMaterialTexels + 7u); }

// Radiance emitted on the front or the back side.
Light materialEmission(Material material, bool front) {
    bool emits = (material.flags & (front ? kMaterialEmitsFront : kMaterialEmitsBack)) != 0u;
    return Light(emits ? material.emission.invisible : vec3(0.0), emits ? material.emission.visible : vec3(0.0));
}

bool materialScatters(Material material, bool front) { return front || (material.flags & kMaterialTwoSided) != 0u; }

#endif

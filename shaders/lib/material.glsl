// Reads materials (DeviceMaterial). The kernel that includes this defines fetchMaterialTexel.
#ifndef DUOLUX_LIB_MATERIAL_GLSL
#define DUOLUX_LIB_MATERIAL_GLSL

#include "shaders/lib/bsdf/bsdf_types.glsl"
#include "shaders/lib/reflectance_matrix.glsl"
#include "shaders/shared/material_layout.h"

uvec4 fetchMaterialTexel(uint index);

struct Material {
    Bsdf bsdf;
    uint flags;
};

Material fetchMaterial(uint index) {
    uvec4 t0 = fetchMaterialTexel(index * kMaterialTexels);
    uvec4 t1 = fetchMaterialTexel(index * kMaterialTexels + 1u);
    return Material(Bsdf(uintBitsToFloat(t0.xyz), uintBitsToFloat(t1.x), uintBitsToFloat(t1.y)), t0.w);
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

bool materialScatters(Material material, bool front) { return front || (material.flags & kMaterialTwoSided) != 0u; }

#endif

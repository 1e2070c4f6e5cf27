// What the textures of a material make of its parameters. The kernel that includes this defines fetchMaterialTexel and
// what texture.glsl needs.
#ifndef DUOLUX_LIB_MATERIAL_TEXTURES_GLSL
#define DUOLUX_LIB_MATERIAL_TEXTURES_GLSL

#include "shaders/lib/texture.glsl"
#include "shaders/lib/texture_groups.glsl"
#include "shaders/shared/material_layout.h"

uvec4 fetchMaterialTexel(uint index);

// The values of a material's textures, by group. All but the normals and the anisotropy's direction are
// factors.
struct TextureValues {
    vec4 base;
    vec4 surface;
    vec4 specular;
    vec4 sheen;
    vec4 normal;
    vec4 anisotropy;
    vec4 emission;
    vec4 coatNormal;
};

// Those of a material without textures: factors of 1, the normals along z, and the anisotropy along x, encoded as in
// images.
TextureValues noTextures() {
    return TextureValues(vec4(1.0), vec4(1.0), vec4(1.0), vec4(1.0), vec4(0.5, 0.5, 1.0, 1.0),
                         vec4(1.0, 0.5, 1.0, 1.0), vec4(1.0), vec4(0.5, 0.5, 1.0, 1.0));
}

// The textures of a material: the index of the first, and their number.
uvec2 fetchTextureRange(uint material) {
    uvec4 texel = fetchMaterialTexel(material * kMaterialTexels + kMaterialAlphaTexel);
    return uvec2(texel.z, texel.w);
}

// The factor of the x and y of normals in images.
float fetchNormalScale(uint material) {
    return uintBitsToFloat(fetchMaterialTexel(material * kMaterialTexels + kMaterialAttenuationTexel).w);
}

// The same of the normals of the clearcoat.
float fetchCoatNormalScale(uint material) {
    return uintBitsToFloat(fetchMaterialTexel(material * kMaterialTexels + kMaterialCoatTexel).x);
}

// The component at a shift in DeviceTexture.flags.
float swizzled(vec4 value, uint flags, uint shift, float otherwise) {
    uint channel = (flags >> shift) & ((1u << kTextureSwizzleBits) - 1u);
    return channel == kNoChannel ? otherwise : value[channel & 3u];
}

// Replaces the components that the texture has a channel for.
vec4 replaced(vec4 before, vec4 value, uint flags) {
    uint shift = kTextureSwizzleShift;
    return vec4(swizzled(value, flags, shift, before.x), swizzled(value, flags, shift + kTextureSwizzleBits, before.y),
                swizzled(value, flags, shift + 2u * kTextureSwizzleBits, before.z),
                swizzled(value, flags, shift + 3u * kTextureSwizzleBits, before.w));
}

// The values of a material's textures in these groups (a sum of 1 << kGroup...) at both sets of texture coordinates.
TextureValues sampleTextures(uint material, uint groups, vec2 uv, vec2 secondUv) {
    TextureValues values = noTextures();
    uvec2 range = fetchTextureRange(material);
    // Loops, because only loops skip what no lane needs.
    for (uint i = 0u; i < range.y; i++) {
        Texture image = fetchTexture(range.x + i);
        uint group = image.flags & kTextureGroupMask;
        bool second = (image.flags & kTextureSecondUv) != 0u;
        uint lookups = (groups >> group) & 1u;
        for (uint k = 0u; k < lookups; k++) {
            // HDR and EXR images may have any values, but only emission may exceed 1.
            float most = group == kGroupEmission ? 3e38 : 1.0;
            vec4 value = clamp(sampleTexture(image, second ? secondUv : uv), vec4(0.0), vec4(most));
            if (isTextured(kGroupBase) && group == kGroupBase) {
                values.base = replaced(values.base, value, image.flags);
            }
            if (isTextured(kGroupSurface) && group == kGroupSurface) {
                values.surface = replaced(values.surface, value, image.flags);
            }
            if (isTextured(kGroupSpecular) && group == kGroupSpecular) {
                values.specular = replaced(values.specular, value, image.flags);
            }
            if (isTextured(kGroupSheen) && group == kGroupSheen) {
                values.sheen = replaced(values.sheen, value, image.flags);
            }
            if (isTextured(kGroupNormal) && group == kGroupNormal) {
                values.normal = replaced(values.normal, value, image.flags);
            }
            if (isTextured(kGroupAnisotropy) && group == kGroupAnisotropy) {
                values.anisotropy = replaced(values.anisotropy, value, image.flags);
            }
            if (isTextured(kGroupEmission) && group == kGroupEmission) {
                values.emission = replaced(values.emission, value, image.flags);
            }
            if (isTextured(kGroupCoatNormal) && group == kGroupCoatNormal) {
                values.coatNormal = replaced(values.coatNormal, value, image.flags);
            }
        }
    }
    return values;
}

#endif

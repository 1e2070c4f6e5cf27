// A thin layer of varnish (index of refraction 1.5) on the other lobes, which get what it does not reflect: the light
// that it transmits is not bent. GGX microfacets with Schlick's Fresnel reflectance; smooth ones are a mirror.
#ifndef DUOLUX_LIB_BSDF_CLEARCOAT_GLSL
#define DUOLUX_LIB_BSDF_CLEARCOAT_GLSL

#include "shaders/lib/bsdf/reflection.glsl"
#include "shaders/lib/texture_groups.glsl"

// Whether the normal of the varnish may differ from the shading normal, which a normal map of what lies below bends.
bool hasCoatNormals() {
    return (kLobes & kLobeClearcoat) != 0u && (isTextured(kGroupNormal) || isTextured(kGroupCoatNormal));
}

// A direction in the frame of the clearcoat's normal. `local`: in that of the shading normal.
vec3 toCoatFrame(BsdfFrame frame, vec3 w, vec3 local) { return hasCoatNormals() ? toFrame(frame.coat, w) : local; }

// Its cosine to the clearcoat's normal. `cosine`: to the shading normal.
float coatCosine(BsdfFrame frame, vec3 w, float cosine) { return hasCoatNormals() ? abs(dot(frame.coat, w)) : cosine; }

const float kClearcoatF0 = 0.04;

vec2 clearcoatAlpha(Bsdf bsdf) { return vec2(bsdf.clearcoatRoughness * bsdf.clearcoatRoughness); }
bool isSmoothClearcoat(Bsdf bsdf) { return clearcoatAlpha(bsdf).x < kSmoothAlpha; }

float clearcoatReflectance(Bsdf bsdf, float cosine) {
    return bsdf.clearcoat * schlickFresnel(vec3(kClearcoatF0), 1.0, cosine).x;
}

// What single scattering between microfacets loses goes to the lobes below.
float clearcoatAlbedo(Bsdf bsdf, float cosine) {
    if (isSmoothClearcoat(bsdf)) return clearcoatReflectance(bsdf, cosine);
    vec2 single = reflectionAlbedo(cosine, bsdf.clearcoatRoughness);
    return bsdf.clearcoat * (kClearcoatF0 * single.x + single.y);
}

// 0 for a mirror.
float clearcoatEvaluate(Bsdf bsdf, vec3 wo, vec3 wi) {
    if (isSmoothClearcoat(bsdf)) return 0.0;
    return clearcoatReflectance(bsdf, dot(wo, normalize(wo + wi))) * ggxEvaluate(clearcoatAlpha(bsdf), wo, wi);
}

#endif

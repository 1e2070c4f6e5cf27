// Metals and the reflection of opaque dielectrics: GGX microfacets with Schlick's Fresnel reflectance, and what they
// scatter several times. A smooth surface is a mirror. Both kinds share their microfacets and differ in f0 and f90.
#ifndef DUOLUX_LIB_BSDF_REFLECTION_GLSL
#define DUOLUX_LIB_BSDF_REFLECTION_GLSL

#include "shaders/lib/bsdf/albedo.glsl"
#include "shaders/lib/bsdf/microfacet.glsl"

// Fresnel reflectance at normal and at grazing incidence.
struct Fresnel {
    vec3 f0;
    float f90;
};

Fresnel metalFresnel(Bsdf bsdf) { return Fresnel(bsdf.baseColor, 1.0); }
Fresnel dielectricFresnelOf(Bsdf bsdf) { return Fresnel(bsdf.f0, bsdf.specular); }

// Albedo in a direction. `single`: reflectionAlbedo there; `mean`: reflectionMeanAlbedo.
vec3 reflectedAlbedo(Fresnel fresnel, vec2 single, vec2 mean) {
    float loss = 1.0 - single.x - single.y;
    return fresnel.f0 * single.x + fresnel.f90 * single.y +
           loss * severalAlbedo(fresnel.f0, fresnel.f90, 1.0 - mean.x - mean.y);
}

// `single`, `several`: what the microfacets scatter once (without Fresnel reflectance) and several times; `cosine`:
// between a direction and the microfacet.
vec3 reflectedEvaluate(Fresnel fresnel, float single, float several, float meanLoss, float cosine) {
    return schlickFresnel(fresnel.f0, fresnel.f90, cosine) * single +
           severalAlbedo(fresnel.f0, fresnel.f90, meanLoss) * several;
}

#endif

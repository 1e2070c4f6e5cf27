// f_opaque: ordinary BSDFs. Directions are unit vectors that point away from the surface, in the frame whose z axis is
// the shading normal. Both directions are on the same side of the surface.
#ifndef DUOLUX_LIB_BSDF_GLSL
#define DUOLUX_LIB_BSDF_GLSL

#include "shaders/lib/warp.glsl"

struct Bsdf {
    vec3 diffuse;  // albedo
};

struct BsdfSample {
    vec3 wi;      // in the shading frame
    float pdf;    // per steradian
    vec3 weight;  // f |cos| / pdf
};

// f, per steradian.
vec3 bsdfEvaluate(Bsdf bsdf, vec3 wo, vec3 wi) { return bsdf.diffuse * (1.0 / kPi); }

// Density of bsdfSample, per steradian.
float bsdfPdf(Bsdf bsdf, vec3 wo, vec3 wi) { return max(wi.z, 0.0) * (1.0 / kPi); }

BsdfSample bsdfSample(Bsdf bsdf, vec3 wo, vec2 u) {
    vec3 wi = cosineHemisphere(u);
    return BsdfSample(wi, wi.z * (1.0 / kPi), bsdf.diffuse);
}

// Fraction of the light that is scattered, per channel. Work is distributed over vertices in proportion to it.
vec3 bsdfAlbedo(Bsdf bsdf, vec3 wo) { return bsdf.diffuse; }

#endif

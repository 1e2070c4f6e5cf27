// Lambert's law: f = albedo / pi.
#ifndef DUOLUX_LIB_BSDF_DIFFUSE_GLSL
#define DUOLUX_LIB_BSDF_DIFFUSE_GLSL

#include "shaders/lib/bsdf/bsdf_types.glsl"
#include "shaders/lib/frame.glsl"

vec3 diffuseEvaluate(Bsdf bsdf) { return bsdf.baseColor * (1.0 / kPi); }

// Density of diffuseSample. `normal`: normalOfMode.
float diffusePdf(vec3 normal, vec3 wi) { return max(dot(normal, wi), 0.0) * (1.0 / kPi); }

BsdfSample diffuseSample(Bsdf bsdf, vec3 normal, vec2 u) {
    vec3 local = cosineHemisphere(u);
    return BsdfSample(fromFrame(normal, local), local.z * (1.0 / kPi), bsdf.baseColor);
}

#endif

// GGX microfacets (Trowbridge and Reitz, "Average Irregularity Representation of a Rough Surface for Ray Reflection",
// JOSA 65(5), 1975; Walter et al., "Microfacet Models for Refraction through Rough Surfaces", EGSR 2007) with
// height-correlated masking and shadowing (Heitz, "Understanding the Masking-Shadowing Function in Microfacet-Based
// BRDFs", JCGT 3(2), 2014, eq. 99), and Fresnel reflectances.
// Directions are in the frame of the shading normal. `alpha`: along x and y.
#ifndef DUOLUX_LIB_BSDF_MICROFACET_GLSL
#define DUOLUX_LIB_BSDF_MICROFACET_GLSL

#include "shaders/lib/bsdf/bsdf_types.glsl"

// A direction below the horizon of a shading normal counts as grazing.
vec3 aboveHorizon(vec3 w) { return normalize(vec3(w.xy, max(w.z, 1e-3))); }

// Schlick, "An Inexpensive BRDF Model for Physically-based Rendering", Computer Graphics Forum 13(3), 1994.
vec3 schlickFresnel(vec3 f0, float f90, float cosine) {
    float m = clamp(1.0 - cosine, 0.0, 1.0);
    return f0 + (f90 - f0) * (m * m * m * m * m);
}

// The exact reflectance of unpolarised light. `eta`: index of refraction of the other side relative to that of the
// direction.
float dielectricFresnel(float cosine, float eta) {
    float c = clamp(cosine, 0.0, 1.0);
    float refracted2 = 1.0 - (1.0 - c * c) / (eta * eta);
    float refracted = sqrt(max(refracted2, 0.0));
    float parallel = (eta * c - refracted) / (eta * c + refracted);
    float perpendicular = (c - eta * refracted) / (c + eta * refracted);
    return refracted2 > 0.0 ? 0.5 * (parallel * parallel + perpendicular * perpendicular) : 1.0;
}

// Density of microfacet normals per steradian.
float ggxDistribution(vec2 alpha, vec3 h) {
    vec2 slope = h.xy / alpha;
    float scaled = dot(slope, slope) + h.z * h.z;
    return 1.0 / (kPi * alpha.x * alpha.y * scaled * scaled);
}

// The cosine of w times 1 + 2 Lambda: Smith's masking is G1 = 2 cos / (cos + smithTerm).
float smithTerm(vec2 alpha, vec3 w) {
    vec2 stretched = alpha * w.xy;
    return sqrt(dot(stretched, stretched) + w.z * w.z);
}

// Masking and shadowing of both directions, over 4 cos cos. `wi` is on either side.
float ggxVisibility(vec2 alpha, vec3 wo, vec3 wi) {
    return 0.5 / (abs(wi.z) * smithTerm(alpha, wo) + wo.z * smithTerm(alpha, wi));
}

// Single scattering, without Fresnel reflectance. Both directions are above the horizon.
float ggxEvaluate(vec2 alpha, vec3 wo, vec3 wi) {
    return ggxDistribution(alpha, normalize(wo + wi)) * ggxVisibility(alpha, wo, wi);
}

// Density per steradian of ggxNormal, over wo . h.
float ggxVisibleDensity(vec2 alpha, vec3 wo, vec3 h) {
    return ggxDistribution(alpha, h) * 2.0 / (wo.z + smithTerm(alpha, wo));
}

// Density per steradian of reflecting wo at a normal from ggxNormal.
float ggxPdf(vec2 alpha, vec3 wo, vec3 wi) {
    if (wi.z <= 0.0) return 0.0;
    return ggxVisibleDensity(alpha, wo, normalize(wo + wi)) * 0.25;
}

// A visible microfacet normal: Dupuy and Benyoub, "Sampling Visible GGX Normals with Spherical Caps", HPG 2023.
vec3 ggxNormal(vec2 alpha, vec3 wo, vec2 u) {
    vec3 stretched = normalize(vec3(wo.xy * alpha, wo.z));
    float z = (1.0 - u.y) * (1.0 + stretched.z) - stretched.z;
    float r = sqrt(max(1.0 - z * z, 0.0));
    float phi = azimuth(u.x);
    vec3 sum = vec3(r * cos(phi), r * sin(phi), z) + stretched;
    return normalize(vec3(sum.xy * alpha, max(sum.z, 0.0)));
}

// The result may be below the horizon, where nothing is reflected.
vec3 mirrored(vec3 wo, vec3 h) { return 2.0 * dot(wo, h) * h - wo; }

#endif

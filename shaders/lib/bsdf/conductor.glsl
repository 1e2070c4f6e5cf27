// Metals: isotropic GGX microfacets (Trowbridge and Reitz, "Average Irregularity Representation of a Rough Surface for
// Ray Reflection", JOSA 65(5), 1975; Walter et al., "Microfacet Models for Refraction through Rough Surfaces", EGSR
// 2007) with height-correlated masking and shadowing (Heitz, "Understanding the Masking-Shadowing Function in
// Microfacet-Based BRDFs", JCGT 3(2), 2014, eq. 99), Schlick's Fresnel reflectance with the base colour at normal
// incidence, and the light that is scattered several times between microfacets (Kulla and Conty, "Revisiting Physically
// Based Shading at Imageworks", SIGGRAPH 2017 course). Below kSmoothAlpha the surface is a mirror.
// Directions are in the frame of the shading normal.
#ifndef DUOLUX_LIB_BSDF_CONDUCTOR_GLSL
#define DUOLUX_LIB_BSDF_CONDUCTOR_GLSL

#include "shaders/lib/bsdf/bsdf_types.glsl"
#include "shaders/lib/frame.glsl"

float ggxAlpha(Bsdf bsdf) { return bsdf.roughness * bsdf.roughness; }

bool isMirror(Bsdf bsdf) { return ggxAlpha(bsdf) < kSmoothAlpha; }

// A direction below the horizon of a shading normal counts as grazing.
vec3 aboveHorizon(vec3 w) { return normalize(vec3(w.xy, max(w.z, 1e-3))); }

vec3 schlickFresnel(vec3 normalIncidence, float cosine) {
    float m = clamp(1.0 - cosine, 0.0, 1.0);
    return normalIncidence + (1.0 - normalIncidence) * (m * m * m * m * m);
}

// Density of microfacet normals per steradian.
float ggxDistribution(float alpha, vec3 h) {
    float scaled = dot(h.xy, h.xy) / (alpha * alpha) + h.z * h.z;
    return 1.0 / (kPi * alpha * alpha * scaled * scaled);
}

// cos / G1, up to the factor 2: Smith's masking is G1 = 2 cos / (cos + smithTerm).
float smithTerm(float alpha, float cosine) { return sqrt(alpha * alpha + (1.0 - alpha * alpha) * cosine * cosine); }

// Single scattering, without Fresnel reflectance. Both directions are above the horizon.
float ggxEvaluate(float alpha, vec3 wo, vec3 wi) {
    vec3 h = normalize(wo + wi);
    float masking = 0.5 / (wi.z * smithTerm(alpha, wo.z) + wo.z * smithTerm(alpha, wi.z));
    return ggxDistribution(alpha, h) * masking;
}

// Density per steradian of reflecting wo at a visible microfacet normal.
float ggxPdf(float alpha, vec3 wo, vec3 wi) {
    if (wi.z <= 0.0) return 0.0;
    return ggxDistribution(alpha, normalize(wo + wi)) * 0.5 / (wo.z + smithTerm(alpha, wo.z));
}

// Reflects wo at a visible microfacet normal: Dupuy and Benyoub, "Sampling Visible GGX Normals with Spherical Caps",
// HPG 2023. The result may be below the horizon, where nothing is reflected.
vec3 ggxSample(float alpha, vec3 wo, vec2 u) {
    vec3 stretched = normalize(vec3(wo.xy * alpha, wo.z));
    float z = (1.0 - u.y) * (1.0 + stretched.z) - stretched.z;
    float r = sqrt(max(1.0 - z * z, 0.0));
    float phi = azimuth(u.x);
    vec3 sum = vec3(r * cos(phi), r * sin(phi), z) + stretched;
    vec3 h = normalize(vec3(sum.xy * alpha, max(sum.z, 0.0)));
    return 2.0 * dot(wo, h) * h - wo;
}

// The fraction of light that single scattering loses, 1 - E of Kulla and Conty, for perfectly reflecting microfacets: a
// fit to numerical integrals with an error of at most 0.006.
float ggxLoss(float roughness, float cosine) {
    float r = roughness;
    float x = cosine / (cosine + r * r);
    float c0 = 0.598 + r * (-5.372 + r * (14.969 + r * (-14.208 + r * 8.528)));
    float c1 = -0.539 + r * (39.3 + r * (-131.748 + r * (173.088 - r * 104.44)));
    float c2 = -12.903 + r * (-11.55 + r * (145.416 + r * (-351.538 + r * 366.134)));
    float c3 = 43.439 + r * (-79.396 + r * (-162.421 + r * (872.466 - r * 969.913)));
    float c4 = -31.014 + r * (38.084 + r * (280.908 + r * (-1006.77 + r * 979.987)));
    float loss = x * (1.0 - x) * (1.0 - x) * (c0 + x * (c1 + x * (c2 + x * (c3 + x * c4))));
    // Below, less than 0.1 % are lost on average.
    return roughness > 0.1 ? clamp(loss, 0.0, 1.0) : 0.0;
}

// The mean of ggxLoss over the hemisphere, weighted by the cosine.
float ggxMeanLoss(float roughness) {
    float r = roughness;
    float series = -8.4176 + r * (124.7567 + r * (-524.2333 + r * (1080.3836 + r * (-1203.3163 +
                                                                                  r * (694.4084 - r * 162.9926)))));
    return max(r * r * r * r * series, 1e-6);
}

// The albedo of what is scattered several times, in proportion to the loss of single scattering: the Fresnel
// reflectance of each further reflection (mean of Schlick's: f + (1 - f) / 21).
vec3 multipleScattering(vec3 normalIncidence, float roughness) {
    vec3 fresnel = normalIncidence + (1.0 - normalIncidence) * (1.0 / 21.0);
    float meanLoss = ggxMeanLoss(roughness);
    return fresnel * fresnel * (1.0 - meanLoss) / (1.0 - fresnel * meanLoss);
}

// f, per steradian; 0 for a mirror. Reciprocal.
vec3 conductorEvaluate(Bsdf bsdf, vec3 wo, vec3 wi) {
    if (isMirror(bsdf)) return vec3(0.0);
    vec3 o = aboveHorizon(wo);
    vec3 i = aboveHorizon(wi);
    vec3 fresnel = schlickFresnel(bsdf.baseColor, dot(o, normalize(o + i)));
    float losses = ggxLoss(bsdf.roughness, o.z) * ggxLoss(bsdf.roughness, i.z) / (kPi * ggxMeanLoss(bsdf.roughness));
    return fresnel * ggxEvaluate(ggxAlpha(bsdf), o, i) + multipleScattering(bsdf.baseColor, bsdf.roughness) * losses;
}

// Density of conductorSample, per steradian; 0 for a mirror. Multiple scattering is left to the sampling of another
// lobe.
float conductorPdf(Bsdf bsdf, vec3 wo, vec3 wi) {
    return isMirror(bsdf) ? 0.0 : ggxPdf(ggxAlpha(bsdf), aboveHorizon(wo), wi);
}

vec3 conductorSample(Bsdf bsdf, vec3 wo, vec2 u) {
    vec3 o = aboveHorizon(wo);
    return isMirror(bsdf) ? vec3(-o.xy, o.z) : ggxSample(ggxAlpha(bsdf), o, u);
}

// Fraction of the light that is scattered, per channel: exact for a mirror, otherwise approximate.
vec3 conductorAlbedo(Bsdf bsdf, float cosine) { return schlickFresnel(bsdf.baseColor, abs(cosine)); }

#endif

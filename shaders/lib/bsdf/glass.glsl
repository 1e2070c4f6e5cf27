// Dielectrics that light enters: reflection and refraction at GGX microfacets (Walter et al., "Microfacet Models for
// Refraction through Rough Surfaces", EGSR 2007) with exact Fresnel reflectance, and what is scattered several times.
// A thin wall does not bend light: it scatters what it transmits as it reflects, mirrored to the other side. A smooth
// surface has one direction of reflection and one of refraction. The base colour scales what is transmitted.
#ifndef DUOLUX_LIB_BSDF_GLASS_GLSL
#define DUOLUX_LIB_BSDF_GLASS_GLSL

#include "shaders/lib/bsdf/albedo.glsl"
#include "shaders/lib/bsdf/microfacet.glsl"

// What glass loses by single scattering: on the side of wo (x) and on the other side (y). `w`: wo, or wi on either
// side. There are no tables of stretched glass: that of the roughness across the tangent loses less in all directions,
// so that stretched glass makes no light, but absorbs some.
vec2 glassLoss(Bsdf bsdf, vec3 w) {
    if (isThin(bsdf)) {
        vec2 single = facetAlbedo(bsdf, w);
        return vec2(1.0 - single.x - single.y);
    }
    vec2 loss = 1.0 - glassTableAlbedo(abs(w.z), bsdf.roughness, max(bsdf.eta, 1.0 / bsdf.eta));
    return bsdf.eta >= 1.0 ? loss : loss.yx;
}
vec2 glassMeanLoss(Bsdf bsdf) {
    if (isThin(bsdf)) {
        vec2 single = facetMeanAlbedo(bsdf);
        return vec2(max(1.0 - single.x - single.y, 1e-6));
    }
    vec2 loss = max(1.0 - glassMeanAlbedo(bsdf.roughness, max(bsdf.eta, 1.0 / bsdf.eta)), 1e-6);
    return bsdf.eta >= 1.0 ? loss : loss.yx;
}

// The fraction of the lost light that leaves on the other side. Any fractions x (from this side) and y (from the other)
// with x n^2 loss = y n'^2 loss' make the sum reciprocal; half of the largest such fractions.
float glassSeveralThrough(Bsdf bsdf, vec2 meanLoss) {
    float eta = isThin(bsdf) ? 1.0 : bsdf.eta;
    return 0.5 * min(1.0, eta * eta * meanLoss.y / meanLoss.x);
}

// The microfacet that refracts between the two directions, on the side of wo.
vec3 refractingNormal(vec3 wo, vec3 wi, float eta) {
    vec3 h = normalize(wo + eta * wi);
    return h.z < 0.0 ? -h : h;
}

// The refracted direction; dot(wo, h) > 0 and not totally reflected.
vec3 refracted(vec3 wo, vec3 h, float eta) {
    float c = dot(wo, h);
    float inner = sqrt(max(1.0 - (1.0 - c * c) / (eta * eta), 0.0));
    return normalize((c / eta - inner) * h - wo / eta);
}

vec3 otherSide(vec3 w) { return vec3(w.xy, -w.z); }

// f of microfacets that are not smooth, for radiance that leaves along wo; wi is on the other side.
vec3 glassTransmit(Bsdf bsdf, vec3 wo, vec3 wi) {
    if (isThin(bsdf)) {
        vec3 h = normalize(wo + otherSide(wi));
        float passed = 1.0 - dielectricFresnel(dot(wo, h), bsdf.eta);
        return bsdf.baseColor * (passed * ggxEvaluate(bsdf.alpha, wo, otherSide(wi)));
    }
    vec3 h = refractingNormal(wo, wi, bsdf.eta);
    float o = dot(wo, h);
    float i = dot(wi, h);
    if (o <= 0.0 || i >= 0.0) return vec3(0.0);
    float denominator = o + bsdf.eta * i;
    float single = 4.0 * o * -i * ggxDistribution(bsdf.alpha, h) * ggxVisibility(bsdf.alpha, wo, wi) /
                   max(denominator * denominator, 1e-12);
    return bsdf.baseColor * (single * (1.0 - dielectricFresnel(o, bsdf.eta)));
}

// Density of reaching wi, on the other side, by refraction at a normal from ggxNormal; without the probability of
// refraction, which `passed` returns: 1 - Fresnel reflectance.
float glassTransmitPdf(Bsdf bsdf, vec3 wo, vec3 wi, out float passed) {
    vec3 h = isThin(bsdf) ? normalize(wo + otherSide(wi)) : refractingNormal(wo, wi, bsdf.eta);
    float o = dot(wo, h);
    float i = dot(wi, h);
    passed = 1.0 - dielectricFresnel(o, bsdf.eta);
    if (isThin(bsdf)) return ggxVisibleDensity(bsdf.alpha, wo, h) * 0.25;
    if (o <= 0.0 || i >= 0.0) return 0.0;
    float denominator = o + bsdf.eta * i;
    return ggxVisibleDensity(bsdf.alpha, wo, h) * o * bsdf.eta * bsdf.eta * -i / max(denominator * denominator, 1e-12);
}

#endif

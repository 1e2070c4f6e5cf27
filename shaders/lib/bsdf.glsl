// f_opaque: the sum of a surface's lobes (bsdf/). kLobes has the bits of the lobes that any material of the scene has,
// so that a scene does not pay for others.
#ifndef DUOLUX_LIB_BSDF_GLSL
#define DUOLUX_LIB_BSDF_GLSL

#include "shaders/lib/bsdf/conductor.glsl"
#include "shaders/lib/bsdf/diffuse.glsl"
#include "shaders/lib/reflectance_matrix.glsl"

layout(constant_id = kSpecLobes) const uint kLobes = kLobeDiffuse + kLobeConductor;

const bool kOnlyDiffuse = kLobes == kLobeDiffuse;
const bool kTransmits = (kLobes & kLobesThatTransmit) != 0u;

// f, per steradian.
vec3 bsdfEvaluate(Bsdf bsdf, BsdfFrame frame, vec3 wo, vec3 wi, uint mode) {
    if (!reflects(frame, wo, wi, mode)) return vec3(0.0);
    if (kOnlyDiffuse) return diffuseEvaluate(bsdf);
    vec3 metal = conductorEvaluate(bsdf, toFrame(frame.shading, viewOf(wo, wi, mode)),
                                   toFrame(frame.shading, incidentOf(wo, wi, mode)));
    return mix(diffuseEvaluate(bsdf), metal, bsdf.metallic);
}

// The probability with which bsdfSample samples around the normal of the mode, with density cos / pi: for the diffuse
// lobe, for a metal's multiple scattering and, in importance mode, for directions below the shading normal's horizon.
float cosineProbability(Bsdf bsdf, BsdfFrame frame, vec3 wo, uint mode) {
    float cosine = dot(frame.shading, wo);
    float metal = bsdf.metallic * maxComponent(conductorAlbedo(bsdf, cosine));
    float several = metal * (isMirror(bsdf) ? 0.0 : ggxLoss(bsdf.roughness, max(cosine, 1e-3)));
    float diffuse = (1.0 - bsdf.metallic) * maxComponent(bsdf.baseColor);
    float probability = diffuse + several > 0.0 ? (diffuse + several) / (diffuse + metal) : 0.0;
    bool certain = mode == kModeImportance && !isMirror(bsdf);
    return certain ? max(probability, 0.25) : probability;
}

// Density of bsdfSample, per steradian.
float bsdfPdf(Bsdf bsdf, BsdfFrame frame, vec3 wo, vec3 wi, uint mode) {
    float cosine = diffusePdf(normalOfMode(frame, mode), wi);
    if (kOnlyDiffuse) return cosine;
    float probability = cosineProbability(bsdf, frame, wo, mode);
    float facets = conductorPdf(bsdf, toFrame(frame.shading, wo), toFrame(frame.shading, wi));
    return mix(facets, cosine, probability);
}

// `choice`: a uniform number, which chooses the lobe.
BsdfSample bsdfSample(Bsdf bsdf, BsdfFrame frame, vec3 wo, float choice, vec2 u, uint mode) {
    BsdfSample s = diffuseSample(bsdf, normalOfMode(frame, mode), u);
    if (!kOnlyDiffuse) {
        float probability = cosineProbability(bsdf, frame, wo, mode);
        bool facet = choice >= probability;
        if (facet) s.wi = fromFrame(frame.shading, conductorSample(bsdf, toFrame(frame.shading, wo), u));
        float cosine = bsdfCosine(frame, s.wi, mode);
        s.pdf = bsdfPdf(bsdf, frame, wo, s.wi, mode);
        s.weight = bsdfEvaluate(bsdf, frame, wo, s.wi, mode) * (cosine / max(s.pdf, 1e-30));
        if (facet && isMirror(bsdf)) {
            // f is a delta distribution over the cosine to the shading normal.
            float ratio = cosine / max(abs(dot(frame.shading, s.wi)), 1e-30);
            s.weight = conductorAlbedo(bsdf, dot(frame.shading, s.wi)) *
                       (bsdf.metallic * ratio / (1.0 - probability));
            s.pdf = kDeltaPdf;
        }
        // Below the shading normal's horizon, only cosine sampling generates directions; samples of the microfacets
        // there are discarded.
        if (facet && dot(frame.shading, s.wi) <= 0.0) s.pdf = 0.0;
    }
    if (!kTransmits && dot(frame.geometric, s.wi) <= 0.0) s.pdf = 0.0;
    return s;
}

// Fraction of the light that is scattered, per channel. Work is distributed over vertices in proportion to it.
vec3 bsdfAlbedo(Bsdf bsdf, BsdfFrame frame, vec3 wo) {
    if (kOnlyDiffuse) return bsdf.baseColor;
    return mix(bsdf.baseColor, conductorAlbedo(bsdf, dot(frame.shading, wo)), bsdf.metallic);
}

#endif

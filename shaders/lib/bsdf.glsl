// f_opaque: a surface's lobes (bsdf/), layered as in glTF 2.0 (Khronos, "glTF 2.0 Specification", appendix B, and its
// extensions): sheen on clearcoat on a mixture of metal, glass and a diffuse surface under a dielectric's reflection.
// kLobes has the bits of the lobes that any material of the scene has, so that a scene does not pay for others.
//
// A layer reduces the light of those below it by what it reflects towards the view. This is not reciprocal, but both
// modes evaluate the same function. Every lobe by itself is reciprocal.
#ifndef DUOLUX_LIB_BSDF_GLSL
#define DUOLUX_LIB_BSDF_GLSL

#include "shaders/lib/bsdf/clearcoat.glsl"
#include "shaders/lib/bsdf/diffuse.glsl"
#include "shaders/lib/bsdf/glass.glsl"
#include "shaders/lib/bsdf/reflection.glsl"
#include "shaders/lib/bsdf/sheen.glsl"
#include "shaders/lib/reflectance_matrix.glsl"

const bool kOnlyDiffuse = kLobes == kLobeDiffuse;
const bool kTransmits = (kLobes & kLobesThatTransmit) != 0u;
const bool kMetal = (kLobes & kLobeMetal) != 0u;
const bool kDielectric = (kLobes & kLobeDielectric) != 0u;
const bool kGlass = (kLobes & kLobeGlass) != 0u;
const bool kClearcoat = (kLobes & kLobeClearcoat) != 0u;
const bool kSheen = (kLobes & kLobeSheen) != 0u;

// The fractions of the base: metal, glass, and the diffuse surface with its reflection.
float metalFraction(Bsdf bsdf) { return kMetal ? bsdf.metallic : 0.0; }
float glassFraction(Bsdf bsdf) { return kGlass ? (1.0 - metalFraction(bsdf)) * bsdf.transmission : 0.0; }
float diffuseFraction(Bsdf bsdf) { return 1.0 - metalFraction(bsdf) - glassFraction(bsdf); }

// The fraction that the layers on the base let through to a view on the outside. `cosine`, `toCoat`: of the view to the
// shading normal and to that of the clearcoat.
float throughLayers(Bsdf bsdf, float cosine, float toCoat) {
    float through = 1.0;
    if (kSheen) through *= 1.0 - sheenAlbedo(bsdf, cosine);
    if (kClearcoat) through *= 1.0 - clearcoatAlbedo(bsdf, toCoat);
    return through;
}

// f of the base under the clearcoat. `o`, `i`: local directions. The clearcoat reflects by the cosine of the incident
// light to its own normal, but f goes with that to the shading normal.
vec3 coated(vec3 base, Bsdf bsdf, BsdfFrame frame, vec3 wo, vec3 wi, vec3 o, vec3 i, uint mode) {
    vec3 coatO = toCoatFrame(frame, wo, o);
    vec3 coatI = toCoatFrame(frame, wi, i);
    float above = 1.0;
    if (hasCoatNormals()) {
        above = max(incidentOf(coatO, coatI, mode).z, 0.0) / incidentOf(o, i, mode).z;
        coatO = aboveHorizon(coatO);
        coatI = aboveHorizon(coatI);
    }
    return base * (1.0 - clearcoatAlbedo(bsdf, viewOf(coatO, coatI, mode).z)) +
           clearcoatEvaluate(bsdf, coatO, coatI) * above;
}

// f of the base on the side of wo. Directions in the frame of the shading normal, above its horizon.
vec3 baseEvaluate(Bsdf bsdf, vec3 wo, vec3 wi) {
    vec2 albedoO = facetAlbedo(bsdf, wo);
    vec2 albedoI = facetAlbedo(bsdf, wi);
    vec2 mean = facetMeanAlbedo(bsdf);
    Loss loss = Loss(1.0 - albedoO.x - albedoO.y, 1.0 - albedoI.x - albedoI.y, 1.0 - mean.x - mean.y);
    vec3 h = normalize(wo + wi);
    bool smoothFacets = isSmooth(bsdf);
    float single = smoothFacets ? 0.0 : ggxEvaluate(bsdf.alpha, wo, wi);
    float several = smoothFacets ? 0.0 : severalEvaluate(loss);
    float cosine = dot(wo, h);
    vec3 f = vec3(0.0);
    if (kMetal) f += metalFraction(bsdf) * reflectedEvaluate(metalFresnel(bsdf), single, several, loss.mean, cosine);
    vec3 diffuse = diffuseEvaluate(bsdf);
    if (kDielectric) {
        Fresnel fresnel = dielectricFresnelOf(bsdf);
        vec3 below = (1.0 - reflectedAlbedo(fresnel, albedoO, mean)) * (1.0 - reflectedAlbedo(fresnel, albedoI, mean)) /
                     max(1.0 - reflectedAlbedo(fresnel, mean, mean), 1e-6);
        diffuse = diffuse * below + reflectedEvaluate(fresnel, single, several, loss.mean, cosine);
    }
    f += diffuseFraction(bsdf) * diffuse;
    if (kGlass) {
        vec2 mean2 = glassMeanLoss(bsdf);
        float reflected = 0.0;
        if (!smoothFacets) {
            Loss lost = Loss(glassLoss(bsdf, wo).x, glassLoss(bsdf, wi).x, mean2.x);
            reflected = (1.0 - glassSeveralThrough(bsdf, mean2)) * severalEvaluate(lost);
        }
        f += glassFraction(bsdf) * vec3(single * dielectricFresnel(cosine, bsdf.eta) + reflected);
    }
    return f;
}

// f for radiance that leaves along wo, where wi is on the other side.
vec3 throughEvaluate(Bsdf bsdf, vec3 wo, vec3 wi) {
    if (isSmooth(bsdf)) return vec3(0.0);
    vec2 mean = glassMeanLoss(bsdf);
    float several = glassSeveralThrough(bsdf, mean) *
                    severalEvaluate(Loss(glassLoss(bsdf, wo).x, glassLoss(bsdf, wi).y, mean.y));
    // Radiance grows with the square of the index of refraction: Veach 1997, section 5.2.
    float growth = isThin(bsdf) ? 1.0 : 1.0 / (bsdf.eta * bsdf.eta);
    return glassFraction(bsdf) * (glassTransmit(bsdf, wo, wi) + bsdf.baseColor * (several * growth));
}

// The square of the index of refraction on the side of wi over that on the side of wo, where light passes.
float indexRatio(Bsdf bsdf) { return isThin(bsdf) ? 1.0 : bsdf.eta * bsdf.eta; }

// f, per steradian.
vec3 bsdfEvaluate(Bsdf bsdf, BsdfFrame frame, vec3 wo, vec3 wi, uint mode) {
    bool reflected = reflects(frame, wo, wi, mode);
    if (kOnlyDiffuse) return reflected ? diffuseEvaluate(bsdf) : vec3(0.0);
    vec3 o = aboveHorizon(toShadingFrame(frame, wo));
    vec3 local = toShadingFrame(frame, wi);
    vec3 f = vec3(0.0);
    if (reflected) {
        vec3 i = aboveHorizon(local);
        f = baseEvaluate(bsdf, o, i);
        if (isOutside(bsdf)) {
            float view = viewOf(o, i, mode).z;
            if (kClearcoat) f = coated(f, bsdf, frame, wo, wi, o, i, mode);
            if (kSheen) f = f * (1.0 - sheenAlbedo(bsdf, view)) + sheenEvaluate(bsdf, o, i);
        }
    }
    if (kTransmits && !reflected && transmits(frame, wo, wi)) {
        vec3 i = otherSide(aboveHorizon(otherSide(local)));
        f = throughEvaluate(bsdf, o, i);
        if (mode == kModeImportance) f *= indexRatio(bsdf);
        bool viewOutside = isOutside(bsdf) == (mode == kModeRadiance);
        float view = abs(viewOf(o, i, mode).z);
        if (viewOutside) f *= throughLayers(bsdf, view, coatCosine(frame, viewOf(wo, wi, mode), view));
    }
    return f;
}

// The sampling strategies and their probabilities. The sum of the first five is 1.
struct Strategies {
    float cosine;     // density cos / pi around the normal of the mode: diffuse, several scatterings
    float sheen;      // uniform on the hemisphere around the shading normal
    float facets;     // a visible microfacet normal of the base, at which light is reflected or refracted
    float clearcoat;  // of the clearcoat, at which light is reflected
    float through;    // density cos / pi on the other side: several scatterings
    float refracted;  // of `facets`: the fraction that is glass, refracted with the probability 1 - Fresnel reflectance
};

// In proportion to what each scatters, in its largest channel. `local`: wo; `toCoat`: its cosine to the normal of the
// clearcoat.
Strategies bsdfStrategies(Bsdf bsdf, vec3 local, float toCoat, uint mode) {
    vec3 o = vec3(local.xy, max(local.z, 1e-3));
    bool smoothFacets = isSmooth(bsdf);
    vec2 single = facetAlbedo(bsdf, o);
    vec2 mean = facetMeanAlbedo(bsdf);
    float meanLoss = 1.0 - mean.x - mean.y;
    float loss = smoothFacets ? 0.0 : 1.0 - single.x - single.y;
    float metal = metalFraction(bsdf);
    float under = diffuseFraction(bsdf);
    float glass = glassFraction(bsdf);
    float facets = 0.0;
    float spread = 0.0;
    if (kMetal) {
        facets += metal * maxComponent(bsdf.baseColor * single.x + single.y);
        spread += metal * loss * maxComponent(severalAlbedo(bsdf.baseColor, 1.0, meanLoss));
    }
    float below = maxComponent(bsdf.baseColor);
    if (kDielectric) {
        vec3 reflected = bsdf.f0 * single.x + bsdf.specular * single.y;
        vec3 several = loss * severalAlbedo(bsdf.f0, bsdf.specular, meanLoss);
        facets += under * maxComponent(reflected);
        spread += under * maxComponent(several);
        below *= 1.0 - maxComponent(reflected + several);
    }
    spread += under * max(below, 0.0);
    Strategies s = Strategies(0.0, 0.0, 0.0, 0.0, 0.0, 0.0);
    if (kGlass) {
        vec2 meanLosses = glassMeanLoss(bsdf);
        float lost = smoothFacets ? 0.0 : glassLoss(bsdf, o).x;
        float x = glassSeveralThrough(bsdf, meanLosses);
        facets += glass * (1.0 - lost);
        spread += glass * lost * (1.0 - x);
        s.through = glass * lost * x;
        s.refracted = facets > 0.0 ? glass * (1.0 - lost) / facets : 0.0;
    }
    float sheen = 0.0;
    float coat = 0.0;
    if (kSheen && isOutside(bsdf)) sheen = sheenAlbedo(bsdf, o.z);
    if (kClearcoat && isOutside(bsdf)) coat = (1.0 - sheen) * clearcoatAlbedo(bsdf, max(toCoat, 1e-3));
    float base = 1.0 - sheen - coat;
    s.cosine = base * spread;
    s.sheen = sheen;
    s.facets = base * facets;
    s.clearcoat = coat;
    s.through *= base;
    float rest = s.sheen + s.facets + s.clearcoat + s.through;
    float sum = s.cosine + rest;
    // Below the shading normal's horizon, only cosine sampling generates directions.
    bool roughCoat = coat > 0.0 && !isSmoothClearcoat(bsdf);
    float least = mode == kModeImportance && (!smoothFacets || roughCoat || sheen > 0.0) ? 0.25 : 0.0;
    if (s.cosine < least * sum) {
        float scale = (1.0 - least) * sum / rest;
        s.sheen *= scale;
        s.facets *= scale;
        s.clearcoat *= scale;
        s.through *= scale;
        s.cosine = least * sum;
    }
    float inverse = sum > 0.0 ? 1.0 / sum : 0.0;
    return Strategies(sum > 0.0 ? s.cosine * inverse : 1.0, s.sheen * inverse, s.facets * inverse,
                      s.clearcoat * inverse, s.through * inverse, s.refracted);
}

// Density of all strategies that are not deltas. Local directions: `o` above the horizon.
float strategiesPdf(Strategies s, Bsdf bsdf, BsdfFrame frame, vec3 wo, vec3 o, vec3 wi, vec3 i, uint mode) {
    // Where the two normals see wi on different sides, samples are discarded.
    bool above = dot(frame.geometric, wi) > 0.0;
    float pdf = above ? s.cosine * diffusePdf(normalOfMode(frame, mode), wi) : 0.0;
    if (above && i.z > 0.0) {
        if (!isSmooth(bsdf)) {
            float reflected = 1.0;
            if (kGlass) reflected -= s.refracted * (1.0 - dielectricFresnel(dot(o, normalize(o + i)), bsdf.eta));
            pdf += s.facets * reflected * ggxPdf(bsdf.alpha, o, i);
        }
        if (kSheen) pdf += s.sheen * (0.5 / kPi);
        if (kClearcoat && !isSmoothClearcoat(bsdf)) {
            vec3 coatO = toCoatFrame(frame, wo, o);
            if (hasCoatNormals()) coatO = aboveHorizon(coatO);
            pdf += s.clearcoat * ggxPdf(clearcoatAlpha(bsdf), coatO, toCoatFrame(frame, wi, i));
        }
    } else if (kTransmits && !above && i.z < 0.0) {
        pdf += s.through * -i.z * (1.0 / kPi);
        if (!isSmooth(bsdf)) {
            float passed;
            float density = glassTransmitPdf(bsdf, o, i, passed);
            pdf += s.facets * s.refracted * passed * density;
        }
    }
    return pdf;
}

// Density of bsdfSample, per steradian.
float bsdfPdf(Bsdf bsdf, BsdfFrame frame, vec3 wo, vec3 wi, uint mode) {
    if (kOnlyDiffuse) return diffusePdf(normalOfMode(frame, mode), wi);
    vec3 o = toShadingFrame(frame, wo);
    Strategies s = bsdfStrategies(bsdf, o, coatCosine(frame, wo, o.z), mode);
    return strategiesPdf(s, bsdf, frame, wo, aboveHorizon(o), wi, toShadingFrame(frame, wi), mode);
}

// f |cos| / pdf for a smooth surface, without the probability of its strategy. `o`, `i`: local directions; `toCoat`:
// the cosine of the view to the normal of the clearcoat.
vec3 smoothWeight(Bsdf bsdf, Strategies s, vec3 o, vec3 i, float toCoat, bool refraction, uint mode) {
    vec3 weight = vec3(0.0);
    float fresnel = dielectricFresnel(o.z, bsdf.eta);
    if (refraction) {
        float growth = mode == kModeRadiance ? 1.0 / indexRatio(bsdf) : 1.0;
        weight = glassFraction(bsdf) * (1.0 - fresnel) * growth * bsdf.baseColor;
        weight /= max(s.refracted * (1.0 - fresnel), 1e-30);
    } else {
        if (kMetal) weight += metalFraction(bsdf) * schlickFresnel(bsdf.baseColor, 1.0, o.z);
        if (kDielectric) weight += diffuseFraction(bsdf) * schlickFresnel(bsdf.f0, bsdf.specular, o.z);
        if (kGlass) {
            weight += glassFraction(bsdf) * vec3(fresnel);
            weight /= max(1.0 - s.refracted * (1.0 - fresnel), 1e-30);
        }
    }
    bool viewOutside = isOutside(bsdf) == (mode == kModeRadiance || !refraction);
    if (viewOutside) weight *= throughLayers(bsdf, abs(viewOf(o, i, mode).z), toCoat);
    return weight;
}

// `choice`: a uniform number, which chooses the lobe.
BsdfSample bsdfSample(Bsdf bsdf, BsdfFrame frame, vec3 wo, float choice, vec2 u, uint mode) {
    BsdfSample s = diffuseSample(bsdf, normalOfMode(frame, mode), u);
    if (!kOnlyDiffuse) {
        vec3 local = toShadingFrame(frame, wo);
        vec3 o = aboveHorizon(local);
        Strategies strategies = bsdfStrategies(bsdf, local, coatCosine(frame, wo, local.z), mode);
        bool fromSheen = kSheen && choice >= strategies.cosine && choice < strategies.cosine + strategies.sheen;
        float rest = choice - strategies.cosine - strategies.sheen;
        bool fromFacets = rest >= 0.0 && (rest < strategies.facets || strategies.clearcoat + strategies.through <= 0.0);
        bool fromCoat = kClearcoat && rest >= 0.0 && !fromFacets &&
                        (rest < strategies.facets + strategies.clearcoat || strategies.through <= 0.0);
        bool fromThrough = kTransmits && rest >= 0.0 && !fromFacets && !fromCoat;
        bool refraction = false;
        bool deltaFacets = fromFacets && isSmooth(bsdf);
        bool deltaCoat = fromCoat && isSmoothClearcoat(bsdf);
        vec3 i = vec3(0.0, 0.0, 1.0);
        bool bentCoat = hasCoatNormals() && fromCoat;
        if (fromFacets || fromCoat) {
            vec3 h = vec3(0.0, 0.0, 1.0);
            vec3 from = o;
            if (bentCoat) from = aboveHorizon(toFrame(frame.coat, wo));
            if (!deltaFacets && !deltaCoat) h = ggxNormal(fromCoat ? clearcoatAlpha(bsdf) : bsdf.alpha, from, u);
            i = mirrored(from, h);
            if (kGlass && fromFacets) {
                float passed = strategies.refracted * (1.0 - dielectricFresnel(dot(o, h), bsdf.eta));
                refraction = rest < passed * strategies.facets;
                if (refraction) i = isThin(bsdf) ? otherSide(i) : refracted(o, h, bsdf.eta);
            }
            s.wi = bentCoat ? fromFrame(frame.coat, i) : fromShadingFrame(frame, i);
        }
        if (fromSheen) s.wi = fromShadingFrame(frame, uniformHemisphere(u));
        if (fromThrough) {
            i = otherSide(cosineHemisphere(u));
            s.wi = fromShadingFrame(frame, i);
        }
        float cosine = bsdfCosine(frame, s.wi, mode);
        if (deltaFacets || deltaCoat) {
            // f is a delta distribution over the cosine to the shading normal.
            vec3 incident = bentCoat ? incidentOf(wo, s.wi, mode) : s.wi;
            float ratio = cosine / max(abs(dot(frame.shading, incident)), 1e-30);
            float probability = deltaCoat ? strategies.clearcoat : strategies.facets;
            vec3 weight = vec3(0.0);
            if (deltaFacets) {
                float toCoat = coatCosine(frame, viewOf(wo, s.wi, mode), abs(viewOf(o, i, mode).z));
                weight = smoothWeight(bsdf, strategies, o, i, toCoat, refraction, mode);
            }
            if (deltaCoat) {
                weight = vec3(clearcoatReflectance(bsdf, bentCoat ? i.z : o.z));
                if (bentCoat && dot(frame.coat, incident) <= 0.0) weight = vec3(0.0);
                if (kSheen) {
                    vec3 inFrame = bentCoat ? aboveHorizon(toShadingFrame(frame, s.wi)) : i;
                    weight *= 1.0 - sheenAlbedo(bsdf, viewOf(o, inFrame, mode).z);
                }
            }
            // Rounding may choose a lobe that scatters nothing.
            s.weight = probability > 0.0 ? weight * (ratio / probability) : vec3(0.0);
            s.pdf = kDeltaPdf;
        } else {
            vec3 inFrame = toShadingFrame(frame, s.wi);
            s.pdf = strategiesPdf(strategies, bsdf, frame, wo, o, s.wi, inFrame, mode);
            s.weight = bsdfEvaluate(bsdf, frame, wo, s.wi, mode) * (cosine / max(s.pdf, 1e-30));
        }
        // Samples of microfacets on the wrong side of either normal are discarded.
        bool wrongSide = (fromSheen || fromFacets || fromCoat || fromThrough) &&
                         (refraction || fromThrough
                              ? dot(frame.geometric, s.wi) >= 0.0 || dot(frame.shading, s.wi) >= 0.0
                              : dot(frame.shading, s.wi) <= 0.0 || (bentCoat && i.z <= 0.0));
        bool through = refraction || fromThrough;
        if (wrongSide || (!through && dot(frame.geometric, s.wi) <= 0.0)) s.pdf = 0.0;
    } else if (dot(frame.geometric, s.wi) <= 0.0) {
        s.pdf = 0.0;
    }
    return s;
}

// The fraction of the light that is scattered, per channel: approximate, and 0 only where nothing is scattered. Work is
// distributed over vertices in proportion to it.
vec3 bsdfAlbedo(Bsdf bsdf, BsdfFrame frame, vec3 wo) {
    if (kOnlyDiffuse) return bsdf.baseColor;
    float cosine = abs(dot(frame.shading, wo));
    vec3 albedo = diffuseFraction(bsdf) * bsdf.baseColor;
    if (kDielectric) {
        vec3 reflected = schlickFresnel(bsdf.f0, bsdf.specular, cosine);
        albedo = diffuseFraction(bsdf) * (reflected + (1.0 - reflected) * bsdf.baseColor);
    }
    if (kMetal) albedo += metalFraction(bsdf) * schlickFresnel(bsdf.baseColor, 1.0, cosine);
    if (kGlass) {
        float reflected = dielectricFresnel(cosine, bsdf.eta);
        albedo += glassFraction(bsdf) * (reflected + (1.0 - reflected) * bsdf.baseColor);
    }
    if (isOutside(bsdf)) {
        if (kClearcoat) albedo = mix(albedo, vec3(1.0), clearcoatReflectance(bsdf, coatCosine(frame, wo, cosine)));
        if (kSheen) {
            float sheen = min(sheenTableAlbedo(cosine, bsdf.sheenRoughness), 1.0);
            albedo = albedo * (1.0 - sheenAlbedo(bsdf, cosine)) + bsdf.sheenColor * sheen;
        }
    }
    return clamp(albedo, 0.0, 1.0);
}

#endif

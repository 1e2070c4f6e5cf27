// Cloth: the Charlie distribution of fibres with its shadowing (Conty Estevez and Kulla, "Production Friendly
// Microfacet Sheen BRDF", SIGGRAPH 2017 course). It lies on the other lobes, which get what it does not reflect.
// Directions are in the frame of the shading normal, above its horizon.
#ifndef DUOLUX_LIB_BSDF_SHEEN_GLSL
#define DUOLUX_LIB_BSDF_SHEEN_GLSL

#include "shaders/lib/bsdf/albedo.glsl"
#include "shaders/lib/bsdf/bsdf_types.glsl"
#include "shaders/lib/reflectance_matrix.glsl"

float sheenAlpha(Bsdf bsdf) { return max(bsdf.sheenRoughness * bsdf.sheenRoughness, 0.04); }

float sheenCurve(float x, float alpha) {
    float blend = (1.0 - alpha) * (1.0 - alpha);
    float a = mix(21.5473, 25.3245, blend);
    float b = mix(3.82987, 3.32435, blend);
    float c = mix(0.19823, 0.16801, blend);
    float d = mix(-1.97760, -1.27393, blend);
    float e = mix(-4.32054, -4.85967, blend);
    return a / (1.0 + b * pow(x, c)) + d * x + e;
}

float sheenShadow(float cosine, float alpha) {
    return cosine < 0.5 ? exp(sheenCurve(cosine, alpha))
                        : exp(2.0 * sheenCurve(0.5, alpha) - sheenCurve(1.0 - cosine, alpha));
}

vec3 sheenEvaluate(Bsdf bsdf, vec3 wo, vec3 wi) {
    float alpha = sheenAlpha(bsdf);
    vec3 h = normalize(wo + wi);
    float sine2 = max(1.0 - h.z * h.z, 0.0);
    float distribution = (2.0 + 1.0 / alpha) * pow(sine2, 0.5 / alpha) * (0.5 / kPi);
    float visibility = 0.25 / ((1.0 + sheenShadow(wo.z, alpha) + sheenShadow(wi.z, alpha)) * wo.z * wi.z);
    // Fibres of small roughness would reflect more than arrives at grazing directions.
    float most = max(sheenTableAlbedo(wo.z, bsdf.sheenRoughness), sheenTableAlbedo(wi.z, bsdf.sheenRoughness));
    return bsdf.sheenColor * (distribution * visibility / max(most, 1.0));
}

// The fraction that sheen reflects, in its largest channel: the other lobes lose it in all channels.
float sheenAlbedo(Bsdf bsdf, float cosine) {
    return maxComponent(bsdf.sheenColor) * min(sheenTableAlbedo(cosine, bsdf.sheenRoughness), 1.0);
}

#endif

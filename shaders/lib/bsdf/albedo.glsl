// Directional albedos, interpolated in the tables of albedo_layout.h, and the light that microfacets scatter several
// times (Kulla and Conty, "Revisiting Physically Based Shading at Imageworks", SIGGRAPH 2017 course). The kernel that
// includes this defines fetchAlbedoTexel.
#ifndef DUOLUX_LIB_BSDF_ALBEDO_GLSL
#define DUOLUX_LIB_BSDF_ALBEDO_GLSL

#include "shaders/lib/warp.glsl"
#include "shaders/shared/albedo_layout.h"

uvec4 fetchAlbedoTexel(uint index);

// The two functions of a cell at a place inside it.
vec2 interpolateCell(uint texel, vec2 inCell) {
    uvec4 t = fetchAlbedoTexel(texel);
    vec2 first = mix(unpackUnorm2x16(t.x), unpackUnorm2x16(t.y), inCell.y);
    vec2 second = mix(unpackUnorm2x16(t.z), unpackUnorm2x16(t.w), inCell.y);
    return vec2(mix(first.x, first.y, inCell.x), mix(second.x, second.y, inCell.x));
}

// A table of cosine and roughness with `cells` cells per axis.
vec2 albedoAt(uint table, uint cells, float cosine, float roughness) {
    vec2 place = vec2(sqrt(clamp(cosine, 0.0, 1.0)), clamp(roughness, 0.0, 1.0)) * float(cells);
    vec2 cell = min(floor(place), float(cells - 1u));
    return interpolateCell(table + uint(cell.y) * cells + uint(cell.x), place - cell);
}

// A table of roughness alone.
vec2 meanAlbedoAt(uint table, uint cells, float roughness) {
    float place = clamp(roughness, 0.0, 1.0) * float(cells);
    float cell = min(floor(place), float(cells - 1u));
    return interpolateCell(table + uint(cell), vec2(0.0, place - cell));
}

// GGX reflection by single scattering: the albedo is f0 * x + f90 * y.
vec2 reflectionAlbedo(float cosine, float roughness) {
    return albedoAt(kAlbedoReflection, kAlbedoCells, cosine, roughness);
}
vec2 reflectionMeanAlbedo(float roughness) { return meanAlbedoAt(kAlbedoReflectionMean, kAlbedoCells, roughness); }

float sheenTableAlbedo(float cosine, float roughness) {
    return 2.0 * albedoAt(kAlbedoSheen, kAlbedoCells, cosine, roughness).x;
}

float iorPlace(float ior) {
    float root = (ior - 1.0) / (ior + 1.0);
    return pow(min(root * (1.0 / kAlbedoLargestIor), 1.0), 1.0 / 3.0) * float(kAlbedoIors - 1u);
}

// Glass by single scattering, from outside (x) and from inside (y). `ior`: >= 1.
vec2 glassTableAlbedo(float cosine, float roughness, float ior) {
    float place = iorPlace(ior);
    float slice = min(floor(place), float(kAlbedoIors - 2u));
    uint table = kAlbedoGlass + uint(slice) * kAlbedoGlassCells * kAlbedoGlassCells;
    vec2 low = albedoAt(table, kAlbedoGlassCells, cosine, roughness);
    vec2 high = albedoAt(table + kAlbedoGlassCells * kAlbedoGlassCells, kAlbedoGlassCells, cosine, roughness);
    return mix(low, high, place - slice);
}
vec2 glassMeanAlbedo(float roughness, float ior) {
    float place = iorPlace(ior);
    float slice = min(floor(place), float(kAlbedoIors - 2u));
    uint table = kAlbedoGlassMean + uint(slice) * kAlbedoGlassCells;
    return mix(meanAlbedoAt(table, kAlbedoGlassCells, roughness),
               meanAlbedoAt(table + kAlbedoGlassCells, kAlbedoGlassCells, roughness), place - slice);
}

// What a rough reflecting surface loses by single scattering at two directions, and on average over the hemisphere.
struct Loss {
    float wo;
    float wi;
    float mean;
};

// f of light that is scattered several times, per unit of `albedo` (severalAlbedo). Reciprocal.
float severalEvaluate(Loss loss) { return loss.wo * loss.wi / (kPi * max(loss.mean, 1e-6)); }

// The fraction of the lost light that further reflections with Schlick's Fresnel reflectance return (its mean over the
// hemisphere is f0 + (f90 - f0) / 21).
vec3 severalAlbedo(vec3 f0, float f90, float meanLoss) {
    vec3 fresnel = f0 + (f90 - f0) * (1.0 / 21.0);
    return fresnel * fresnel * (1.0 - meanLoss) / (1.0 - fresnel * meanLoss);
}

#endif

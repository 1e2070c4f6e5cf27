// Directional albedos, interpolated in the tables of albedo_layout.h, and the light that microfacets scatter several
// times (Kulla and Conty, "Revisiting Physically Based Shading at Imageworks", SIGGRAPH 2017 course). The kernel that
// includes this defines fetchAlbedoTexel.
#ifndef DUOLUX_LIB_BSDF_ALBEDO_GLSL
#define DUOLUX_LIB_BSDF_ALBEDO_GLSL

#include "shaders/lib/bsdf/bsdf_types.glsl"
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

// The anisotropy that stretches alpha from y to x, as in KHR_materials_anisotropy.
float anisotropyOf(vec2 alpha) {
    return sqrt(clamp((alpha.x - alpha.y) / max(1.0 - alpha.y, 1e-6), 0.0, 1.0));
}

// As reflectionAlbedo, of microfacets that are stretched along the tangent. `azimuth`: |cos| of that of the direction.
vec2 stretchedAlbedo(float cosine, float azimuth, float roughness, float anisotropy) {
    vec2 place = clamp(vec2(azimuth, anisotropy), vec2(0.0), vec2(1.0)) *
                 vec2(float(kAlbedoAzimuthCells), float(kAlbedoAnisotropyCells));
    vec2 cell = min(floor(place), vec2(float(kAlbedoAzimuthCells - 1u), float(kAlbedoAnisotropyCells - 1u)));
    vec2 inCell = place - cell;
    uint slice = kAlbedoStretchedCells * kAlbedoStretchedCells;
    uint row = (kAlbedoAzimuthCells + 1u) * slice;
    uint table = kAlbedoStretched + uint(cell.y) * row + uint(cell.x) * slice;
    vec2 low = mix(albedoAt(table, kAlbedoStretchedCells, cosine, roughness),
                   albedoAt(table + slice, kAlbedoStretchedCells, cosine, roughness), inCell.x);
    vec2 high = mix(albedoAt(table + row, kAlbedoStretchedCells, cosine, roughness),
                    albedoAt(table + row + slice, kAlbedoStretchedCells, cosine, roughness), inCell.x);
    return mix(low, high, inCell.y);
}
vec2 stretchedMeanAlbedo(float roughness, float anisotropy) {
    float place = clamp(anisotropy, 0.0, 1.0) * float(kAlbedoAnisotropyCells);
    float cell = min(floor(place), float(kAlbedoAnisotropyCells - 1u));
    uint table = kAlbedoStretchedMean + uint(cell) * kAlbedoStretchedCells;
    return mix(meanAlbedoAt(table, kAlbedoStretchedCells, roughness),
               meanAlbedoAt(table + kAlbedoStretchedCells, kAlbedoStretchedCells, roughness), place - cell);
}

// Reflection by a surface's microfacets. `w`: a direction in the frame of the shading normal, on either side.
vec2 facetAlbedo(Bsdf bsdf, vec3 w) {
    if (!kAnisotropic || bsdf.alpha.x <= bsdf.alpha.y) return reflectionAlbedo(abs(w.z), bsdf.roughness);
    float azimuth = abs(w.x) / max(length(w.xy), 1e-6);
    return stretchedAlbedo(abs(w.z), azimuth, bsdf.roughness, anisotropyOf(bsdf.alpha));
}
vec2 facetMeanAlbedo(Bsdf bsdf) {
    if (!kAnisotropic || bsdf.alpha.x <= bsdf.alpha.y) return reflectionMeanAlbedo(bsdf.roughness);
    return stretchedMeanAlbedo(bsdf.roughness, anisotropyOf(bsdf.alpha));
}

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
// hemisphere is f0 + (f90 - f0) / 21). No more than all of it, although colours may be above 1.
vec3 severalAlbedo(vec3 f0, float f90, float meanLoss) {
    vec3 fresnel = min(f0 + (f90 - f0) * (1.0 / 21.0), vec3(1.0));
    return fresnel * fresnel * (1.0 - meanLoss) / (1.0 - fresnel * meanLoss);
}

#endif

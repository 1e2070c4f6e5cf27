// Next-event estimation: sampling a point on an emitter, and the densities that multiple importance sampling needs
// (Veach, "Robust Monte Carlo Methods for Light Transport Simulation", 1997, section 9.2).
// The kernel that includes this defines fetchLightTexel.
#ifndef DUOLUX_LIB_LIGHTS_GLSL
#define DUOLUX_LIB_LIGHTS_GLSL

#include "shaders/lib/intersect.glsl"
#include "shaders/lib/plane.glsl"
#include "shaders/lib/rng.glsl"
#include "shaders/lib/warp.glsl"
#include "shaders/shared/path_layout.h"

uvec4 fetchLightTexel(uint index);

// An emitting triangle.
struct LightTriangle {
    vec3 v0;
    vec3 v1;
    vec3 v2;
    uint material;
    float positionError;
    uint triangle;    // as in DeviceLight
    uint primitive;
    uint coincident;
};

LightTriangle fetchLight(uint index) {
    uvec4 t0 = fetchLightTexel(index * kLightTexels);
    uvec4 t1 = fetchLightTexel(index * kLightTexels + 1u);
    uvec4 t2 = fetchLightTexel(index * kLightTexels + 2u);
    uvec4 t3 = fetchLightTexel(index * kLightTexels + 3u);
    return LightTriangle(uintBitsToFloat(t0.xyz), uintBitsToFloat(t1.xyz), uintBitsToFloat(t2.xyz), t0.w,
                         uintBitsToFloat(t1.w), t2.w, t3.z, t3.w);
}

struct LightSample {
    vec3 position;
    vec3 normal;          // unit, on the front side
    uint material;
    float positionError;
    uint triangle;        // as in DeviceLight
    uint primitive;
    uint coincident;      // 1: other surfaces lie in the same place
};

// Samples a point with density DeviceMaterial.lightPdfArea: an emitting triangle by the alias table, then a point
// uniformly on it. `u`: uniform words; all 32 bits of the first are used, so that many emitters can be told apart.
LightSample sampleLight(uint lightCount, uvec2 u) {
    uint index, fraction;
    umulExtended(u.x, lightCount, index, fraction);
    float rest = uniformFloat(fraction);
    uvec4 entry = fetchLightTexel(index * kLightTexels + 3u);
    float threshold = uintBitsToFloat(entry.x);
    bool keep = rest < threshold;
    index = keep ? index : entry.y;
    // Within the chosen interval the random number is uniform; it is stretched to [0, 1) and reused.
    float remapped = (keep ? rest : rest - threshold) / (keep ? threshold : 1.0 - threshold);
    vec2 b = uniformTriangle(vec2(min(remapped, 0.99999994), uniformFloat(u.y)));

    LightTriangle light = fetchLight(index);
    vec3 normal = normalize(cross(light.v1 - light.v0, light.v2 - light.v0));
    vec3 position = light.v0 * (1.0 - b.x - b.y) + light.v1 * b.x + light.v2 * b.y;
    float error = light.positionError;
    if (kPlanes) {
        Plane plane = fetchPlane(light.triangle);
        position = ontoPlane(plane, position);
        error = planeError(plane, position);
    }
    return LightSample(position, normal, light.material, error, light.triangle, light.primitive,
                       kPlanes ? light.coincident : 0u);
}

// Flux of a particle (W) per unit of emitted radiance: the point is sampled by sampleLight, the side uniformly from
// `sides`, and the direction with density cos / pi.
float emittedFlux(float pdfArea, float sides) { return kPi * sides / pdfArea; }

// Converts the density pdfArea (m^-2) of a point on an emitter to a density per steradian at a point
// sqrt(distanceSquared) away.
float pdfAreaToSolidAngle(float pdfArea, float distanceSquared, float cosAtLight) {
    return pdfArea * distanceSquared / max(abs(cosAtLight), 1e-12);
}

// Balance heuristic: the weight of the strategy with density a.
float balanceHeuristic(float a, float b) { return a > 0.0 ? a / (a + b) : 0.0; }

#endif

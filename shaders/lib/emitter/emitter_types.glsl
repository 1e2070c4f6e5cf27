// Emitters as records, and what every kind of emitter in this folder returns. The kernel that includes this defines
// fetchEmitterTexel and emissionTexel.
#ifndef DUOLUX_LIB_EMITTER_EMITTER_TYPES_GLSL
#define DUOLUX_LIB_EMITTER_EMITTER_TYPES_GLSL

#include "shaders/lib/reflectance_matrix.glsl"
#include "shaders/lib/surface.glsl"
#include "shaders/lib/texture_groups.glsl"
#include "shaders/shared/emitter_layout.h"

uvec4 fetchEmitterTexel(uint index);
// The factor by which textures, colours of vertices and coverage scale the emission at a point of a triangle in device
// memory.
vec3 emissionTexel(uint triangle, vec2 barycentric);

// Whether emission differs between the points of a triangle.
bool emissionVaries() { return isEmissionScaled() || kCoverage; }

struct Emitter {
    vec3 v0;
    vec3 v1;
    vec3 v2;
    uint flags;
    float positionError;
    uint triangle;  // as in DeviceEmitter
    Radiance2 emission;
    float density;
};

Emitter fetchEmitter(uint index) {
    uint texel = index * kEmitterTexels;
    uvec4 t0 = fetchEmitterTexel(texel);
    uvec4 t1 = fetchEmitterTexel(texel + 1u);
    uvec4 t2 = fetchEmitterTexel(texel + 2u);
    uvec4 t3 = fetchEmitterTexel(texel + 3u);
    uvec4 t4 = fetchEmitterTexel(texel + 4u);
    return Emitter(uintBitsToFloat(t0.xyz), uintBitsToFloat(t1.xyz), uintBitsToFloat(t2.xyz), t4.w,
                   uintBitsToFloat(t1.w), t2.w, Radiance2(uintBitsToFloat(t3.xyz), uintBitsToFloat(t4.xyz)),
                   uintBitsToFloat(t3.w));
}

// The entry of the alias table at an index.
struct AliasEntry {
    float threshold;
    uint alias;
};

AliasEntry fetchAliasEntry(uint index) {
    uvec4 t = fetchEmitterTexel(index * kEmitterTexels + kEmitterAliasTexel);
    return AliasEntry(uintBitsToFloat(t.x), t.y);
}

// A point on an emitter.
struct EmitterPoint {
    vec3 position;
    vec3 normal;  // unit, on the front side
    float positionError;
    vec2 barycentric;  // on a triangle
};

// The direction in which a point of the scene receives light from an emitter.
struct EmitterSample {
    vec3 wi;             // unit, from the point to the emitter
    float distance;      // to just in front of the emitter, or to the emitter itself if surfaces coincide with it
    Radiance2 emission;  // radiance that leaves the emitter towards the point
    float pdf;           // per steradian; if `delta`, the probability of choosing the emitter
    bool delta;          // wi is the only direction, and emission is irradiance that faces it
    uint emitter;        // index
    uint coincident;     // the emitter's triangle in device memory if other surfaces coincide with it, else kNoTriangle
};

// A light path that leaves an emitter.
struct EmittedRay {
    SurfacePoint point;  // its normals are on the side on which the light path leaves
    vec3 direction;      // unit
    Radiance2 flux;      // W: emission divided by the density of the ray
};

// What the camera sees of a point on an emitter.
struct EmitterSeen {
    SurfacePoint point;   // its normals are on the side that faces the camera
    Radiance2 intensity;  // emission divided by the density of the point, W sr^-1
};

// The emitter of the triangle with this rank. A triangle that does not emit has a record without sides.
Emitter emitterOfTriangle(uint rank, uint emittingTriangles) {
    bool emits = rank < emittingTriangles;
    Emitter emitter = fetchEmitter(emits ? rank : 0u);
    emitter.flags = emits ? emitter.flags : 0u;
    return emitter;
}

// The radiance that an emitter sends to one side.
Radiance2 emissionOn(Emitter emitter, bool front) {
    bool emits = (emitter.flags & (front ? kEmitterFront : kEmitterBack)) != 0u;
    return Radiance2(emits ? emitter.emission.invisible : vec3(0.0), emits ? emitter.emission.visible : vec3(0.0));
}

// The same at a point of the emitter.
Radiance2 emissionAt(Emitter emitter, EmitterPoint on, bool front) {
    Radiance2 emission = emissionOn(emitter, front);
    if (emissionVaries()) emission = scaled(emission, emissionTexel(emitter.triangle, on.barycentric));
    return emission;
}

#endif

// What a lane keeps while it traces light paths.
#ifndef DUOLUX_LIB_LIGHT_PATH_GLSL
#define DUOLUX_LIB_LIGHT_PATH_GLSL

#include "shaders/lib/bsdf.glsl"
#include "shaders/lib/light_matrix.glsl"
#include "shaders/lib/lights.glsl"
#include "shaders/lib/surface.glsl"
#include "shaders/shared/light_layout.h"

// A particle under way: the segment it is on.
struct LightPath {
    uvec2 id;          // its number
    Light flux;        // here on the segment, what the surfaces crossed have done included; W
    float emitted;     // flux it began with, the unit of Russian roulette
    vec3 origin;
    vec3 direction;
    float t;           // the last surface crossed on the segment, and where: the walk goes on after it
    uint order;
    uint scatterings;  // events before the segment
    uint crossings;    // on the segment
    bool ended;
};

// Where a particle may scatter. One vertex of a segment is kept, by weighted reservoir sampling.
struct Vertex {
    Light flux;       // O L, of the chosen vertex, with the adjoint's factor for shading normals
    Bsdf bsdf;
    SurfacePoint point;
    vec3 wi;          // to where the particle came from
    float weight;     // of the chosen vertex
    float weightSum;  // of all vertices of the segment
};

// What leaves a point of a path for the camera, if that is on the side of the normal: radiance per path and unit of
// area, the emitter's or what a surface scatters. (W sr^-1 in all, for a particle's flux is in W.)
struct Outgoing {
    SurfacePoint point;
    Light radiance;
    uint scatterings;  // events on the path
};

// A ray to the camera under way.
struct Connection {
    bool pending;
    vec3 origin;
    vec3 direction;
    float distance;
    float t;            // last surface crossed
    uint order;
    Light light;        // what would arrive if nothing more came in between
    float roulette;     // a uniform number, and the part of all connections that are still under way
    float survival;
    uint pixel;
    uint scatterings;   // events on the path, for the statistics
    uint dimension;     // of its random numbers
};

// Of a sampled emitter, on the side of `normal`. It is behind others if surfaces coincide: they may be on either side.
SurfacePoint pointOnLight(LightSample light, vec3 normal) {
    vec3 position = light.coincident != 0u ? light.position : light.position + normal * light.positionError;
    return SurfacePoint(position, normal, normal, light.triangle, light.coincident);
}

struct LaneSums {
    uint nonFinite;
    uint clamped;
    uint lightRays;
    uint bounceRays;
    uint shadowRays;
    uvec2 lastBounce;
    uvec2 previousBounce;
    uvec2 invisible;
    uvec2 visible;
};

LaneSums emptySums() { return LaneSums(0u, 0u, 0u, 0u, 0u, uvec2(0u), uvec2(0u), uvec2(0u), uvec2(0u)); }

LaneResult laneResult(LaneSums sums) {
    return LaneResult(sums.nonFinite, sums.clamped, sums.lightRays, sums.bounceRays, sums.shadowRays,
                      uint[2](sums.lastBounce.x, sums.lastBounce.y),
                      uint[2](sums.previousBounce.x, sums.previousBounce.y),
                      uint[2](sums.invisible.x, sums.invisible.y), uint[2](sums.visible.x, sums.visible.y));
}

#endif

// The state of a lane of the light tracer.
#ifndef DUOLUX_LIB_LIGHT_PATH_GLSL
#define DUOLUX_LIB_LIGHT_PATH_GLSL

#include "shaders/lib/bsdf.glsl"
#include "shaders/lib/light_matrix.glsl"
#include "shaders/lib/lights.glsl"
#include "shaders/lib/surface.glsl"
#include "shaders/shared/light_layout.h"

// A particle in flight and the segment it is on.
struct LightPath {
    uvec2 id;          // number of the light path (low, high)
    Light flux;        // on the segment, after all surfaces crossed so far; W
    float emitted;     // flux at the emitter, W: the reference of Russian roulette
    vec3 origin;
    vec3 direction;
    float t;           // (t, order) of the last surface crossed on the segment; the ray continues behind it
    uint order;
    uint scatterings;  // events before the segment
    uint crossings;    // on the segment
    bool ended;
};

// A surface at which the particle may scatter. Weighted reservoir sampling chooses one vertex of a segment.
struct Vertex {
    Light flux;       // O L at the chosen vertex, times shadingAdjoint
    Bsdf bsdf;
    SurfacePoint point;
    vec3 wi;          // direction to the particle's origin
    float weight;     // of the chosen vertex
    float weightSum;  // of all vertices of the segment
};

// Radiant intensity that leaves a vertex of a light path on the side of its normal, by emission or by scattering
// (W sr^-1, because a particle carries flux in W). It is connected to the camera.
struct Outgoing {
    SurfacePoint point;
    Light radiance;
    uint scatterings;  // scattering events on the path
};

// A ray to the camera in flight.
struct Connection {
    bool pending;
    vec3 origin;
    vec3 direction;
    float distance;
    float t;            // (t, order) of the last surface crossed
    uint order;
    Light light;        // contribution to the pixel if no further surface is crossed
    float roulette;     // uniform number of the connection's Russian roulette
    float survival;     // probability of having survived so far
    uint pixel;
    uint scatterings;   // scattering events on the path, for the statistics
    uint dimension;     // of its random numbers
};

// The point of a sampled emitter, on the side of `normal`. Coincident surfaces may be on either side, so the point
// counts as behind them.
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

// The state of a lane of the light tracer.
#ifndef DUOLUX_LIB_LIGHT_PATH_GLSL
#define DUOLUX_LIB_LIGHT_PATH_GLSL

#include "shaders/lib/reflectance_matrix.glsl"
#include "shaders/lib/surface.glsl"
#include "shaders/shared/light_tracer_layout.h"

// A light path in flight.
struct LightPath {
    uvec2 stream;         // number of the light path (high, low)
    Radiance2 flux;       // on the segment, after all surfaces crossed so far; W
    float emitted;        // flux at the emitter, W: the reference of Russian roulette
    Segment segment;
    uint scatterings;     // events before the segment
    uint crossings;       // on the segment
    bool ended;
    Radiance2 scattered;  // O L at the chosen vertex of the segment, times shadingAdjoint
};

// Radiant intensity that leaves a vertex of a light path towards the camera, by emission or by scattering (W sr^-1,
// because a light path carries flux in W).
struct Outgoing {
    SurfacePoint point;
    Radiance2 intensity;
    uint scatterings;  // scattering events on the path
};

// A ray to the camera in flight.
struct Connection {
    bool pending;
    Segment segment;
    float distance;
    Radiance2 arriving;  // contribution to the pixel if no further surface is crossed
    float roulette;      // uniform number of the connection's Russian roulette
    float survival;      // probability of having survived so far
    uint pixel;
    uint scatterings;    // scattering events on the path, for the statistics
    uint dimension;      // of its random numbers
};

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

LaneSums emptyLaneSums() { return LaneSums(0u, 0u, 0u, 0u, 0u, uvec2(0u), uvec2(0u), uvec2(0u), uvec2(0u)); }

LaneResult laneResult(LaneSums sums) {
    return LaneResult(sums.nonFinite, sums.clamped, sums.lightRays, sums.bounceRays, sums.shadowRays,
                      uint[2](sums.lastBounce.x, sums.lastBounce.y),
                      uint[2](sums.previousBounce.x, sums.previousBounce.y),
                      uint[2](sums.invisible.x, sums.invisible.y), uint[2](sums.visible.x, sums.visible.y));
}

#endif

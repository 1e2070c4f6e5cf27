// Records of the light tracer's kernel, in addition to those of path_tracer_layout.h, shared by C++ and GLSL
// (scalar block layout).
#ifndef DUOLUX_SHADERS_SHARED_LIGHT_TRACER_LAYOUT_H
#define DUOLUX_SHADERS_SHARED_LIGHT_TRACER_LAYOUT_H

#include "shaders/shared/path_tracer_layout.h"

DUOLUX_BEGIN

// The sums of the film (kBindingFilm) are in an array of buffers. Each buffer holds a band of pixels, because
// devices limit the size of a buffer. A pixel has six 64-bit sums in quanta: invisible r, g, b, visible r, g,
// b.
DUOLUX_CONST uint kMaxFilmBands = 8u;
DUOLUX_CONST uint kFilmSums = 6u;
DUOLUX_CONST float kStatisticsQuanta = 4096.0f;

// A range of light paths. Each path has a unique 64-bit number (low, high).
struct LightTracerDispatch {
    uint firstLow;
    uint firstHigh;
    uint count;
    uint teamPaths;    // paths that each team of lanes traces, one after the other
    uint firstResult;  // index of the first lane's result
    uint firstTeam;
    float inverseQuantum;
};

// Sums over the paths that a lane traced in one dispatch. 64-bit two's complement numbers as (low, high).
struct LaneResult {
    uint nonFinite;  // contributions dropped because they were not finite
    uint clamped;    // contributions brighter than the film can hold
    uint lightRays;
    uint bounceRays;
    uint shadowRays;     // to the camera
    uint lastBounce[2];  // displayed radiance (mean of channels) with PathParams.bounces scattering events,
                         // in units of kStatisticsQuanta, so coarse that many contributions fit
    uint previousBounce[2];  // the same with one event fewer
    uint invisible[2];       // all radiance that arrived (mean of channels), in the same units
    uint visible[2];
};

#ifdef __cplusplus
static_assert(sizeof(LaneResult) == 52 && sizeof(LightTracerDispatch) == 28);
#endif

DUOLUX_END
#endif

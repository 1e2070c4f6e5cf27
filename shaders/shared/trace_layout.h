// Records of the kernel that only traces given rays, shared by C++ and GLSL (scalar block layout).
#ifndef DUOLUX_SHADERS_SHARED_TRACE_LAYOUT_H
#define DUOLUX_SHADERS_SHARED_TRACE_LAYOUT_H

#include "shaders/shared/path_tracer_layout.h"

DUOLUX_BEGIN

DUOLUX_CONST uint kTraceNearest = 0u;
DUOLUX_CONST uint kTraceAnyHit = 1u;
DUOLUX_CONST uint kTraceAllCrossings = 2u;

struct TraceRay {
    vec3 origin;
    float tMin;
    vec3 direction;  // unit
    float tMax;
};

struct TraceHit {
    float t;      // distance to the nearest hit, any hit, or the first crossing; negative: no hit
    vec3 normal;  // on the triangle's front side, not unit; (crossings, 0, 0) with kTraceAllCrossings
};

// In place of hits where kSpecCount is true: sums over the dispatch.
struct TraceCounts {
    uint nodes;      // visited
    uint pairs;      // of triangles, tested
    uint nodeSteps;  // steps of a subgroup in which at least one lane visited a node
    uint pairSteps;  // steps of a subgroup in which at least one lane tested a pair
};

// The rays [0, rays) are divided into blocks of blockRays, one for each subgroup.
struct TraceDispatch {
    uint rays;
    uint blockRays;
};

DUOLUX_END
#endif

// Bindings and records of the kernel that traces given rays and nothing else, shared by C++ and GLSL (scalar
// block layout). It uses kBindingNodes and kBindingTriangles of path_layout.h and its constants 0 to 2, too.
#ifndef DUOLUX_SHADERS_SHARED_TRACE_LAYOUT_H
#define DUOLUX_SHADERS_SHARED_TRACE_LAYOUT_H

#include "shaders/shared/path_layout.h"

DUOLUX_BEGIN

DUOLUX_CONST uint kBindingRays = 2u;  // texels: TraceRay, of two texels
DUOLUX_CONST uint kBindingHits = 3u;  // storage: TraceHit

DUOLUX_CONST uint kSpecTraceMode = 3u;  // one of the kTrace... below
DUOLUX_CONST uint kSpecCount = 4u;      // count what the traversal does, which makes it slower

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
    float t;      // of the nearest hit, some hit, or the first crossing; negative: none
    vec3 normal;  // of the triangle's front, not normalised; (crossings, 0, 0) with kTraceAllCrossings
};

// In place of hits where kSpecCount is true: sums over the dispatch.
struct TraceCounts {
    uint nodes;      // visited
    uint pairs;      // of triangles, tested
    uint nodeSteps;  // of subgroups, in which at least one lane visited a node
    uint pairSteps;  // in which at least one tested a pair
};

// Rays of [0, rays) in blocks, one a subgroup.
struct TraceDispatch {
    uint rays;
    uint blockRays;
};

DUOLUX_END
#endif

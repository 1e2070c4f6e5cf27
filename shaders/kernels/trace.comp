// Traces given rays: the traversal by itself, for benchmarks. The lanes of a subgroup share a block of rays; lanes that
// have finished their rays take the next ones, as in the path tracer, so that all stay busy.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_KHR_shader_subgroup_basic : require

#include "shaders/shared/trace_layout.h"

layout(constant_id = kSpecTraceMode) const uint kMode = kTraceNearest;
#ifdef DUOLUX_RAY_QUERY
const bool kCount = false;  // the driver reports no counts
#else
layout(constant_id = kSpecCount) const bool kCount = false;
#endif

layout(binding = kBindingRays, rgba32ui) uniform readonly uimageBuffer rayTexels;
layout(binding = kBindingHits, scalar) writeonly buffer HitsBlock { TraceHit hits[]; };
layout(binding = kBindingHits, scalar) buffer CountsBlock { TraceCounts counts; };
layout(push_constant, scalar) uniform DispatchBlock { TraceDispatch dispatch; };

// What a lane does in the traversal, and how many steps the subgroup takes for it.
TraceCounts sums = TraceCounts(0u, 0u, 0u, 0u);

void countNode() {
    sums.nodeSteps += subgroupElect() ? 1u : 0u;
    sums.nodes += 1u;
}

void countPair() {
    sums.pairSteps += subgroupElect() ? 1u : 0u;
    sums.pairs += 1u;
}

#define DUOLUX_COUNT_NODE if (kCount) countNode();
#define DUOLUX_COUNT_PAIR if (kCount) countPair();

#include "shaders/kernels/layout.glsl"

uvec4 fetchPlaneTexel(uint index) { return uvec4(0u); }  // there are none: kPlanes is false

const bool kOrdered = kMode == kTraceAllCrossings;

Traversal startRay(uint index) {
    uvec4 t0 = imageLoad(rayTexels, int(2u * index));
    uvec4 t1 = imageLoad(rayTexels, int(2u * index + 1u));
    return traversalStart(0u, uintBitsToFloat(t0.xyz), uintBitsToFloat(t1.xyz), uintBitsToFloat(t0.w), kNoTriangle,
                          uintBitsToFloat(t1.w), kMode == kTraceAnyHit);
}

void main() {
    uint block = gl_GlobalInvocationID.x / gl_SubgroupSize;
    uint next = block * dispatch.blockRays;
    uint end = min(next + dispatch.blockRays, dispatch.rays);
    uint index = next + gl_SubgroupInvocationID;
    next += gl_SubgroupSize;
    bool busy = index < end;
    Traversal ray = startRay(min(index, dispatch.rays - 1u));
    ray.nodesLeft = busy;
    uint crossings = 0u;
    TraceHit first = TraceHit(-1.0, vec3(0.0));

    while (subgroupBallot(busy) != uvec4(0u)) {
        traverse(ray, kOrdered, kLeaveTraversal, kLeaveNodes);
        bool found = ray.triangle != kNoTriangle;
        bool done = busy && !traversalAlive(ray);
        if (kOrdered && done && found) {
            // Continues behind the surface.
            first.t = crossings == 0u ? ray.t : first.t;
            crossings += 1u;
            first.normal = vec3(float(crossings), 0.0, 0.0);
            uvec4 t1 = imageLoad(rayTexels, int(2u * index + 1u));
            ray = traversalStart(0u, ray.origin, ray.direction, ray.t, ray.order, uintBitsToFloat(t1.w), false);
            done = false;
        }
        if (done) {
            if (!kOrdered) {
                Triangle tri = fetchTriangle(found ? ray.triangle : 0u);
                first = TraceHit(found ? ray.t : -1.0, cross(tri.v1 - tri.v0, tri.v2 - tri.v0));
            }
            if (!kCount) hits[index] = first;
        }
        uvec4 idle = subgroupBallot(done);
        if (done) {
            index = next + subgroupBallotExclusiveBitCount(idle);
            busy = index < end;
            ray = startRay(min(index, dispatch.rays - 1u));
            ray.nodesLeft = busy;
            crossings = 0u;
            first = TraceHit(-1.0, vec3(0.0));
        }
        next += subgroupBallotBitCount(idle);
    }
    if (kCount) {
        atomicAdd(counts.nodes, sums.nodes);
        atomicAdd(counts.pairs, sums.pairs);
        atomicAdd(counts.nodeSteps, sums.nodeSteps);
        atomicAdd(counts.pairSteps, sums.pairSteps);
    }
}

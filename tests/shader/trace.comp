// Traces given rays through the tree: nearest hit, any hit, or a walk over all crossings.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "tests/shader/trace_layout.h"

layout(local_size_x = 64) in;

layout(binding = 0) uniform usamplerBuffer nodeTexels;
layout(binding = 1) uniform usamplerBuffer triangleTexels;
layout(binding = 2, scalar) readonly buffer RaysBlock { TestRay rays[]; };
layout(binding = 3, scalar) writeonly buffer HitsBlock { TestHit hits[]; };
layout(push_constant, scalar) uniform PushBlock { TestPush push; };

#include "shaders/lib/traverse.glsl"

uvec4 fetchNodeTexel(uint index) { return texelFetch(nodeTexels, int(index)); }
uvec4 fetchTriangleTexel(uint index) { return texelFetch(triangleTexels, int(index)); }

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= push.count) return;
    TestRay ray = rays[i];
    TestHit hit = TestHit(-1.0, 0xffffffffu, 0u, vec2(0.0));
    float tMin = ray.tMin;
    uint after = kNoTriangle;
    bool ordered = push.mode == kTestAllCrossings;
    bool again = true;
    while (again) {
        Traversal r = traversalStart(push.root, ray.origin, ray.direction, tMin, after, ray.tMax, push.mode == kTestAnyHit);
        while (traversalAlive(r)) traverse(r, ordered, 6u, 4u);
        bool found = r.triangle != kNoTriangle;
        if (found && hit.crossings == 0u) {
            hit.t = r.t;
            hit.primitive = r.primitive;
            hit.barycentric = r.barycentric;
        }
        hit.crossings += found ? 1u : 0u;
        tMin = r.t;
        after = r.primitive;
        again = ordered && found && hit.crossings < 4096u;
    }
    hits[i] = hit;
}

// Reads a triangle by its index in device memory. The kernel that includes this defines fetchPairTexel.
#ifndef DUOLUX_LIB_FETCH_TRIANGLE_GLSL
#define DUOLUX_LIB_FETCH_TRIANGLE_GLSL

#include "shaders/lib/intersect.glsl"
#include "shaders/shared/bvh_layout.h"

uvec4 fetchPairTexel(uint index);

const uint kNoTriangle = 0xffffffffu;

struct TrianglePair {
    Triangle first;
    Triangle second;  // degenerate if there is none
};

Triangle triangleOf(uvec4 t0, uvec4 t1, uvec4 t2) {
    return Triangle(uintBitsToFloat(t0.xyz), uintBitsToFloat(t1.xyz), uintBitsToFloat(t2.xyz), t0.w, t2.w);
}

TrianglePair fetchPair(uint pair) {
    uint texel = pair * kPairTexels;
    uvec4 t0 = fetchPairTexel(texel);
    uvec4 t1 = fetchPairTexel(texel + 1u);
    uvec4 t2 = fetchPairTexel(texel + 2u);
    uvec4 t3 = fetchPairTexel(texel + 3u);
    return TrianglePair(triangleOf(t0, t1, t2), triangleOf(t3, t2, t1));
}

Triangle fetchTriangle(uint index) {
    uint texel = (index >> 1u) * kPairTexels;
    bool second = (index & 1u) != 0u;
    return triangleOf(fetchPairTexel(texel + (second ? 3u : 0u)), fetchPairTexel(texel + (second ? 2u : 1u)),
                      fetchPairTexel(texel + (second ? 1u : 2u)));
}

#endif

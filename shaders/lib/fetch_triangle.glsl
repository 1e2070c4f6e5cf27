// A triangle of the scene, by its index in device memory. The kernel that includes this defines fetchTriangleTexel.
#ifndef DUOLUX_LIB_FETCH_TRIANGLE_GLSL
#define DUOLUX_LIB_FETCH_TRIANGLE_GLSL

#include "shaders/lib/intersect.glsl"
#include "shaders/shared/bvh_layout.h"

uvec4 fetchTriangleTexel(uint index);

const uint kNoTriangle = 0xffffffffu;

Triangle fetchTriangle(uint index) {
    uvec4 t0 = fetchTriangleTexel(index * kTriangleTexels);
    uvec4 t1 = fetchTriangleTexel(index * kTriangleTexels + 1u);
    uvec4 t2 = fetchTriangleTexel(index * kTriangleTexels + 2u);
    return Triangle(uintBitsToFloat(t0.xyz), uintBitsToFloat(t1.xyz), uintBitsToFloat(t2.xyz), t0.w, t1.w);
}

#endif

// Shading normals. The kernel that includes this defines fetchNormalTexel.
#ifndef DUOLUX_LIB_NORMALS_GLSL
#define DUOLUX_LIB_NORMALS_GLSL

#include "shaders/shared/path_tracer_layout.h"

uvec4 fetchNormalTexel(uint index);

// Unit vector from two snorm16: Cigolle et al., "A Survey of Efficient Representations for Independent Unit Vectors",
// JCGT 3(2), 2014.
vec3 octahedralDecode(uint bits) {
    vec2 e = vec2(float(int(bits << 16u) >> 16), float(int(bits) >> 16)) * (1.0 / 32767.0);
    vec3 n = vec3(e, 1.0 - abs(e.x) - abs(e.y));
    float fold = max(-n.z, 0.0);
    n.x += n.x >= 0.0 ? -fold : fold;
    n.y += n.y >= 0.0 ? -fold : fold;
    return normalize(n);
}

// The interpolated vertex normal at a point of a triangle; unit.
vec3 shadingNormal(uint triangle, vec2 barycentric) {
    uvec4 texel = fetchNormalTexel(triangle * kNormalTexels);
    return normalize(octahedralDecode(texel.x) * (1.0 - barycentric.x - barycentric.y) +
                     octahedralDecode(texel.y) * barycentric.x + octahedralDecode(texel.z) * barycentric.y);
}

#endif

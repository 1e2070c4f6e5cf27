// Shading normals. The kernel that includes this defines fetchNormalTexel and what vertex_records.glsl needs.
#ifndef DUOLUX_LIB_NORMALS_GLSL
#define DUOLUX_LIB_NORMALS_GLSL

#include "shaders/lib/octahedral.glsl"
#include "shaders/lib/vertex_records.glsl"
#include "shaders/shared/path_tracer_layout.h"

uvec4 fetchNormalTexel(uint index);

// The interpolated vertex normal at a point of a triangle; unit.
vec3 shadingNormal(uint triangle, vec2 barycentric) {
    if (kVertexRecords) return vertexNormal(fetchVertices(triangle), barycentric);
    uvec4 texel = fetchNormalTexel(triangle * kNormalTexels);
    return normalize(octahedralDecode(texel.x) * (1.0 - barycentric.x - barycentric.y) +
                     octahedralDecode(texel.y) * barycentric.x + octahedralDecode(texel.z) * barycentric.y);
}

#endif

// Vertices with normals, texture coordinates and tangents (texture_layout.h). The kernel that includes this defines
// fetchCornerTexel, fetchVertexTexel and fetchSecondUvTexel.
#ifndef DUOLUX_LIB_VERTEX_RECORDS_GLSL
#define DUOLUX_LIB_VERTEX_RECORDS_GLSL

#include "shaders/lib/octahedral.glsl"
#include "shaders/lib/warp.glsl"
#include "shaders/shared/kernel_interface.h"
#include "shaders/shared/texture_layout.h"

layout(constant_id = kSpecVertexRecords) const bool kVertexRecords = false;
layout(constant_id = kSpecSecondUvs) const bool kSecondUvs = false;

uvec4 fetchCornerTexel(uint index);
uvec4 fetchVertexTexel(uint index);
uvec4 fetchSecondUvTexel(uint index);

// The three vertices of a triangle.
struct VertexRecords {
    uvec4 first;
    uvec4 second;
    uvec4 third;
};

VertexRecords fetchVertices(uint triangle) {
    uvec4 corners = fetchCornerTexel(triangle * kCornerTexels);
    return VertexRecords(fetchVertexTexel(corners.x * kVertexTexels), fetchVertexTexel(corners.y * kVertexTexels),
                         fetchVertexTexel(corners.z * kVertexTexels));
}

// The interpolated vertex normal at a point of a triangle; unit.
vec3 vertexNormal(VertexRecords vertices, vec2 barycentric) {
    return normalize(octahedralDecode(vertices.first.x) * (1.0 - barycentric.x - barycentric.y) +
                     octahedralDecode(vertices.second.x) * barycentric.x +
                     octahedralDecode(vertices.third.x) * barycentric.y);
}

vec2 vertexUv(VertexRecords vertices, vec2 barycentric) {
    vec3 weights = vec3(1.0 - barycentric.x - barycentric.y, barycentric.x, barycentric.y);
    vec3 us = uintBitsToFloat(uvec3(vertices.first.y, vertices.second.y, vertices.third.y));
    vec3 vs = uintBitsToFloat(uvec3(vertices.first.z, vertices.second.z, vertices.third.z));
    return vec2(dot(us, weights), dot(vs, weights));
}

vec2 fetchSecondUv(uint vertex) {
    uvec4 texel = fetchSecondUvTexel(vertex >> 1u);
    bool odd = (vertex & 1u) != 0u;
    return vec2(uintBitsToFloat(odd ? texel.z : texel.x), uintBitsToFloat(odd ? texel.w : texel.y));
}

vec2 secondVertexUv(uint triangle, vec2 barycentric) {
    if (!kSecondUvs) return vec2(0.0);
    uvec4 corners = fetchCornerTexel(triangle * kCornerTexels);
    return fetchSecondUv(corners.x) * (1.0 - barycentric.x - barycentric.y) +
           fetchSecondUv(corners.y) * barycentric.x + fetchSecondUv(corners.z) * barycentric.y;
}

// The tangent of a vertex, unit; the zero vector if it is not known.
vec3 tangentDecode(uvec4 vertex) {
    vec3 x, y;
    orthonormalBasis(octahedralDecode(vertex.x), x, y);
    float angle = float(vertex.w & ((1u << kTangentAngleBits) - 1u)) * (6.283185307 / float(1u << kTangentAngleBits));
    return (vertex.w & kTangentKnown) != 0u ? cos(angle) * x + sin(angle) * y : vec3(0.0);
}

// Orthonormal directions at a point of a surface, on the triangle's front side: towards growing u, towards falling v,
// and the normal.
struct TangentFrame {
    vec3 tangent;
    vec3 bitangent;
    vec3 normal;
};

// The frame with this unit normal and the interpolated tangent, or any tangent where that is not known.
TangentFrame tangentFrame(VertexRecords vertices, vec2 barycentric, vec3 normal) {
    vec3 t = tangentDecode(vertices.first) * (1.0 - barycentric.x - barycentric.y) +
             tangentDecode(vertices.second) * barycentric.x + tangentDecode(vertices.third) * barycentric.y;
    t -= normal * dot(normal, t);
    TangentFrame frame;
    vec3 anyBitangent;
    orthonormalBasis(normal, frame.tangent, anyBitangent);
    if (dot(t, t) > 1e-6) frame.tangent = normalize(t);
    float side = (vertices.first.w & kTangentNegative) != 0u ? -1.0 : 1.0;
    frame.bitangent = cross(normal, frame.tangent) * side;
    frame.normal = normal;
    return frame;
}

#endif

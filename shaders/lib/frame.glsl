// Directions in the frame of a normal.
#ifndef DUOLUX_LIB_FRAME_GLSL
#define DUOLUX_LIB_FRAME_GLSL

#include "shaders/lib/warp.glsl"

// Transforms a unit direction to a frame whose z axis is the unit vector `normal`.
vec3 toFrame(vec3 normal, vec3 direction) {
    vec3 tangent, bitangent;
    orthonormalBasis(normal, tangent, bitangent);
    return vec3(dot(tangent, direction), dot(bitangent, direction), dot(normal, direction));
}

vec3 fromFrame(vec3 normal, vec3 local) {
    vec3 tangent, bitangent;
    orthonormalBasis(normal, tangent, bitangent);
    return normalize(tangent * local.x + bitangent * local.y + normal * local.z);
}

#endif

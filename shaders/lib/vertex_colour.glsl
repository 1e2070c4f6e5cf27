// Colours and alphas of vertices, which scale the base colour and alpha of a surface. The kernel that includes this
// defines fetchColourTexel.
#ifndef DUOLUX_LIB_VERTEX_COLOUR_GLSL
#define DUOLUX_LIB_VERTEX_COLOUR_GLSL

#include "shaders/shared/path_tracer_layout.h"

uvec4 fetchColourTexel(uint index);

// Three fractions of 10 bits each.
vec3 decodeFractions(uint bits) { return vec3(uvec3(bits, bits >> 10u, bits >> 20u) & 1023u) * (1.0 / 1023.0); }

// Linear RGB from the square roots of the channels.
vec3 decodeColour(uint bits) {
    vec3 root = decodeFractions(bits);
    return root * root;
}

// The interpolated vertex colour at a point of a triangle: linear RGB, 0 to 1.
vec3 vertexColour(uint triangle, vec2 barycentric) {
    uvec4 texel = fetchColourTexel(triangle * kColourTexels);
    return decodeColour(texel.x) * (1.0 - barycentric.x - barycentric.y) + decodeColour(texel.y) * barycentric.x +
           decodeColour(texel.z) * barycentric.y;
}

// The interpolated vertex alpha at a point of a triangle, 0 to 1.
float vertexAlpha(uint triangle, vec2 barycentric) {
    vec3 alphas = decodeFractions(fetchColourTexel(triangle * kColourTexels).w);
    return alphas.x * (1.0 - barycentric.x - barycentric.y) + alphas.y * barycentric.x + alphas.z * barycentric.y;
}

#endif

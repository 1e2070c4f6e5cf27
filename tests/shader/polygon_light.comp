// Evaluates projectedSolidAngle for given triangles.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

layout(local_size_x = 64) in;

struct PolygonInput {
    vec3 a;
    vec3 b;
    vec3 c;
    vec3 normal;
};

layout(binding = 0, scalar) readonly buffer InputBlock { PolygonInput inputs[]; };
layout(binding = 1, scalar) writeonly buffer OutputBlock { float outputs[]; };
layout(push_constant, scalar) uniform PushBlock { uint count; };

#include "shaders/lib/polygon_light.glsl"

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= count) return;
    PolygonInput p = inputs[i];
    outputs[i] = projectedSolidAngle(p.a, p.b, p.c, p.normal);
}

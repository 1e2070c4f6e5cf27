// Connects given points to the camera, and sends a ray back to where they were seen.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

layout(local_size_x = 64) in;

#include "shaders/lib/camera.glsl"

struct CameraOutput {
    uint visible;
    uint pixel;
    vec3 direction;
    float distance;
    float importance;
};

layout(binding = 0, scalar) readonly buffer InputBlock { vec3 points[]; };
layout(binding = 1, scalar) writeonly buffer OutputBlock { CameraOutput outputs[]; };
layout(binding = 2, scalar) uniform ParamsBlock { PathParams params; };
layout(push_constant, scalar) uniform PushBlock { uint count; };

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= count) return;
    CameraConnection c = connectToCamera(params, points[i]);
    outputs[i] = CameraOutput(c.visible ? 1u : 0u, c.pixel, c.direction, c.distance, c.importance);
}

// Evaluates random numbers and Sobol points for given arguments.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

layout(local_size_x = 64) in;

layout(binding = 0, scalar) readonly buffer InputBlock { uvec4 inputs[]; };
layout(binding = 1, scalar) writeonly buffer OutputBlock { uvec4 outputs[]; };
layout(push_constant, scalar) uniform PushBlock {
    uint count;
    uint function;  // 0: pcg4d(input); 1: sobolSecondReversed(x); 2: samplePair(x, y = pixel, z = dimension, w = seed)
};                  // 3: sobolPair(x, key (y, z, w, 0))

#include "shaders/lib/sampler.glsl"

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= count) return;
    uvec4 v = inputs[i];
    uvec4 result = uvec4(0u);
    if (function == 0u) result = pcg4d(v);
    if (function == 1u) result.x = sobolSecondReversed(v.x);
    if (function == 2u) result.xy = floatBitsToUint(samplePair(kSamplerSobol, v.y, v.x, v.z, v.w));
    if (function == 3u) result.xy = sobolPair(v.x, uvec4(v.yzw, 0u));
    outputs[i] = result;
}

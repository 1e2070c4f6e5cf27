// Counter-based random numbers: a hash of (pixel, sample, dimension, seed), without state.
#ifndef DUOLUX_LIB_RNG_GLSL
#define DUOLUX_LIB_RNG_GLSL

// pcg4d: Jarzynski and Olano, "Hash Functions for GPU Rendering", JCGT 9(3), 2020.
uvec4 pcg4d(uvec4 v) {
    v = v * 1664525u + 1013904223u;
    v.x += v.y * v.w;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    v.w += v.y * v.z;
    v ^= v >> 16u;
    v.x += v.y * v.w;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    v.w += v.y * v.z;
    return v;
}

// Uniform in [0, 1): a multiple of 2^-24.
float uniformFloat(uint bits) { return float(int(bits >> 8u)) * (1.0 / 16777216.0); }

vec2 uniformFloat2(uvec2 bits) { return vec2(uniformFloat(bits.x), uniformFloat(bits.y)); }

#endif

// Inputs for tests of frames.
#ifndef DUOLUX_TESTS_SHADER_FRAME_INPUTS_GLSL
#define DUOLUX_TESTS_SHADER_FRAME_INPUTS_GLSL

// Unit directions where a frame might fail: the poles, the seam n.z = 0 and -0.0 between the two cases of the
// formula, components so small that they or their squares are denormal, and directions near all these.
vec3 hardNormal() {
    uint which = randomUint() % 8u;
    float phi = randomFloat(0.0, 6.2831853);
    float sign = (randomUint() & 1u) == 0u ? 1.0 : -1.0;
    float tiny = randomScale(-140.0, -1.0);
    vec3 around = vec3(cos(phi), sin(phi), 0.0);
    if (which == 0u) return vec3(0.0, 0.0, sign);
    if (which == 1u) return normalize(vec3(around.xy * tiny, sign));
    if (which == 2u) return normalize(vec3(around.xy, sign * tiny));
    if (which == 3u) return normalize(around) * vec3(1.0, 1.0, sign);  // n.z is 0 or -0
    if (which == 4u) return vec3(sign, 0.0, uintBitsToFloat(randomUint() & 0x80000000u));
    if (which == 5u) return vec3(0.0, sign, uintBitsToFloat(randomUint() & 0x80000000u));
    if (which == 6u) return normalize(vec3(sign * tiny, around.y, around.x));
    return normalize(vec3(around.x, sign * tiny, around.y));
}

#endif

// Random inputs of tests. The generator differs from those of the libraries under test: RXS-M-XS of O'Neill, "PCG: A
// Family of Simple Fast Space-Efficient Statistically Good Algorithms for Random Number Generation", 2014, seeded anew
// in each invocation.
#ifndef DUOLUX_TESTS_SHADER_HARNESS_RANDOM_GLSL
#define DUOLUX_TESTS_SHADER_HARNESS_RANDOM_GLSL

uint testRandomState;

uint randomUint() {
    testRandomState = testRandomState * 747796405u + 2891336453u;
    uint word = ((testRandomState >> ((testRandomState >> 28u) + 4u)) ^ testRandomState) * 277803737u;
    return (word >> 22u) ^ word;
}

void seedRandom(uint seed, uint invocation) {
    testRandomState = seed;
    testRandomState = randomUint() ^ (invocation * 2654435769u);
    testRandomState = randomUint() + invocation;
}

float randomFloat() { return float(randomUint() >> 8u) * (1.0 / 16777216.0); }  // in [0, 1), a multiple of 2^-24
float randomFloat(float lower, float upper) { return lower + (upper - lower) * randomFloat(); }
vec2 randomVec2() {
    float x = randomFloat();
    return vec2(x, randomFloat());
}
vec3 randomVec3(float lower, float upper) {
    float x = randomFloat(lower, upper);
    float y = randomFloat(lower, upper);
    return vec3(x, y, randomFloat(lower, upper));
}
// 2^lower to 2^upper, every binade with equal frequency.
float randomScale(float lower, float upper) { return exp2(randomFloat(lower, upper)); }
vec3 randomDirection() {  // unit, uniform
    vec3 v = randomVec3(-1.0, 1.0);
    for (int i = 0; i < 32 && (dot(v, v) > 1.0 || dot(v, v) < 1e-4); i++) v = randomVec3(-1.0, 1.0);
    return normalize(v);
}

#endif

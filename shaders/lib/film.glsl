// Exact accumulation: radiance is rounded once to a multiple of a quantum and summed in 64-bit integers (low, high).
#ifndef DUOLUX_LIB_FILM_GLSL
#define DUOLUX_LIB_FILM_GLSL

#include "shaders/lib/rng.glsl"
#include "shaders/shared/path_tracer_layout.h"

// Larger radiance is treated as a numerical error.
const float kLargestSample = 1e30;

// Uniform numbers in [0, 1) for the stochastic rounding of a sample's channels.
struct FilmRounding {
    vec3 invisible;
    vec3 visible;
};

// The rounding numbers of the sample that (a, b, dimension) identifies.
FilmRounding filmRounding(uint a, uint b, uint dimension, uint seed) {
    // The inverted seed keeps these numbers independent of the sampler's, which hashes the same identifiers.
    uvec4 first = pcg4d(uvec4(a, b, dimension, ~seed));
    uvec4 second = pcg4d(first);
    return FilmRounding(vec3(uniformFloat(first.x), uniformFloat(first.y), uniformFloat(first.z)),
                        vec3(uniformFloat(second.x), uniformFloat(second.y), uniformFloat(second.z)));
}

// One radiance value >= 0 in quanta, clamped to kFilmLargest. It is rounded up with a probability equal to its
// fractional part, so that the mean over uniform `u` is the value, however small it is (stochastic rounding: Forsythe,
// "Reprint of a Note on Rounding-off Errors", SIAM Review 1(1), 1959).
uvec2 filmQuantise(float value, float inverseQuantum, float u) {
    float scaled = min(value * inverseQuantum, kFilmLargest);
    float whole = floor(scaled);
    whole += u < scaled - whole ? 1.0 : 0.0;
    float high = floor(whole * (1.0 / 4294967296.0));
    return uvec2(uint(whole - high * 4294967296.0), uint(high));
}

uvec2 filmAdd(uvec2 sum, uvec2 term) {
    uint low = sum.x + term.x;
    return uvec2(low, sum.y + term.y + (low < term.x ? 1u : 0u));
}

// The two's complement.
uvec2 filmNegate(uvec2 term) { return uvec2(~term.x + 1u, ~term.y + (term.x == 0u ? 1u : 0u)); }

// Adds a value of either sign, rounded to nearest; the sum is a two's complement number.
uvec2 filmAddSigned(uvec2 sum, float value, float inverseQuantum) {
    uvec2 term = filmQuantise(abs(value), inverseQuantum, 0.5);
    return filmAdd(sum, value < 0.0 ? filmNegate(term) : term);
}

// Three channels of one component.
struct FilmSum {
    uvec2 r;
    uvec2 g;
    uvec2 b;
};

FilmSum filmZero() { return FilmSum(uvec2(0u), uvec2(0u), uvec2(0u)); }

FilmSum filmAccumulate(FilmSum sum, vec3 radiance, float inverseQuantum, vec3 u) {
    return FilmSum(filmAdd(sum.r, filmQuantise(radiance.r, inverseQuantum, u.r)),
                   filmAdd(sum.g, filmQuantise(radiance.g, inverseQuantum, u.g)),
                   filmAdd(sum.b, filmQuantise(radiance.b, inverseQuantum, u.b)));
}

// The same for values of either sign, rounded to nearest.
FilmSum filmAccumulateSigned(FilmSum sum, vec3 value, float inverseQuantum) {
    return FilmSum(filmAddSigned(sum.r, value.x, inverseQuantum), filmAddSigned(sum.g, value.y, inverseQuantum),
                   filmAddSigned(sum.b, value.z, inverseQuantum));
}

#endif

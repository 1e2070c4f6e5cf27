// Exact accumulation: radiance rounded once to a multiple of a quantum, summed in 64-bit integers (low, high).
#ifndef DUOLUX_LIB_FILM_GLSL
#define DUOLUX_LIB_FILM_GLSL

// One sample of one channel holds less than this many quanta: 2^56.
const float kFilmLargest = 72057594037927936.0;

// Radiance beyond this is an error, not light.
const float kLargestRadiance = 1e30;

// One radiance value >= 0 in quanta, clamped to the largest.
uvec2 filmQuantise(float value, float inverseQuantum) {
    float scaled = min(value * inverseQuantum, kFilmLargest);
    // Below 2^23 there is a fraction to round; above, the float is an integer already, to which 0.5 must not be added:
    // the sum of the two would be rounded, too.
    scaled = scaled < 8388608.0 ? floor(scaled + 0.5) : scaled;
    float high = floor(scaled * (1.0 / 4294967296.0));
    return uvec2(uint(scaled - high * 4294967296.0), uint(high));
}

uvec2 filmAdd(uvec2 sum, uvec2 term) {
    uint low = sum.x + term.x;
    return uvec2(low, sum.y + term.y + (low < term.x ? 1u : 0u));
}

// The two's complement.
uvec2 filmNegate(uvec2 term) { return uvec2(~term.x + 1u, ~term.y + (term.x == 0u ? 1u : 0u)); }

// A value of either sign; the sum is a two's complement number.
uvec2 filmAddSigned(uvec2 sum, float value, float inverseQuantum) {
    uvec2 term = filmQuantise(abs(value), inverseQuantum);
    return filmAdd(sum, value < 0.0 ? filmNegate(term) : term);
}

// Three channels of one component.
struct FilmSum {
    uvec2 r;
    uvec2 g;
    uvec2 b;
};

FilmSum filmZero() { return FilmSum(uvec2(0u), uvec2(0u), uvec2(0u)); }

FilmSum filmAccumulate(FilmSum sum, vec3 radiance, float inverseQuantum) {
    return FilmSum(filmAdd(sum.r, filmQuantise(radiance.r, inverseQuantum)),
                   filmAdd(sum.g, filmQuantise(radiance.g, inverseQuantum)),
                   filmAdd(sum.b, filmQuantise(radiance.b, inverseQuantum)));
}

#endif

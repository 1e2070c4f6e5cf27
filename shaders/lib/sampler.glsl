// The random numbers of a path. Each vertex draws pairs of numbers; (pixel, sample, dimension, seed) identifies a pair.
#ifndef DUOLUX_LIB_SAMPLER_GLSL
#define DUOLUX_LIB_SAMPLER_GLSL

#include "shaders/lib/rng.glsl"
#include "shaders/lib/sobol.glsl"
#include "shaders/shared/path_layout.h"

// The purpose of a pair of numbers; vertex and purpose together are the dimension. The light tracer reuses two of the
// values: for the direction from the emitter, and for connections to the camera. In the latter dimension at the
// emitter, sampleWords chooses the point on the emitter, and sampleChoice gives the number of the connection and the
// side.
const uint kDimensionPixel = 0u;
const uint kDimensionEmission = 0u;
const uint kDimensionCamera = 1u;
const uint kDimensionLight = 1u;
const uint kDimensionDirection = 2u;
const uint kDimensionChoice = 3u;

// `scattering`: scattering events before the vertex; `crossing`: surfaces crossed since the last one.
uint sampleDimension(uint scattering, uint crossing, uint purpose) {
    return (scattering << 16u) + (crossing << 2u) + purpose;
}

// Two uniform words.
uvec2 sampleWords(uint kind, uint pixel, uint sampleIndex, uint dimension, uint seed) {
    if (kind == kSamplerSobol) {
        uvec4 key = pcg4d(uvec4(pixel, 0xffffffffu, dimension, seed));
        return sobolPair(sampleIndex, key);
    }
    return pcg4d(uvec4(pixel, sampleIndex, dimension, seed)).xy;
}

// Two numbers in [0, 1).
vec2 samplePair(uint kind, uint pixel, uint sampleIndex, uint dimension, uint seed) {
    return uniformFloat2(sampleWords(kind, pixel, sampleIndex, dimension, seed));
}

// Two numbers in [0, 1) for choices that gain nothing from stratification.
vec2 sampleChoice(uint pixel, uint sampleIndex, uint dimension, uint seed) {
    return uniformFloat2(pcg4d(uvec4(pixel, sampleIndex, dimension, seed)).zw);
}

#endif

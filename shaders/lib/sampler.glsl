// The random numbers of a path. Each vertex draws pairs of numbers; (pixel, sample, dimension, seed) identifies a pair.
#ifndef DUOLUX_LIB_SAMPLER_GLSL
#define DUOLUX_LIB_SAMPLER_GLSL

#include "shaders/lib/rng.glsl"
#include "shaders/lib/sobol.glsl"
#include "shaders/shared/path_tracer_layout.h"

// The purpose of a number or a pair of numbers. Scattering events, crossings and purpose together are the dimension,
// which has room for more purposes (a lens, the wavelength).
const uint kDimensionPixel = 0u;       // position in the pixel
const uint kDimensionEmitter = 1u;     // point on an emitter
const uint kDimensionDirection = 2u;   // scattered direction
const uint kDimensionRoulette = 3u;    // whether a path continues
const uint kDimensionCrossing = 4u;    // from which of the surfaces along a segment it continues
const uint kDimensionLobe = 5u;        // lobe of the BSDF
const uint kDimensionEmission = 6u;    // direction from the emitter
const uint kDimensionSide = 7u;        // side of the emitter
const uint kDimensionConnection = 8u;  // whether a light path is connected to the camera
const uint kDimensionRounding = 9u;    // of radiance to quanta of the film

// `scattering`: scattering events before the vertex, fewer than 65536; `crossing`: surfaces crossed since the last one,
// fewer than 4096.
uint sampleDimension(uint scattering, uint crossing, uint purpose) {
    return (scattering << 16u) + (crossing << 4u) + purpose;
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

// A number in [0, 1) for a choice that gains nothing from stratification.
float sampleChoice(uint pixel, uint sampleIndex, uint dimension, uint seed) {
    return uniformFloat(pcg4d(uvec4(pixel, sampleIndex, dimension, seed)).z);
}

#endif

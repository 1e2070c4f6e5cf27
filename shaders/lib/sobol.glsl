// Owen-scrambled Sobol points: Burley, "Practical Hash-based Owen Scrambling", JCGT 9(4), 2020. Each pair of
// dimensions is the (0,2)-sequence of the first two Sobol dimensions, shuffled and scrambled by hashes of its own.
// The scrambling hash is Vegdahl's refinement of Laine and Karras, "Stratified Sampling for Stochastic
// Transparency", EGSR 2011.
#ifndef DUOLUX_LIB_SOBOL_GLSL
#define DUOLUX_LIB_SOBOL_GLSL

#include "shaders/lib/rng.glsl"

// Owen scrambling of a number with reversed bits: a hash of the lower bits and the seed flips each bit.
uint owenScrambleReversed(uint x, uint seed) {
    x ^= x * 0x3d20adeau;
    x += seed;
    x *= (seed >> 16u) | 1u;
    x ^= x * 0x05526c56u;
    x ^= x * 0x53a22864u;
    return x;
}

// Second Sobol dimension of an index, as the reversed bits of the fraction: multiplication by the Pascal matrix modulo
// 2.
uint sobolSecondReversed(uint index) {
    index ^= (index & 0xaaaaaaaau) >> 1u;
    index ^= (index & 0xccccccccu) >> 2u;
    index ^= (index & 0xf0f0f0f0u) >> 4u;
    index ^= (index & 0xff00ff00u) >> 8u;
    index ^= index >> 16u;
    return index;
}

// Point `index` of the pair of dimensions that `key` identifies.
uvec2 sobolPair(uint index, uvec4 key) {
    uint shuffled = bitfieldReverse(owenScrambleReversed(bitfieldReverse(index), key.x));
    // The fraction of the first dimension is the reversed index, so its reversed bits are the index itself.
    uint first = owenScrambleReversed(shuffled, key.y);
    uint second = owenScrambleReversed(sobolSecondReversed(shuffled), key.z);
    return uvec2(bitfieldReverse(first), bitfieldReverse(second));
}

#endif

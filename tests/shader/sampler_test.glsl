// The samples of a path.
#include "shaders/lib/sampler.glsl"

// Vertices with fewer than 65536 scattering events and 4096 crossings, and 16 purposes, have distinct dimensions,
// because all three numbers can be recovered from the dimension.
void expectDimension(uint scattering, uint crossing, uint purpose) {
    uint dimension = sampleDimension(scattering, crossing, purpose);
    EXPECT_EQ(uvec3(dimension >> 16u, (dimension >> 4u) & 0xfffu, dimension & 15u),
              uvec3(scattering, crossing, purpose));
}

TEST(DimensionsDoNotCollide) {
    expectDimension(randomUint() >> 16u, randomUint() >> 20u, randomUint() >> 28u);
}

TEST_N(DimensionsDoNotCollideAtTheLimits, 8) {
    uint i = testIndex();
    expectDimension((i & 1u) * 65535u, ((i >> 1u) & 1u) * 4095u, (i >> 2u) * 15u);
}

TEST_N(PurposesDiffer, 1) {
    uint purposes = (1u << kDimensionPixel) | (1u << kDimensionEmitter) | (1u << kDimensionDirection) |
                    (1u << kDimensionRoulette) | (1u << kDimensionCrossing) | (1u << kDimensionLobe) |
                    (1u << kDimensionEmission) | (1u << kDimensionSide) | (1u << kDimensionConnection);
    EXPECT_EQ(purposes, 511u);
}

TEST(WordsAreThoseOfTheKind) {
    uvec4 name = uvec4(randomUint(), randomUint(), randomUint(), randomUint());  // pixel, sample, dimension, seed
    uvec2 sobol = sampleWords(kSamplerSobol, name.x, name.y, name.z, name.w);
    EXPECT_EQ(sobol, sobolPair(name.y, pcg4d(uvec4(name.x, 0xffffffffu, name.zw))));
    EXPECT_EQ(sampleWords(kSamplerIndependent, name.x, name.y, name.z, name.w), pcg4d(name).xy);
    EXPECT_NE(sobol, pcg4d(name).xy);
}

TEST(PairsAreTheWordsAsFloats) {
    uvec4 name = uvec4(randomUint(), randomUint(), randomUint(), randomUint());
    for (uint kind = 0u; kind < 2u; kind++) {
        vec2 pair = samplePair(kind, name.x, name.y, name.z, name.w);
        uvec2 words = sampleWords(kind, name.x, name.y, name.z, name.w);
        EXPECT_EQ(pair, vec2(words >> 8u) * (1.0 / 16777216.0));
    }
}

TEST(ChoiceIsAWordThatPairsLeave) {
    uvec4 name = uvec4(randomUint(), randomUint(), randomUint(), randomUint());
    uvec4 words = pcg4d(name);
    EXPECT_EQ(sampleChoice(name.x, name.y, name.z, name.w), float(words.z >> 8u) * (1.0 / 16777216.0));
}

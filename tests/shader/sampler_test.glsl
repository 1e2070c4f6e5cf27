// The samples of a path.
#include "shaders/lib/sampler.glsl"

// Vertices with fewer than 65536 scattering events and 16384 crossings, and four purposes, have distinct dimensions,
// because all three numbers can be recovered from the dimension.
void expectDimension(uint scattering, uint crossing, uint purpose) {
    uint dimension = sampleDimension(scattering, crossing, purpose);
    EXPECT_EQ(uvec3(dimension >> 16u, (dimension >> 2u) & 0x3fffu, dimension & 3u),
              uvec3(scattering, crossing, purpose));
}

TEST(DimensionsDoNotCollide) {
    expectDimension(randomUint() >> 16u, randomUint() >> 18u, randomUint() >> 30u);
}

TEST_N(DimensionsDoNotCollideAtTheLimits, 8) {
    uint i = testIndex();
    expectDimension((i & 1u) * 65535u, ((i >> 1u) & 1u) * 16383u, (i >> 2u) * 3u);
}

// Of the uses that one path makes of its vertices: a path from the camera, and one from a light.
TEST_N(PurposesDiffer, 1) {
    uint camera = (1u << kDimensionPixel) | (1u << kDimensionLight) | (1u << kDimensionDirection) |
                  (1u << kDimensionChoice);
    EXPECT_EQ(camera, 15u);
    uint light = (1u << kDimensionEmission) | (1u << kDimensionCamera) | (1u << kDimensionDirection) |
                 (1u << kDimensionChoice);
    EXPECT_EQ(light, 15u);
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

TEST(ChoicesAreTheWordsThatPairsLeave) {
    uvec4 name = uvec4(randomUint(), randomUint(), randomUint(), randomUint());
    uvec4 words = pcg4d(name);
    EXPECT_EQ(sampleChoice(name.x, name.y, name.z, name.w), vec2(words.zw >> 8u) * (1.0 / 16777216.0));
}

// Sums of the film are exact: they do not depend on the order or grouping of samples.
#include "shaders/lib/film.glsl"

vec3 randomRadiance() { return vec3(randomScale(-40.0, 40.0), randomScale(-20.0, 20.0), randomFloat(0.0, 4.0)); }

const int kSamples = 64;

TEST_N(SumsDoNotDependOnTheOrder, 512) {
    vec3 samples[kSamples];
    vec3 u = randomVec3(0.0, 1.0);
    for (int i = 0; i < kSamples; i++) samples[i] = randomRadiance();
    FilmSum forward = filmZero();
    FilmSum backward = filmZero();
    FilmSum first = filmZero();
    FilmSum second = filmZero();
    for (int i = 0; i < kSamples; i++) {
        forward = filmAccumulate(forward, samples[i], 1048576.0, u);
        backward = filmAccumulate(backward, samples[kSamples - 1 - i], 1048576.0, u);
        if (i < 20) {
            first = filmAccumulate(first, samples[i], 1048576.0, u);
        } else {
            second = filmAccumulate(second, samples[i], 1048576.0, u);
        }
    }
    EXPECT_EQ(uvec4(backward.r, backward.g), uvec4(forward.r, forward.g));
    EXPECT_EQ(backward.b, forward.b);
    EXPECT_EQ(uvec4(filmAdd(first.r, second.r), filmAdd(first.g, second.g)), uvec4(forward.r, forward.g));
    EXPECT_EQ(filmAdd(first.b, second.b), forward.b);
}

TEST(AdditionIsCommutativeAndAssociative) {
    uvec2 a = uvec2(randomUint(), randomUint());
    uvec2 b = uvec2(randomUint(), randomUint());
    uvec2 c = uvec2(randomUint(), randomUint());
    EXPECT_EQ(filmAdd(a, b), filmAdd(b, a));
    EXPECT_EQ(filmAdd(filmAdd(a, b), c), filmAdd(a, filmAdd(b, c)));
}

TEST(NegativeIsWhatMakesNothing) {
    uvec2 a = uvec2(testIndex() % 3u == 0u ? 0u : randomUint(), testIndex() % 5u == 0u ? 0u : randomUint());
    EXPECT_EQ(filmAdd(a, filmNegate(a)), uvec2(0u));
    EXPECT_EQ(filmNegate(filmNegate(a)), a);
}

// The result is one of the two adjacent multiples; an integer is unchanged.
TEST(QuantisingRoundsToAMultipleBeside) {
    float radiance = randomFloat(0.0, 16777216.0) * randomScale(-24.0, 0.0);
    uvec2 quanta = filmQuantise(radiance, 1.0, randomFloat());
    EXPECT_EQ(quanta.y, 0u);
    EXPECT_LT(abs(radiance - float(int(quanta.x))), 1.0);
    EXPECT_EQ(filmQuantise(floor(radiance), 1.0, randomFloat()).x, uint(int(floor(radiance))));
}

TEST(ChannelsAreSummedApart) {
    vec3 radiance = floor(randomVec3(0.0, 1000.0));
    FilmSum before = FilmSum(uvec2(5u, 1u), uvec2(6u, 2u), uvec2(7u, 3u));
    FilmSum after = filmAccumulate(before, radiance, 2.0, randomVec3(0.0, 1.0));
    EXPECT_EQ(uvec3(after.r.x, after.g.x, after.b.x), uvec3(5u, 6u, 7u) + 2u * uvec3(radiance));
    EXPECT_EQ(uvec3(after.r.y, after.g.y, after.b.y), uvec3(1u, 2u, 3u));
}

TEST_N(ZeroIsEmpty, 1) {
    FilmSum zero = filmZero();
    EXPECT_EQ(uvec4(zero.r, zero.g), uvec4(0u));
    EXPECT_EQ(zero.b, uvec2(0u));
}

// The radiance that a sample gathers, and the sums of a lane over samples.
#include "shaders/lib/pixel_sums.glsl"

vec3 randomIntegers() { return floor(randomVec3(0.0, 16.0)); }

// All light goes into the sum. For the last bounce allowed and the one before it, the mean of the displayed
// channels is also summed separately. Multiples of 3 make that mean exact.
TEST(GatheringSumsTheLastBouncesApart) {
    uint bounces = randomUint() % 4u;
    uint scatterings = randomUint() % (bounces + 1u);
    vec2 display = floor(4.0 * randomVec2());
    Radiance2 light = Radiance2(3.0 * randomIntegers(), 3.0 * randomIntegers());
    Radiance2 before = Radiance2(randomIntegers(), randomIntegers());
    SampleRadiance g = SampleRadiance(before, 100.0, 200.0);
    addRadiance(g, light, scatterings, bounces, display);
    float mean = dot(vec3(1.0), display.x * light.invisible + display.y * light.visible) / 3.0;
    EXPECT_EQ(g.radiance.invisible, before.invisible + light.invisible);
    EXPECT_EQ(g.radiance.visible, before.visible + light.visible);
    EXPECT_NEAR(g.lastBounce, 100.0 + (scatterings == bounces ? mean : 0.0), 1e-4);
    EXPECT_NEAR(g.previousBounce, 200.0 + (int(scatterings) == int(bounces) - 1 ? mean : 0.0), 1e-4);
}

TEST_N(NothingIsGatheredAtFirst, 1) {
    SampleRadiance g = noRadiance();
    EXPECT_EQ(g.radiance.invisible + g.radiance.visible, vec3(0.0));
    EXPECT_EQ(vec2(g.lastBounce, g.previousBounce), vec2(0.0));
}

// Sums with a value in every field, to test that a sample changes only its own.
FilmRounding someRounding() { return FilmRounding(randomVec3(0.0, 1.0), randomVec3(0.0, 1.0)); }

PixelSums someSums() {
    return PixelSums(FilmSum(uvec2(1u, 0u), uvec2(2u, 0u), uvec2(3u, 0u)), FilmSum(uvec2(4u, 0u), uvec2(5u, 0u),
                    uvec2(6u, 0u)), 7u, 8u, 9u, 10u, 11u, 12u, 13.0, 14.0);
}

void expectRays(PixelSums sums) {
    EXPECT_EQ(uvec4(sums.cameraRays, sums.bounceRays, sums.shadowRays, sums.emitterRays), uvec4(9u, 10u, 11u, 12u));
}

TEST(SampleIsAddedToItsSums) {
    Radiance2 light = Radiance2(randomIntegers(), randomIntegers());
    PixelSums sums = someSums();
    addSample(sums, SampleRadiance(light, 0.5, 0.25), 4.0, someRounding());
    uvec3 invisible = uvec3(1u, 2u, 3u) + 4u * uvec3(light.invisible);
    uvec3 visible = uvec3(4u, 5u, 6u) + 4u * uvec3(light.visible);
    EXPECT_EQ(uvec3(sums.invisible.r.x, sums.invisible.g.x, sums.invisible.b.x), invisible);
    EXPECT_EQ(uvec3(sums.visible.r.x, sums.visible.g.x, sums.visible.b.x), visible);
    EXPECT_EQ(vec2(sums.lastBounce, sums.previousBounce), vec2(13.5, 14.25));
    EXPECT_EQ(uvec2(sums.nonFinite, sums.clamped), uvec2(7u, 8u));
    expectRays(sums);
}

// The wrong value is in one channel of one component: the sample is dropped and counted, and nothing else
// changes.
TEST_N(SampleThatIsNotANumberIsDropped, 24) {
    float wrong[4] = float[4](uintBitsToFloat(0x7fc00000u), uintBitsToFloat(0x7f800000u), 2e30, 1.01e30);
    uint channel = testIndex() % 3u;
    Radiance2 light = Radiance2(vec3(1.0), vec3(1.0));
    if (testIndex() / 3u % 2u == 0u) light.invisible[channel] = wrong[testIndex() / 6u];
    else light.visible[channel] = wrong[testIndex() / 6u];
    PixelSums sums = someSums();
    addSample(sums, SampleRadiance(light, 0.5, 0.25), 4.0, someRounding());
    EXPECT_EQ(uvec3(sums.invisible.r.x, sums.invisible.g.x, sums.invisible.b.x), uvec3(1u, 2u, 3u));
    EXPECT_EQ(uvec3(sums.visible.r.x, sums.visible.g.x, sums.visible.b.x), uvec3(4u, 5u, 6u));
    EXPECT_EQ(vec2(sums.lastBounce, sums.previousBounce), vec2(13.0, 14.0));
    EXPECT_EQ(uvec2(sums.nonFinite, sums.clamped), uvec2(8u, 8u));
    expectRays(sums);
}

// Just below the error limit: kept. If all six channels together reach 2^58 quanta, they are clamped and
// counted.
TEST_N(BrightSamplesAreClampedAndCounted, 1) {
    PixelSums sums = someSums();
    addSample(sums, SampleRadiance(Radiance2(vec3(0.9e30, 0.0, 1.0), vec3(1.0)), 0.0, 0.0), 1.0, someRounding());
    EXPECT_EQ(uvec2(sums.nonFinite, sums.clamped), uvec2(7u, 9u));
    EXPECT_EQ(uvec4(sums.invisible.r, sums.invisible.b), uvec4(1u, 1u << 26u, 4u, 0u));
    addSample(sums, SampleRadiance(Radiance2(vec3(kFilmLargest, 0.0, 0.0), vec3(0.0)), 0.0, 0.0), 1.0, someRounding());
    EXPECT_EQ(sums.clamped, 10u);
    Radiance2 radiance = Radiance2(vec3(0.99 * kFilmLargest, 0.0, 0.0), vec3(0.0));
    addSample(sums, SampleRadiance(radiance, 0.0, 0.0), 1.0, someRounding());
    EXPECT_EQ(sums.clamped, 10u);
    radiance = Radiance2(vec3(0.0), vec3(0.0, 0.0, 0.01 * kFilmLargest));
    addSample(sums, SampleRadiance(radiance, 0.0, 0.0), 100.0, someRounding());
    EXPECT_EQ(uvec2(sums.nonFinite, sums.clamped), uvec2(7u, 11u));
}

TEST_N(SumsAreEmptyAtFirst, 1) {
    PixelResult result = pixelResult(emptyPixelSums());
    uint all = 0u;
    for (int i = 0; i < 6; i++) all |= result.invisible[i] | result.visible[i];
    all |= result.nonFinite | result.clamped | result.cameraRays | result.bounceRays | result.shadowRays;
    EXPECT_EQ(all | result.emitterRays, 0u);
    EXPECT_EQ(vec2(result.lastBounce, result.previousBounce), vec2(0.0));
}

// Every field has a different value.
TEST_N(ResultHasEveryField, 1) {
    PixelSums sums = PixelSums(FilmSum(uvec2(1u, 2u), uvec2(3u, 4u), uvec2(5u, 6u)), FilmSum(uvec2(7u, 8u),
                             uvec2(9u, 10u), uvec2(11u, 12u)), 13u, 14u, 15u, 16u, 17u, 18u, 19.0, 20.0);
    PixelResult result = pixelResult(sums);
    uint wrong = 0u;
    for (uint i = 0u; i < 6u; i++) {
        wrong |= result.invisible[i] ^ (i + 1u);
        wrong |= result.visible[i] ^ (i + 7u);
    }
    EXPECT_EQ(wrong, 0u);
    EXPECT_EQ(uvec3(result.nonFinite, result.clamped, result.cameraRays), uvec3(13u, 14u, 15u));
    EXPECT_EQ(uvec3(result.bounceRays, result.shadowRays, result.emitterRays), uvec3(16u, 17u, 18u));
    EXPECT_EQ(vec2(result.lastBounce, result.previousBounce), vec2(19.0, 20.0));
}

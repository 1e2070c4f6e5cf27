// Emission by side, densities, and what each kind of emitter returns.
#include "shaders/lib/emitter.glsl"

uvec4 emitterTexels[18];
uvec4 fetchEmitterTexel(uint index) { return emitterTexels[min(index, 17u)]; }
uvec4 fetchPlaneTexel(uint index) { return uvec4(0u); }
uvec4 fetchPairTexel(uint index) { return uvec4(0u); }
uvec4 fetchNormalTexel(uint index) { return uvec4(0u); }
uvec4 fetchCornerTexel(uint index) { return uvec4(0u); }
uvec4 fetchVertexTexel(uint index) { return uvec4(0u); }
uvec4 fetchSecondUvTexel(uint index) { return uvec4(0u); }
vec3 emissionTexel(uint triangle, vec2 barycentric) { return vec3(1.0); }

// From 0.5 to 2, or of any magnitude that densities have.
float randomDensity() { return testIndex() % 2u == 0u ? randomFloat(0.5, 2.0) : randomScale(-60.0, 60.0); }

// Veach 1997, eq. 9.8 with n_i = 1.
TEST(BalanceHeuristicIsAPartitionOfUnity) {
    float a = randomDensity();
    float b = randomDensity();
    EXPECT_NEAR(balanceHeuristic(a, b) + balanceHeuristic(b, a), 1.0, 1.2e-7);
    EXPECT_NEAR(balanceHeuristic(a, b) * b, balanceHeuristic(b, a) * a, 4e-7 * max(a, b));
}

TEST_N(BalanceHeuristicAtItsLimits, 1) {
    float infinity = uintBitsToFloat(0x7f800000u);
    EXPECT_EQ(vec4(balanceHeuristic(1.0, 1.0), balanceHeuristic(3.0, 1.0), balanceHeuristic(1.0, 3.0),
                   balanceHeuristic(7.0, 0.0)), vec4(0.5, 0.75, 0.25, 1.0));
    // A strategy with zero density has no weight, even if both densities are zero.
    EXPECT_EQ(vec3(balanceHeuristic(0.0, 2.0), balanceHeuristic(0.0, 0.0), balanceHeuristic(0.0, infinity)), vec3(0.0));
    // A direction for which the other strategy has an infinite or very large density.
    EXPECT_EQ(vec3(balanceHeuristic(1.0, infinity), balanceHeuristic(1e30, 1.0), balanceHeuristic(1e-30, 1e30)),
              vec3(0.0, 1.0, 0.0));
}

// dA cos = d^2 dw: at twice the distance the density per steradian is four times as large; at an oblique angle it is
// larger, on either side.
TEST(DensityPerSteradianGoesBySquareOfDistanceAndCosine) {
    float density = randomScale(-10.0, 10.0);
    float squared = randomScale(-10.0, 10.0);
    float cosine = randomFloat(0.01, 1.0);
    float perSteradian = pdfAreaToSolidAngle(density, squared, cosine);
    EXPECT_ULP(perSteradian * cosine / squared, density, 4.0);
    EXPECT_EQ(pdfAreaToSolidAngle(density, squared, -cosine), perSteradian);
    EXPECT_EQ(pdfAreaToSolidAngle(2.0 * density, 4.0 * squared, 0.5 * cosine), 16.0 * perSteradian);
}

TEST_N(DensityIsFiniteAlongTheEmitter, 1) {
    EXPECT_EQ(pdfAreaToSolidAngle(1.0, 1.0, 0.0), pdfAreaToSolidAngle(1.0, 1.0, 1e-12));
    EXPECT_ULP(pdfAreaToSolidAngle(1.0, 1.0, 0.0), 1e12, 1.0);
    EXPECT_ULP(pdfAreaToSolidAngle(1.0, 1.0, 2e-12), 0.5e12, 1.0);
}

// For a single emitter of area A, every light path carries pi E A for each side.
TEST(FluxOfOneEmitterIsItsPower) {
    float area = randomScale(-20.0, 20.0);
    EXPECT_ULP(emittedFlux(1.0 / area, 1.0), 3.14159265358979 * area, 8.0);
    EXPECT_EQ(emittedFlux(1.0 / area, 2.0), 2.0 * emittedFlux(1.0 / area, 1.0));
}

Emitter triangleEmitter(uint flags) {
    vec3 a = randomVec3(-1.0, 1.0);
    vec3 b = randomVec3(-1.0, 1.0);
    Radiance2 emission = Radiance2(vec3(1.0, 2.0, 3.0), vec3(4.0, 5.0, 6.0));
    return Emitter(a, b, randomVec3(-1.0, 1.0), flags, 1e-6, 0u, emission, 7.0);
}

// All four combinations of sides.
TEST_N(EmissionIsThatOfTheSideWhoseFlagIsSet, 4) {
    uint flags = testIndex();
    Radiance2 toFront = emissionOn(triangleEmitter(flags), true);
    Radiance2 toBack = emissionOn(triangleEmitter(flags), false);
    EXPECT_EQ(toFront.invisible, (flags & kEmitterFront) != 0u ? vec3(1.0, 2.0, 3.0) : vec3(0.0));
    EXPECT_EQ(toFront.visible, (flags & kEmitterFront) != 0u ? vec3(4.0, 5.0, 6.0) : vec3(0.0));
    EXPECT_EQ(toBack.invisible, (flags & kEmitterBack) != 0u ? vec3(1.0, 2.0, 3.0) : vec3(0.0));
    EXPECT_EQ(toBack.visible, (flags & kEmitterBack) != 0u ? vec3(4.0, 5.0, 6.0) : vec3(0.0));
}

// Direction, distance, side and density of a sample belong to one point of the emitter.
TEST(SampleIsAPointOfTheEmitter) {
    Emitter emitter = triangleEmitter(kEmitterFront);
    vec3 receiver = randomVec3(-2.0, 2.0);
    vec2 u = randomVec2();
    EmitterSample s = sampleTriangleEmitter(emitter, 5u, receiver, u);
    EmitterPoint on = pointOnTriangleEmitter(emitter, u);
    bool front = dot(on.normal, receiver - on.position) > 0.0;
    EXPECT_NEAR(receiver + s.wi * s.distance, on.position, 4e-6);
    EXPECT_NEAR(length(s.wi), 1.0, 3e-7);
    EXPECT_EQ(s.emission.invisible, emissionOn(emitter, front).invisible);
    EXPECT_NEAR(s.pdf, emitterPdf(emitter, s.distance * s.distance, dot(on.normal, s.wi)), 1e-5 * s.pdf);
    EXPECT_EQ(s.emitter, 5u);
    EXPECT_EQ(s.coincident, kNoTriangle);
}

// The light path leaves on the side that `side` chooses. Its flux is that of all emitting sides.
TEST(EmittedRayLeavesOnItsSide) {
    bool both = (randomUint() & 1u) == 0u;
    Emitter emitter = triangleEmitter(both ? kEmitterFront | kEmitterBack : kEmitterFront);
    EmitterPoint on = pointOnTriangleEmitter(emitter, randomVec2());
    float side = randomFloat(0.0, 1.0);
    EmittedRay ray = emitFromTriangle(emitter, on, side, randomVec2());
    bool front = !both || side < 0.5;
    EXPECT_EQ(ray.point.geometricNormal, front ? on.normal : -on.normal);
    EXPECT_EQ(ray.point.shadingNormal, ray.point.geometricNormal);
    EXPECT_GT(dot(ray.direction, ray.point.geometricNormal), 0.0);
    EXPECT_GT(dot(ray.point.position - on.position, ray.point.geometricNormal), 0.0);
    EXPECT_NEAR(ray.flux.visible, vec3(4.0, 5.0, 6.0) * (3.14159265 * (both ? 2.0 : 1.0) / 7.0), 2e-6);
}

// The camera sees the side that faces it, whichever side the light path leaves from.
TEST(CameraSeesTheSideThatFacesIt) {
    Emitter emitter = triangleEmitter(randomUint() & 3u);
    EmitterPoint on = pointOnTriangleEmitter(emitter, randomVec2());
    vec3 toCamera = randomDirection();
    EmitterSeen seen = seeTriangleEmitter(emitter, on, toCamera);
    EXPECT_GT(dot(seen.point.geometricNormal, toCamera), 0.0);
    EXPECT_NEAR(seen.intensity.invisible, emissionOn(emitter, dot(on.normal, toCamera) > 0.0).invisible / 7.0, 1e-6);
}

Emitter pointEmitter() {
    return Emitter(randomVec3(-1.0, 1.0), vec3(0.0), vec3(0.0), kEmitterKindPoint, 0.0, 0u,
                   Radiance2(vec3(1.0, 2.0, 3.0), vec3(4.0, 5.0, 6.0)), 0.25);
}

// Inverse square of the distance, from a single direction.
TEST(PointEmitterLightsByInverseSquare) {
    Emitter emitter = pointEmitter();
    vec3 receiver = randomVec3(-2.0, 2.0);
    vec3 normal = randomDirection();
    EmitterSample s = samplePointEmitter(emitter, 3u, receiver);
    float squared = dot(emitter.v0 - receiver, emitter.v0 - receiver);
    EXPECT_NEAR(receiver + s.wi * s.distance, emitter.v0, 1e-6);
    EXPECT_NEAR(s.emission.visible * squared, vec3(4.0, 5.0, 6.0), 4e-6);
    EXPECT_TRUE(s.delta);
    EXPECT_EQ(s.pdf, 0.25);
    EXPECT_EQ(s.emitter, 3u);
    Radiance2 whole = irradianceFromPoint(emitter, receiver, normal);
    vec3 expected = s.emission.invisible * max(dot(normal, s.wi), 0.0);
    EXPECT_NEAR(whole.invisible, expected, 1e-5 * maxComponent(s.emission.invisible));
}

// A light path carries 4 pi times the intensity over the probability of choosing the emitter, and starts at the point.
TEST(PointEmitterSendsItsPower) {
    Emitter emitter = pointEmitter();
    EmittedRay ray = emitFromPoint(emitter, randomVec2());
    EXPECT_NEAR(length(ray.direction), 1.0, 3e-7);
    EXPECT_NEAR(ray.flux.invisible, vec3(1.0, 2.0, 3.0) * (4.0 * 3.14159265 / 0.25), 1e-4);
    EXPECT_EQ(leaveSurface(ray.point, ray.direction, false).origin, emitter.v0);
    EmitterSeen seen = seeEmitter(emitter, pointOnEmitter(emitter, randomVec2()), randomDirection());
    EXPECT_EQ(seen.intensity.visible, vec3(0.0));
}

void store(uint index, Emitter emitter) {
    uint texel = index * kEmitterTexels;
    emitterTexels[texel] = uvec4(floatBitsToUint(emitter.v0), 0u);
    emitterTexels[texel + 1u] = uvec4(floatBitsToUint(emitter.v1), floatBitsToUint(emitter.positionError));
    emitterTexels[texel + 2u] = uvec4(floatBitsToUint(emitter.v2), emitter.triangle);
    emitterTexels[texel + 3u] = uvec4(floatBitsToUint(emitter.emission.invisible), floatBitsToUint(emitter.density));
    emitterTexels[texel + 4u] = uvec4(floatBitsToUint(emitter.emission.visible), emitter.flags);
    emitterTexels[texel + kEmitterAliasTexel] = uvec4(floatBitsToUint(1.0), index, 0u, 0u);
}

// Triangles with ranks beyond the emitting ones emit nothing, whichever record is read for them.
TEST(OnlyEmittingTrianglesHaveAnEmitter) {
    for (uint rank = 0u; rank < 3u; rank++) {
        Emitter triangle = triangleEmitter(kEmitterFront | kEmitterBack);
        triangle.emission.visible = vec3(float(rank) + 1.0);
        store(rank, triangle);
    }
    for (uint rank = 0u; rank < 4u; rank++) {
        Emitter emitter = emitterOfTriangle(rank, 2u);
        EXPECT_EQ(emissionOn(emitter, true).visible, vec3(rank < 2u ? float(rank) + 1.0 : 0.0));
        EXPECT_EQ(emissionOn(emitter, false).visible, vec3(rank < 2u ? float(rank) + 1.0 : 0.0));
    }
}

// A triangle and a point: the chosen emitter is sampled by its kind, and the closed form adds up both.
TEST(EachKindIsServedByItsOwnFunctions) {
    Emitter triangle = triangleEmitter(kEmitterFront | kEmitterBack);
    Emitter point = pointEmitter();
    store(0u, triangle);
    store(1u, point);
    vec3 receiver = randomVec3(2.0, 3.0);
    vec3 normal = randomDirection();
    uvec2 words = uvec2(randomUint() >> 1u, randomUint());
    EmitterChoice choice = chooseEmitter(2u, words);
    EXPECT_EQ(choice.index, 0u);
    EXPECT_EQ(sampleEmitter(2u, receiver, words).wi, sampleTriangleEmitter(triangle, 0u, receiver, choice.u).wi);
    EXPECT_FALSE(sampleEmitter(2u, receiver, words).delta);
    words.x |= 0x80000000u;
    EXPECT_EQ(chooseEmitter(2u, words).index, 1u);
    EXPECT_EQ(sampleEmitter(2u, receiver, words).wi, samplePointEmitter(point, 1u, receiver).wi);
    EXPECT_TRUE(sampleEmitter(2u, receiver, words).delta);
    vec3 sum = irradianceFromTriangle(triangle, receiver, normal).visible +
               irradianceFromPoint(point, receiver, normal).visible;
    EXPECT_NEAR(irradianceFromEmitters(2u, receiver, normal).visible, sum, 1e-6);
    vec2 u = randomVec2();
    EmitterPoint on = pointOnEmitter(triangle, u);
    EXPECT_EQ(emitRay(triangle, on, 0.25, u).direction, emitFromTriangle(triangle, on, 0.25, u).direction);
    EXPECT_EQ(emitRay(point, pointOnEmitter(point, u), 0.25, u).direction, uniformSphere(u));
    EXPECT_EQ(seeEmitter(triangle, on, normal).intensity.visible,
              seeTriangleEmitter(triangle, on, normal).intensity.visible);
}

// The lowest of some bits.
uint lowest(uint bits) { return bits & (~bits + 1u); }

// A kind without a branch in a dispatch gets the results of another kind for the same record. (A kind that rightly
// shares a function with another needs an exception here.)
TEST(EveryDispatchTellsTheKindsApart) {
    Emitter a = triangleEmitter(kEmitterFront | kEmitterBack);
    vec3 receiver = randomVec3(2.0, 3.0);
    vec3 normal = normalize(a.v0 - receiver);
    uvec2 words = uvec2(randomUint(), randomUint());
    vec2 u = randomVec2();
    uint sides = a.flags;
    for (uint kinds = kAllEmitterKinds; kinds != 0u; kinds &= kinds - 1u) {
        a.flags = sides | lowest(kinds);
        store(0u, a);
        EmitterSample sampled = sampleEmitter(1u, receiver, words);
        Radiance2 light = irradianceFromEmitters(1u, receiver, normal);
        EmitterPoint on = pointOnEmitter(a, u);
        for (uint others = kinds & (kinds - 1u); others != 0u; others &= others - 1u) {
            Emitter b = a;
            b.flags = sides | lowest(others);
            store(0u, b);
            EXPECT_NE(sampleEmitter(1u, receiver, words).wi, sampled.wi);
            if (((a.flags | b.flags) & kAllEmitterKinds & ~kEmitterKindsWithClosedForm) == 0u) {
                EXPECT_NE(irradianceFromEmitters(1u, receiver, normal).visible, light.visible);
            }
            EXPECT_NE(pointOnEmitter(b, u).position, on.position);
            EXPECT_NE(emitRay(b, on, 0.25, u).direction, emitRay(a, on, 0.25, u).direction);
            EXPECT_NE(seeEmitter(b, on, normal).intensity.visible, seeEmitter(a, on, normal).intensity.visible);
        }
    }
}

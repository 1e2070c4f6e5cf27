// Densities of next-event estimation.
#include "shaders/lib/lights.glsl"

uvec4 fetchLightTexel(uint index) { return uvec4(index); }
uvec4 fetchPlaneTexel(uint index) { return uvec4(0u); }

// 0.5 to 2, and of all magnitudes that densities have.
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

// For a single emitter of area A, every particle carries pi E A for each side.
TEST(FluxOfOneEmitterIsItsPower) {
    float area = randomScale(-20.0, 20.0);
    EXPECT_ULP(emittedFlux(1.0 / area, 1.0), 3.14159265358979 * area, 8.0);
    EXPECT_EQ(emittedFlux(1.0 / area, 2.0), 2.0 * emittedFlux(1.0 / area, 1.0));
}

// Mappings from the unit square, and frames. Sines and cosines may have errors of 2^-21, as on GPUs.
#include "shaders/lib/warp.glsl"
#include "tests/shader/frame_inputs.glsl"

TEST(CosineHemisphereIsUnit) {
    vec3 w = cosineHemisphere(randomVec2());
    EXPECT_NEAR(length(w), 1.0, 1e-6);
    EXPECT_GE(w.z, 0.0);
}

// Malley's method: the projection to the plane is uniform on the disk, radius^2 = u.x; the angle is u.y turns.
TEST(CosineHemisphereProjectsToTheDisk) {
    vec2 u = randomVec2();
    vec3 w = cosineHemisphere(u);
    EXPECT_NEAR(dot(w.xy, w.xy), u.x, 1.5e-6);
    float turns = atan(w.y, w.x) / (2.0 * 3.14159265);
    float off = turns - u.y;
    EXPECT_NEAR((off - round(off)) * length(w.xy), 0.0, 2e-6);
}

// Axes at quarter turns; the largest value below 1 is still above the plane.
TEST_N(CosineHemisphereKnownAnswers, 1) {
    float last = 1.0 - 1.0 / 16777216.0;
    EXPECT_EQ(cosineHemisphere(vec2(0.0, 0.3)), vec3(0.0, 0.0, 1.0));
    EXPECT_NEAR(cosineHemisphere(vec2(last, 0.0)), vec3(1.0, 0.0, 1.0 / 4096.0), 2e-6);
    EXPECT_GT(cosineHemisphere(vec2(last, 0.0)).z, 0.0);
    EXPECT_NEAR(cosineHemisphere(vec2(0.36, 0.0)), vec3(0.6, 0.0, 0.8), 2e-6);
    EXPECT_NEAR(cosineHemisphere(vec2(0.36, 0.25)), vec3(0.0, 0.6, 0.8), 2e-6);
    EXPECT_NEAR(cosineHemisphere(vec2(0.36, 0.5)), vec3(-0.6, 0.0, 0.8), 2e-6);
    EXPECT_NEAR(cosineHemisphere(vec2(0.36, 0.75)), vec3(0.0, -0.6, 0.8), 2e-6);
    EXPECT_NEAR(cosineHemisphere(vec2(0.5, 0.125)), vec3(0.5, 0.5, sqrt(0.5)), 2e-6);
}

TEST(UniformTriangleIsInTheTriangle) {
    vec2 b = uniformTriangle(randomVec2());
    EXPECT_GE(b, vec2(0.0));
    EXPECT_LE(b.x + b.y, 1.0);
}

// The square's corners map to those of the triangle, and (1, 1) to the middle of the long edge.
TEST_N(UniformTriangleKnownAnswers, 1) {
    EXPECT_EQ(uniformTriangle(vec2(0.0, 0.0)), vec2(0.0, 0.0));
    EXPECT_EQ(uniformTriangle(vec2(1.0, 0.0)), vec2(1.0, 0.0));
    EXPECT_EQ(uniformTriangle(vec2(0.0, 1.0)), vec2(0.0, 1.0));
    EXPECT_EQ(uniformTriangle(vec2(1.0, 1.0)), vec2(0.5, 0.5));
    EXPECT_EQ(uniformTriangle(vec2(0.5, 0.5)), vec2(0.25, 0.25));
    EXPECT_EQ(uniformTriangle(vec2(0.75, 0.25)), vec2(0.625, 0.125));
    EXPECT_EQ(uniformTriangle(vec2(0.25, 0.75)), vec2(0.125, 0.625));
}

// A small square on either side of the diagonal keeps its orientation, half its area (the triangle has half
// the area of the square) and nearly its shape: no edge is stretched by more than sqrt(5)/2. Multiples of
// 2^-12 make everything exact.
TEST(UniformTrianglePreservesAreas) {
    const float h = 1.0 / 4096.0;
    vec2 u = floor(randomVec2() * 4095.0) * h;
    if (u.x == u.y) u.x = u.x > 0.5 ? u.x - h : u.x + h;
    vec2 b = uniformTriangle(u);
    vec2 alongX = (uniformTriangle(u + vec2(h, 0.0)) - b) / h;
    vec2 alongY = (uniformTriangle(u + vec2(0.0, h)) - b) / h;
    EXPECT_EQ(alongX.x * alongY.y - alongX.y * alongY.x, 0.5);
    EXPECT_LE(dot(alongX, alongX), 1.25);
    EXPECT_LE(dot(alongY, alongY), 1.25);
}

// Both halves fit together along the diagonal and are mirror images.
TEST(UniformTriangleIsContinuousAndSymmetric) {
    vec2 u = randomVec2();
    EXPECT_EQ(uniformTriangle(u.yx), uniformTriangle(u).yx);
    float d = floor(u.x * 4096.0) / 4096.0;
    float h = 1.0 / 4096.0;
    EXPECT_LE(length(uniformTriangle(vec2(d, d + h)) - uniformTriangle(vec2(d + h, d))), 2.0 * h);
}

void expectFrame(vec3 n) {
    vec3 t, b;
    orthonormalBasis(n, t, b);
    EXPECT_NEAR(vec3(dot(t, t), dot(b, b), dot(t, b)), vec3(1.0, 1.0, 0.0), 6e-7);
    EXPECT_NEAR(vec2(dot(t, n), dot(b, n)), vec2(0.0), 6e-7);
    EXPECT_NEAR(cross(t, b), n, 6e-7);
}

TEST_N(BasisIsOrthonormalAndRightHanded, 65536) { expectFrame(randomDirection()); }

TEST_N(BasisIsOrthonormalAndRightHandedWhereItIsHard, 65536) { expectFrame(hardNormal()); }

// Archimedes: the height of a uniform point of the sphere is uniform.
TEST(UniformSphereIsUnitAndOfUniformHeight) {
    vec2 u = randomVec2();
    vec3 w = uniformSphere(u);
    EXPECT_NEAR(length(w), 1.0, 3e-7);
    EXPECT_EQ(w.z, 1.0 - 2.0 * u.x);
}

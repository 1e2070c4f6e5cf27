// The algebra of vector-valued radiance: laws that matrices per colour channel obey.
#include "shaders/lib/light_matrix.glsl"

// Entries are small integers, of either sign: products of four matrices are exact, and so are the comparisons.
vec3 randomIntegers() { return floor(randomVec3(-7.0, 8.0)); }

LightMatrix randomMatrix() {
    vec3 m00 = randomIntegers();
    vec3 m01 = randomIntegers();
    vec3 m10 = randomIntegers();
    return LightMatrix(m00, m01, m10, randomIntegers());
}

Light randomLight() {
    vec3 invisible = randomIntegers();
    return Light(invisible, randomIntegers());
}

// One channel as a GLSL matrix, which is stored by columns.
mat2 channel(LightMatrix a, int c) { return mat2(a.m00[c], a.m10[c], a.m01[c], a.m11[c]); }
vec2 channel(Light l, int c) { return vec2(l.invisible[c], l.visible[c]); }

LightMatrix transposed(LightMatrix a) { return LightMatrix(a.m00, a.m10, a.m01, a.m11); }
LightMatrix sum(LightMatrix a, LightMatrix b) {
    return LightMatrix(a.m00 + b.m00, a.m01 + b.m01, a.m10 + b.m10, a.m11 + b.m11);
}
Light sum(Light a, Light b) { return Light(a.invisible + b.invisible, a.visible + b.visible); }
vec3 inner(Light a, Light b) { return a.invisible * b.invisible + a.visible * b.visible; }

// The largest difference of an entry in any channel: 0 if and only if all entries are equal. (One expectation
// instead of many, which drivers compile slowly.)
float off(vec3 a, vec3 b) {
    vec3 d = abs(a - b);
    return max(d.x, max(d.y, d.z));
}
float off(LightMatrix a, LightMatrix b) {
    return max(max(off(a.m00, b.m00), off(a.m01, b.m01)), max(off(a.m10, b.m10), off(a.m11, b.m11)));
}
float off(Light a, Light b) { return max(off(a.invisible, b.invisible), off(a.visible, b.visible)); }
float off(mat2 a, mat2 b) { return off(vec3(a[0], a[1].x), vec3(b[0], b[1].x)) + abs(a[1].y - b[1].y); }

TEST(ProductIsThatOfMatricesInEveryChannel) {
    LightMatrix a = randomMatrix();
    LightMatrix b = randomMatrix();
    LightMatrix product = lightMultiply(a, b);
    float wrong = 0.0;
    for (int c = 0; c < 3; c++) wrong += off(channel(product, c), channel(a, c) * channel(b, c));
    EXPECT_EQ(wrong, 0.0);
}

TEST(ApplyingIsThatOfAMatrixInEveryChannel) {
    LightMatrix a = randomMatrix();
    Light l = randomLight();
    Light applied = lightApply(a, l);
    float wrong = 0.0;
    for (int c = 0; c < 3; c++) wrong += distance(channel(applied, c), channel(a, c) * channel(l, c));
    EXPECT_EQ(wrong, 0.0);
}

TEST(MultiplicationIsAssociative) {
    LightMatrix a = randomMatrix();
    LightMatrix b = randomMatrix();
    LightMatrix c = randomMatrix();
    EXPECT_EQ(off(lightMultiply(lightMultiply(a, b), c), lightMultiply(a, lightMultiply(b, c))), 0.0);
}

TEST(IdentityChangesNothing) {
    LightMatrix a = randomMatrix();
    Light l = randomLight();
    EXPECT_EQ(off(lightMultiply(a, lightIdentity()), a), 0.0);
    EXPECT_EQ(off(lightMultiply(lightIdentity(), a), a), 0.0);
    EXPECT_EQ(off(lightApply(lightIdentity(), l), l), 0.0);
}

TEST(MultiplicationDistributesOverSums) {
    LightMatrix a = randomMatrix();
    LightMatrix b = randomMatrix();
    LightMatrix c = randomMatrix();
    EXPECT_EQ(off(lightMultiply(a, sum(b, c)), sum(lightMultiply(a, b), lightMultiply(a, c))), 0.0);
    EXPECT_EQ(off(lightMultiply(sum(a, b), c), sum(lightMultiply(a, c), lightMultiply(b, c))), 0.0);
}

TEST(ApplyingIsLinear) {
    LightMatrix a = randomMatrix();
    LightMatrix b = randomMatrix();
    Light l = randomLight();
    Light m = randomLight();
    EXPECT_EQ(off(lightApply(a, sum(l, m)), sum(lightApply(a, l), lightApply(a, m))), 0.0);
    EXPECT_EQ(off(lightApply(sum(a, b), l), sum(lightApply(a, l), lightApply(b, l))), 0.0);
}

// One matrix turns visible light into invisible light, the other transmits only invisible light: they do not commute.
TEST_N(OrderMatters, 1) {
    LightMatrix raise = LightMatrix(vec3(0.0), vec3(1.0), vec3(0.0), vec3(0.0));
    LightMatrix keep = LightMatrix(vec3(1.0), vec3(0.0), vec3(0.0), vec3(0.0));
    LightMatrix zero = LightMatrix(vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0));
    EXPECT_EQ(off(lightMultiply(keep, raise), raise), 0.0);
    EXPECT_EQ(off(lightMultiply(raise, keep), zero), 0.0);
}

// <a, W b> = <W^T a, b>, channel by channel: the adjoint of a matrix is its transpose.
TEST(AdjointIsTheTranspose) {
    LightMatrix w = randomMatrix();
    Light a = randomLight();
    Light b = randomLight();
    EXPECT_EQ(inner(a, lightApply(w, b)), inner(lightApply(transposed(w), a), b));
}

TEST(TransposeReversesProducts) {
    LightMatrix a = randomMatrix();
    LightMatrix b = randomMatrix();
    EXPECT_EQ(off(transposed(lightMultiply(a, b)), lightMultiply(transposed(b), transposed(a))), 0.0);
}

// A path W = T O T from the camera, multiplied from the right, collects E. A particle that carries E is
// multiplied by the same matrices from the left, in the order in which it meets them. Both display row d of
// the result.
TEST(GatheringAndShootingGiveTheSame) {
    LightMatrix first = randomMatrix();
    LightMatrix second = randomMatrix();
    LightMatrix third = randomMatrix();
    Light display = randomLight();
    Light emission = randomLight();
    LightMatrix importance = lightMultiply(lightMultiply(lightMultiply(lightIdentity(), first), second), third);
    Light flux = lightApply(first, lightApply(second, lightApply(third, emission)));
    EXPECT_EQ(off(lightApply(importance, emission), flux), 0.0);
    // Only the displayed row: d W, which as a column is W^T d.
    Light row = lightApply(transposed(third), lightApply(transposed(second), lightApply(transposed(first), display)));
    EXPECT_EQ(inner(row, emission), inner(display, flux));
}

TEST(FirstColumnIsAllWhereTheSecondIsZero) {
    LightMatrix a = randomMatrix();
    LightMatrix b = randomMatrix();
    LightMatrix column = LightMatrix(b.m00, vec3(0.0), b.m10, vec3(0.0));
    EXPECT_EQ(off(lightMultiplyFirstColumn(a, column), lightMultiply(a, column)), 0.0);
    // The second column of b is ignored.
    EXPECT_EQ(off(lightMultiplyFirstColumn(a, b), lightMultiply(a, column)), 0.0);
}

TEST(ScalingIsByChannel) {
    LightMatrix a = randomMatrix();
    Light l = randomLight();
    vec3 s = randomIntegers();
    float wrongMatrix = 0.0;
    float wrongLight = 0.0;
    for (int c = 0; c < 3; c++) {
        wrongMatrix += off(channel(lightScale(a, s), c), s[c] * channel(a, c));
        wrongLight += distance(channel(lightScale(l, s), c), s[c] * channel(l, c));
    }
    EXPECT_EQ(wrongMatrix, 0.0);
    EXPECT_EQ(wrongLight, 0.0);
}

// Eq. 17: blocks on a diagonal. A channel does not affect the others.
TEST(ChannelsDoNotMix) {
    LightMatrix a = randomMatrix();
    LightMatrix b = randomMatrix();
    Light l = randomLight();
    int c = int(testIndex() % 3u);
    LightMatrix otherA = a;
    LightMatrix otherB = b;
    Light otherL = l;
    otherA.m00[c] += 100.0;
    otherA.m11[c] += 100.0;
    otherB.m01[c] += 100.0;
    otherB.m10[c] += 100.0;
    otherL.invisible[c] += 100.0;
    otherL.visible[c] += 100.0;
    float wrong = 0.0;
    for (int i = 1; i < 3; i++) {
        int k = (c + i) % 3;
        wrong += off(channel(lightMultiply(otherA, otherB), k), channel(lightMultiply(a, b), k));
        wrong += off(channel(lightMultiplyFirstColumn(otherA, otherB), k), channel(lightMultiplyFirstColumn(a, b), k));
        wrong += distance(channel(lightApply(otherA, otherL), k), channel(lightApply(a, l), k));
    }
    EXPECT_EQ(wrong, 0.0);
}

TEST(LargestComponentIsOneOfThemAndNoneIsLarger) {
    vec3 v = randomIntegers();
    float m = maxComponent(v);
    EXPECT_GE(vec3(m), v);
    EXPECT_TRUE(m == v.x || m == v.y || m == v.z);
}

// One entry in one channel at a time: invocation 3 e + c has entry e = m00, m01, m10, m11 in channel c.
TEST_N(WeightOfOneEntryIsThatOfItsRow, 12) {
    vec3 entry = vec3(0.0);
    entry[testIndex() % 3u] = 4.0;
    uint e = testIndex() / 3u;
    LightMatrix a = LightMatrix(e == 0u ? entry : vec3(0.0), e == 1u ? entry : vec3(0.0), e == 2u ? entry : vec3(0.0),
                                e == 3u ? entry : vec3(0.0));
    EXPECT_EQ(lightWeight(a, vec2(0.25, 0.75)), e < 2u ? 1.0 : 3.0);
}

// The weighted components of the matrix times (1, 1), in the brightest channel.
TEST(WeightIsWhatUnitLightBecomesInTheBrightestChannel) {
    LightMatrix a = randomMatrix();
    vec2 rows = vec2(0.25, 0.75);
    float expected = -1e30;
    for (int c = 0; c < 3; c++) expected = max(expected, dot(rows, channel(a, c) * vec2(1.0)));
    EXPECT_EQ(lightWeight(a, rows), expected);
}

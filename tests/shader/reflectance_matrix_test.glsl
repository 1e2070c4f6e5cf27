// The algebra of vector-valued radiance: laws that matrices per colour channel obey.
#include "shaders/lib/reflectance_matrix.glsl"

// Entries are small integers, of either sign: products of four matrices are exact, and so are the comparisons.
vec3 randomIntegers() { return floor(randomVec3(-7.0, 8.0)); }

ReflectanceMatrix randomMatrix() {
    vec3 m00 = randomIntegers();
    vec3 m01 = randomIntegers();
    vec3 m10 = randomIntegers();
    return ReflectanceMatrix(m00, m01, m10, randomIntegers());
}

Radiance2 randomLight() {
    vec3 invisible = randomIntegers();
    return Radiance2(invisible, randomIntegers());
}

// One channel as a GLSL matrix, which is stored by columns.
mat2 channel(ReflectanceMatrix a, int c) { return mat2(a.m00[c], a.m10[c], a.m01[c], a.m11[c]); }
vec2 channel(Radiance2 l, int c) { return vec2(l.invisible[c], l.visible[c]); }

ReflectanceMatrix transposed(ReflectanceMatrix a) { return ReflectanceMatrix(a.m00, a.m10, a.m01, a.m11); }
ReflectanceMatrix sum(ReflectanceMatrix a, ReflectanceMatrix b) {
    return ReflectanceMatrix(a.m00 + b.m00, a.m01 + b.m01, a.m10 + b.m10, a.m11 + b.m11);
}
Radiance2 sum(Radiance2 a, Radiance2 b) { return Radiance2(a.invisible + b.invisible, a.visible + b.visible); }
vec3 inner(Radiance2 a, Radiance2 b) { return a.invisible * b.invisible + a.visible * b.visible; }

// The largest difference of an entry in any channel: 0 if and only if all entries are equal. (One expectation
// instead of many, which drivers compile slowly.)
float off(vec3 a, vec3 b) {
    vec3 d = abs(a - b);
    return max(d.x, max(d.y, d.z));
}
float off(ReflectanceMatrix a, ReflectanceMatrix b) {
    return max(max(off(a.m00, b.m00), off(a.m01, b.m01)), max(off(a.m10, b.m10), off(a.m11, b.m11)));
}
float off(Radiance2 a, Radiance2 b) { return max(off(a.invisible, b.invisible), off(a.visible, b.visible)); }
float off(mat2 a, mat2 b) { return off(vec3(a[0], a[1].x), vec3(b[0], b[1].x)) + abs(a[1].y - b[1].y); }

TEST(ProductIsThatOfMatricesInEveryChannel) {
    ReflectanceMatrix a = randomMatrix();
    ReflectanceMatrix b = randomMatrix();
    ReflectanceMatrix product = matrixMultiply(a, b);
    float wrong = 0.0;
    for (int c = 0; c < 3; c++) wrong += off(channel(product, c), channel(a, c) * channel(b, c));
    EXPECT_EQ(wrong, 0.0);
}

TEST(ApplyingIsThatOfAMatrixInEveryChannel) {
    ReflectanceMatrix a = randomMatrix();
    Radiance2 l = randomLight();
    Radiance2 applied = matrixApply(a, l);
    float wrong = 0.0;
    for (int c = 0; c < 3; c++) wrong += distance(channel(applied, c), channel(a, c) * channel(l, c));
    EXPECT_EQ(wrong, 0.0);
}

TEST(MultiplicationIsAssociative) {
    ReflectanceMatrix a = randomMatrix();
    ReflectanceMatrix b = randomMatrix();
    ReflectanceMatrix c = randomMatrix();
    EXPECT_EQ(off(matrixMultiply(matrixMultiply(a, b), c), matrixMultiply(a, matrixMultiply(b, c))), 0.0);
}

TEST(IdentityChangesNothing) {
    ReflectanceMatrix a = randomMatrix();
    Radiance2 l = randomLight();
    EXPECT_EQ(off(matrixMultiply(a, matrixIdentity()), a), 0.0);
    EXPECT_EQ(off(matrixMultiply(matrixIdentity(), a), a), 0.0);
    EXPECT_EQ(off(matrixApply(matrixIdentity(), l), l), 0.0);
}

TEST(MultiplicationDistributesOverSums) {
    ReflectanceMatrix a = randomMatrix();
    ReflectanceMatrix b = randomMatrix();
    ReflectanceMatrix c = randomMatrix();
    EXPECT_EQ(off(matrixMultiply(a, sum(b, c)), sum(matrixMultiply(a, b), matrixMultiply(a, c))), 0.0);
    EXPECT_EQ(off(matrixMultiply(sum(a, b), c), sum(matrixMultiply(a, c), matrixMultiply(b, c))), 0.0);
}

TEST(ApplyingIsLinear) {
    ReflectanceMatrix a = randomMatrix();
    ReflectanceMatrix b = randomMatrix();
    Radiance2 l = randomLight();
    Radiance2 m = randomLight();
    EXPECT_EQ(off(matrixApply(a, sum(l, m)), sum(matrixApply(a, l), matrixApply(a, m))), 0.0);
    EXPECT_EQ(off(matrixApply(sum(a, b), l), sum(matrixApply(a, l), matrixApply(b, l))), 0.0);
}

// One matrix turns visible light into invisible light, the other transmits only invisible light: they do not commute.
TEST_N(OrderMatters, 1) {
    ReflectanceMatrix raise = ReflectanceMatrix(vec3(0.0), vec3(1.0), vec3(0.0), vec3(0.0));
    ReflectanceMatrix keep = ReflectanceMatrix(vec3(1.0), vec3(0.0), vec3(0.0), vec3(0.0));
    ReflectanceMatrix zero = ReflectanceMatrix(vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0));
    EXPECT_EQ(off(matrixMultiply(keep, raise), raise), 0.0);
    EXPECT_EQ(off(matrixMultiply(raise, keep), zero), 0.0);
}

// <a, W b> = <W^T a, b>, channel by channel: the adjoint of a matrix is its transpose.
TEST(AdjointIsTheTranspose) {
    ReflectanceMatrix w = randomMatrix();
    Radiance2 a = randomLight();
    Radiance2 b = randomLight();
    EXPECT_EQ(inner(a, matrixApply(w, b)), inner(matrixApply(transposed(w), a), b));
}

TEST(TransposeReversesProducts) {
    ReflectanceMatrix a = randomMatrix();
    ReflectanceMatrix b = randomMatrix();
    EXPECT_EQ(off(transposed(matrixMultiply(a, b)), matrixMultiply(transposed(b), transposed(a))), 0.0);
}

// A path W = T O T from the camera, multiplied from the right, collects E. A light path that carries E is
// multiplied by the same matrices from the left, in the order in which it meets them. Both display row d of
// the result.
TEST(GatheringAndShootingGiveTheSame) {
    ReflectanceMatrix first = randomMatrix();
    ReflectanceMatrix second = randomMatrix();
    ReflectanceMatrix third = randomMatrix();
    Radiance2 display = randomLight();
    Radiance2 emission = randomLight();
    ReflectanceMatrix importance =
        matrixMultiply(matrixMultiply(matrixMultiply(matrixIdentity(), first), second), third);
    Radiance2 flux = matrixApply(first, matrixApply(second, matrixApply(third, emission)));
    EXPECT_EQ(off(matrixApply(importance, emission), flux), 0.0);
    // Only the displayed row: d W, which as a column is W^T d.
    Radiance2 row =
        matrixApply(transposed(third), matrixApply(transposed(second), matrixApply(transposed(first), display)));
    EXPECT_EQ(inner(row, emission), inner(display, flux));
}

TEST(FirstColumnIsAllWhereTheSecondIsZero) {
    ReflectanceMatrix a = randomMatrix();
    ReflectanceMatrix b = randomMatrix();
    ReflectanceMatrix column = ReflectanceMatrix(b.m00, vec3(0.0), b.m10, vec3(0.0));
    EXPECT_EQ(off(matrixMultiplyFirstColumn(a, column), matrixMultiply(a, column)), 0.0);
    // The second column of b is ignored.
    EXPECT_EQ(off(matrixMultiplyFirstColumn(a, b), matrixMultiply(a, column)), 0.0);
}

TEST(ScalingIsByChannel) {
    ReflectanceMatrix a = randomMatrix();
    Radiance2 l = randomLight();
    vec3 s = randomIntegers();
    float wrongMatrix = 0.0;
    float wrongLight = 0.0;
    for (int c = 0; c < 3; c++) {
        wrongMatrix += off(channel(scaled(a, s), c), s[c] * channel(a, c));
        wrongLight += distance(channel(scaled(l, s), c), s[c] * channel(l, c));
    }
    EXPECT_EQ(wrongMatrix, 0.0);
    EXPECT_EQ(wrongLight, 0.0);
}

// Eq. 17: blocks on a diagonal. A channel does not affect the others.
TEST(ChannelsDoNotMix) {
    ReflectanceMatrix a = randomMatrix();
    ReflectanceMatrix b = randomMatrix();
    Radiance2 l = randomLight();
    int c = int(testIndex() % 3u);
    ReflectanceMatrix otherA = a;
    ReflectanceMatrix otherB = b;
    Radiance2 otherL = l;
    otherA.m00[c] += 100.0;
    otherA.m11[c] += 100.0;
    otherB.m01[c] += 100.0;
    otherB.m10[c] += 100.0;
    otherL.invisible[c] += 100.0;
    otherL.visible[c] += 100.0;
    float wrong = 0.0;
    for (int i = 1; i < 3; i++) {
        int k = (c + i) % 3;
        wrong += off(channel(matrixMultiply(otherA, otherB), k), channel(matrixMultiply(a, b), k));
        wrong += off(channel(matrixMultiplyFirstColumn(otherA, otherB), k),
                     channel(matrixMultiplyFirstColumn(a, b), k));
        wrong += distance(channel(matrixApply(otherA, otherL), k), channel(matrixApply(a, l), k));
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
    ReflectanceMatrix a = ReflectanceMatrix(e == 0u ? entry : vec3(0.0), e == 1u ? entry : vec3(0.0),
                                            e == 2u ? entry : vec3(0.0), e == 3u ? entry : vec3(0.0));
    EXPECT_EQ(matrixWeight(a, vec2(0.25, 0.75)), e < 2u ? 1.0 : 3.0);
}

// The weighted components of the matrix times (1, 1), in the brightest channel.
TEST(WeightIsWhatUnitLightBecomesInTheBrightestChannel) {
    ReflectanceMatrix a = randomMatrix();
    vec2 rows = vec2(0.25, 0.75);
    float expected = -1e30;
    for (int c = 0; c < 3; c++) expected = max(expected, dot(rows, channel(a, c) * vec2(1.0)));
    EXPECT_EQ(matrixWeight(a, rows), expected);
}

// The parts of the traversal that need no tree: see traverse_test.cpp for nodes, traversal_test.cpp for the whole.
#include "shaders/lib/traverse.glsl"

// Triangles as a test puts them here, 8 of them.
uvec4 triangleTexels[24];
uvec4 fetchTriangleTexel(uint index) { return triangleTexels[index]; }
uvec4 fetchNodeTexel(uint index) { return uvec4(0u); }

// A triangle in the plane z = height, around the z axis.
void putTriangle(uint index, float height, uint primitive) {
    uint z = floatBitsToUint(height);
    triangleTexels[3u * index] = uvec4(floatBitsToUint(-1.0), floatBitsToUint(-1.0), z, primitive);
    triangleTexels[3u * index + 1u] = uvec4(floatBitsToUint(1.0), floatBitsToUint(-1.0), z, 0u);
    triangleTexels[3u * index + 2u] = uvec4(floatBitsToUint(0.0), floatBitsToUint(2.0), z, 0u);
}

// Along the z axis from the origin, with these triangles of group `base` to test.
Traversal alongZ(float tMin, uint after, float tMax, uint base, uint mask) {
    Traversal r = traversalStart(0u, vec3(0.0), vec3(0.0, 0.0, 1.0), tMin, after, tMax, false);
    r.nodesLeft = false;
    r.triangleBase = base;
    r.triangleMask = mask;
    return r;
}

TEST(TrianglesAreFetchedFromTheirTexels) {
    for (uint i = 0u; i < 24u; i++) {
        uvec2 words = uvec2(randomUint(), randomUint()) >> 2u;  // finite as floats
        triangleTexels[i] = uvec4(words, words.yx ^ 0x155aau);
    }
    uint index = randomUint() & 7u;
    Triangle tri = fetchTriangle(index);
    EXPECT_EQ(floatBitsToUint(tri.v0), triangleTexels[3u * index].xyz);
    EXPECT_EQ(floatBitsToUint(tri.v1), triangleTexels[3u * index + 1u].xyz);
    EXPECT_EQ(floatBitsToUint(tri.v2), triangleTexels[3u * index + 2u].xyz);
    EXPECT_EQ(tri.primitive, triangleTexels[3u * index].w);
    EXPECT_EQ(tri.materialFlags, triangleTexels[3u * index + 1u].w);
}

TEST(StartsAtTheRootWithTheRay) {
    uint root = randomUint();
    vec3 origin = randomVec3(-9.0, 9.0);
    vec3 d = randomDirection();
    float tMin = randomFloat();
    uint after = randomUint();
    float tMax = randomFloat(1.0, 2.0);
    bool anyHit = (randomUint() & 1u) == 0u;
    Traversal r = traversalStart(root, origin, d, tMin, after, tMax, anyHit);
    EXPECT_EQ(r.origin, origin);
    EXPECT_EQ(r.direction, d);
    EXPECT_ULP(r.inverse, 1.0 / d, 3);
    vec3 axisU, axisV;
    orthonormalBasis(d, axisU, axisV);
    EXPECT_EQ(r.axisU, axisU);
    EXPECT_EQ(r.axisV, axisV);
    EXPECT_EQ(r.tMin, tMin);
    EXPECT_EQ(r.afterPrimitive, after);
    EXPECT_EQ(r.anyHit, anyHit);
    // Bits of the octant as those of a slot: set where the ray runs towards the upper side, XOR gives the nearest 7.
    EXPECT_EQ(r.octant, (d.x > 0.0 ? 4u : 0u) + (d.y > 0.0 ? 2u : 0u) + (d.z > 0.0 ? 1u : 0u));
    EXPECT_EQ(r.t, tMax);
    EXPECT_EQ(r.triangle, kNoTriangle);
    EXPECT_EQ(r.primitive, kNoTriangle);
    EXPECT_EQ(r.barycentric, vec2(0.0));
    EXPECT_EQ(uvec2(r.groupBase, r.groupMask), uvec2(root, 0x80000000u));
    EXPECT_EQ(r.triangleMask, 0u);
    EXPECT_EQ(r.stackSize, 0);
    EXPECT_TRUE(traversalAlive(r));
}

TEST_N(ZerosOfADirectionCountAsPositive, 1) {
    Traversal r = traversalStart(0u, vec3(0.0), vec3(0.0, -0.0, -1.0), 0.0, 0u, 1.0, false);
    EXPECT_EQ(r.octant, 6u);
    EXPECT_ULP(r.inverse, vec3(1e20, 1e20, -1.0), 3);
}

TEST_N(AliveWhileThereAreNodesOrTriangles, 1) {
    Traversal r = alongZ(0.0, 0u, 1.0, 0u, 0u);
    EXPECT_FALSE(traversalAlive(r));
    r.triangleMask = 8u;
    EXPECT_TRUE(traversalAlive(r));
    r.nodesLeft = true;
    EXPECT_TRUE(traversalAlive(r));
    r.triangleMask = 0u;
    EXPECT_TRUE(traversalAlive(r));
}

// With a negative operand, too, as long as the result is not negative; else it is some negative number.
TEST(MinimumAndMaximumOnBits) {
    float a = randomScale(-60.0, 60.0);
    float b = (randomUint() & 7u) == 0u ? 0.0 : randomScale(-60.0, 60.0);
    EXPECT_EQ(bitsMin(a, b), min(a, b));
    EXPECT_EQ(bitsMin(b, a), min(a, b));
    EXPECT_EQ(bitsMax(a, b), max(a, b));
    EXPECT_EQ(bitsMax(b, a), max(a, b));
    EXPECT_EQ(bitsMax(-a, b), b);
    EXPECT_EQ(bitsMax(b, -a), b);
    EXPECT_LT(bitsMin(-a, b), 0.0);
    EXPECT_LT(bitsMin(-a, -b - 1e-30), 0.0);
    EXPECT_LT(bitsMax(-a, -b - 1e-30), 0.0);
    float infinity = uintBitsToFloat(0x7f800000u);
    EXPECT_EQ(bitsMin(a, infinity), a);
    EXPECT_EQ(bitsMax(a, infinity), infinity);
}

TEST(BytesFromTheLowestUp) {
    uint x = randomUint();
    uvec4 bytes = uvec4(x, x >> 8u, x >> 16u, x >> 24u) & 255u;
    EXPECT_EQ(unpackBytes(x), vec4(bytes));
    EXPECT_EQ(unpackBytes(0xff000000u | (x & 0xffu)), vec4(float(x & 0xffu), 0.0, 0.0, 255.0));
}

TEST(TrianglesAreTestedFromTheLowestBitUp) {
    for (uint i = 0u; i < 8u; i++) putTriangle(i, 1.0 + float(i), 100u + i);
    uint mask = 1u + (randomUint() & 30u);
    if ((randomUint() & 1u) == 0u) mask &= ~1u;
    mask = mask == 0u ? 16u : mask;
    uint first = mask & (~mask + 1u);
    Traversal r = alongZ(0.0, kNoTriangle, 1e30, 2u, mask);
    testTriangle(r, false);
    EXPECT_EQ(r.triangleMask, mask ^ first);
    EXPECT_EQ(r.triangle, 2u + uint(findLSB(first)));
    EXPECT_EQ(r.primitive, 102u + uint(findLSB(first)));
    EXPECT_NEAR(r.t, 3.0 + float(findLSB(first)), 1e-6);
    // The origin is a third from v0 to v1 and v2 each.
    EXPECT_NEAR(r.barycentric, vec2(1.0 / 3.0), 1e-6);
    // What comes after is further away, or the same.
    Traversal before = r;
    r.triangleMask = mask;
    testTriangle(r, (randomUint() & 1u) == 0u);
    EXPECT_EQ(vec3(r.t, r.barycentric), vec3(before.t, before.barycentric));
    if (r.triangleMask != 0u) testTriangle(r, (randomUint() & 1u) == 0u);
    EXPECT_EQ(r.triangle, before.triangle);
}

// Distances at both ends are left out; a ray that walks in order leaves out only what comes before or is the last
// crossing, and takes coincident ones in the order of primitives.
TEST_N(HitsLieBetweenTheDistances, 1) {
    putTriangle(0u, 2.0, 5u);
    Traversal r = alongZ(2.0, 4u, 9.0, 0u, 1u);
    testTriangle(r, false);
    EXPECT_EQ(r.triangle, kNoTriangle);
    r = alongZ(1.5, 4u, 2.0, 0u, 1u);
    testTriangle(r, false);
    EXPECT_EQ(r.triangle, kNoTriangle);
    EXPECT_EQ(r.t, 2.0);
    r = alongZ(1.5, 9u, 2.5, 0u, 1u);
    testTriangle(r, false);
    EXPECT_EQ(uvec2(r.triangle, r.primitive), uvec2(0u, 5u));
    EXPECT_EQ(r.t, 2.0);

    r = alongZ(2.0, 4u, 9.0, 0u, 1u);
    testTriangle(r, true);
    EXPECT_EQ(r.primitive, 5u);
    r = alongZ(2.0, 5u, 9.0, 0u, 1u);
    testTriangle(r, true);
    EXPECT_EQ(r.primitive, kNoTriangle);
    r = alongZ(2.5, 4u, 9.0, 0u, 1u);
    testTriangle(r, true);
    EXPECT_EQ(r.primitive, kNoTriangle);
    r = alongZ(1.5, 9u, 9.0, 0u, 1u);
    testTriangle(r, true);
    EXPECT_EQ(r.primitive, 5u);
    r = alongZ(1.5, 9u, 1.75, 0u, 1u);
    testTriangle(r, true);
    EXPECT_EQ(r.primitive, kNoTriangle);
}

TEST_N(OfCoincidentHitsTheFirstPrimitiveIsMetFirst, 1) {
    putTriangle(0u, 2.0, 5u);
    putTriangle(1u, 2.0, 3u);
    putTriangle(2u, 2.0, 4u);
    Traversal r = alongZ(0.0, kNoTriangle, 9.0, 0u, 7u);
    testTriangle(r, true);
    EXPECT_EQ(uvec2(r.triangle, r.primitive), uvec2(0u, 5u));
    testTriangle(r, true);
    EXPECT_EQ(uvec2(r.triangle, r.primitive), uvec2(1u, 3u));
    testTriangle(r, true);
    EXPECT_EQ(uvec2(r.triangle, r.primitive), uvec2(1u, 3u));
    EXPECT_EQ(r.triangleMask, 0u);
    r = alongZ(2.0, 3u, 9.0, 0u, 7u);
    testTriangle(r, true);
    testTriangle(r, true);
    testTriangle(r, true);
    EXPECT_EQ(uvec2(r.triangle, r.primitive), uvec2(2u, 4u));
    // Without order the first that was tested stays.
    r = alongZ(0.0, kNoTriangle, 9.0, 0u, 7u);
    testTriangle(r, false);
    testTriangle(r, false);
    EXPECT_EQ(uvec2(r.triangle, r.primitive), uvec2(0u, 5u));
}

TEST(ATriangleThatIsNotHitChangesNothing) {
    putTriangle(0u, 2.0, 5u);
    vec3 beside = normalize(vec3(1.5, randomFloat(-1.0, 1.0), 1.0));
    Traversal r = traversalStart(0u, vec3(0.0), beside, 0.0, kNoTriangle, 9.0, false);
    r.triangleMask = 1u;
    testTriangle(r, (randomUint() & 1u) == 0u);
    EXPECT_EQ(uvec3(r.triangle, r.primitive, r.triangleMask), uvec3(kNoTriangle, kNoTriangle, 0u));
    EXPECT_EQ(vec3(r.t, r.barycentric), vec3(9.0, 0.0, 0.0));
}

// The parts of the traversal that need no tree. traverse_test.cpp tests nodes, traversal_test.cpp whole traversals.
#include "shaders/lib/traverse.glsl"

// Eight pairs of triangles, which the tests fill in.
uvec4 pairTexels[32];
uvec4 fetchPairTexel(uint index) { return pairTexels[index]; }
uvec4 fetchNodeTexel(uint index) { return uvec4(0u); }
vec4 planes[16];
uvec4 fetchPlaneTexel(uint index) { return floatBitsToUint(planes[index]); }

void putPair(uint pair, vec3 v0, vec3 v1, vec3 v2, vec3 v3, uint primitive0, uint primitive1) {
    pairTexels[4u * pair] = uvec4(floatBitsToUint(v0), primitive0);
    pairTexels[4u * pair + 1u] = uvec4(floatBitsToUint(v1), 0u);
    pairTexels[4u * pair + 2u] = uvec4(floatBitsToUint(v2), 0u);
    pairTexels[4u * pair + 3u] = uvec4(floatBitsToUint(v3), primitive1);
}

// A single triangle in the plane z = height, around the z axis, that faces down or up.
void putTriangle(uint pair, float height, uint primitive, bool frontBelow) {
    vec3 v1 = frontBelow ? vec3(0.0, 2.0, height) : vec3(1.0, -1.0, height);
    vec3 v2 = frontBelow ? vec3(1.0, -1.0, height) : vec3(0.0, 2.0, height);
    putPair(pair, vec3(-1.0, -1.0, height), v1, v2, v1, primitive, kNoTriangle);
}

// A ray along the z axis hits the front.
void putTriangle(uint pair, float height, uint primitive) { putTriangle(pair, height, primitive, true); }

// Two triangles that both cross the z axis, at these heights: the pair is folded at an edge beside the axis.
void putFolded(uint pair, float height0, float height1, uint primitive0, uint primitive1) {
    float edge = 0.5 * (height0 + height1);
    putPair(pair, vec3(1.0, 0.0, 2.0 * height0 - edge), vec3(-1.0, -2.0, edge), vec3(-1.0, 2.0, edge),
            vec3(1.0, 0.0, 2.0 * height1 - edge), primitive0, primitive1);
}

// A ray along the z axis from the origin, with these pairs of group `base` to test.
Traversal alongZ(float tMin, uint after, float tMax, uint base, uint mask) {
    Traversal r = traversalStart(0u, vec3(0.0), vec3(0.0, 0.0, 1.0), tMin, after, tMax, false);
    r.nodesLeft = false;
    r.pairBase = base;
    r.pairMask = mask;
    return r;
}

TEST(TrianglesAreFetchedFromTheirTexels) {
    for (uint i = 0u; i < 32u; i++) {
        uvec2 words = uvec2(randomUint(), randomUint()) >> 2u;  // finite as floats
        pairTexels[i] = uvec4(words, words.yx ^ 0x155aau);
    }
    uint pair = randomUint() & 7u;
    bool second = (randomUint() & 1u) != 0u;
    Triangle tri = fetchTriangle(2u * pair + (second ? 1u : 0u));
    uint texel = 4u * pair;
    EXPECT_EQ(floatBitsToUint(tri.v0), pairTexels[texel + (second ? 3u : 0u)].xyz);
    EXPECT_EQ(floatBitsToUint(tri.v1), pairTexels[texel + (second ? 2u : 1u)].xyz);
    EXPECT_EQ(floatBitsToUint(tri.v2), pairTexels[texel + (second ? 1u : 2u)].xyz);
    EXPECT_EQ(tri.primitive, pairTexels[texel + (second ? 3u : 0u)].w);
    EXPECT_EQ(tri.materialFlags, pairTexels[texel + (second ? 1u : 2u)].w);
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
    EXPECT_EQ(r.afterOrder, after);
    EXPECT_EQ(r.anyHit, anyHit);
    // Octants and slots have the same bits, set where the ray runs towards the upper side; the nearest slot
    // XOR the octant is 7.
    EXPECT_EQ(r.octant, (d.x > 0.0 ? 4u : 0u) + (d.y > 0.0 ? 2u : 0u) + (d.z > 0.0 ? 1u : 0u));
    EXPECT_EQ(r.t, tMax);
    EXPECT_EQ(r.triangle, kNoTriangle);
    EXPECT_EQ(r.order, kNoTriangle);
    EXPECT_EQ(r.barycentric, vec2(0.0));
    EXPECT_EQ(uvec2(r.groupBase, r.groupMask), uvec2(root, 0x80000000u));
    EXPECT_EQ(r.pairMask, 0u);
    EXPECT_EQ(r.stackSize, 0);
    EXPECT_TRUE(traversalAlive(r));
}

TEST_N(ZerosOfADirectionCountAsPositive, 1) {
    Traversal r = traversalStart(0u, vec3(0.0), vec3(0.0, -0.0, -1.0), 0.0, 0u, 1.0, false);
    EXPECT_EQ(r.octant, 6u);
    EXPECT_ULP(r.inverse, vec3(1e20, 1e20, -1.0), 3);
}

TEST_N(AliveWhileThereAreNodesOrPairs, 1) {
    Traversal r = alongZ(0.0, 0u, 1.0, 0u, 0u);
    EXPECT_FALSE(traversalAlive(r));
    r.pairMask = 8u;
    EXPECT_TRUE(traversalAlive(r));
    r.nodesLeft = true;
    EXPECT_TRUE(traversalAlive(r));
    r.pairMask = 0u;
    EXPECT_TRUE(traversalAlive(r));
}

TEST(BytesFromTheLowestUp) {
    uint x = randomUint();
    uvec4 bytes = uvec4(x, x >> 8u, x >> 16u, x >> 24u) & 255u;
    EXPECT_EQ(unpackBytes(x), vec4(bytes));
    EXPECT_EQ(unpackBytes(0xff000000u | (x & 0xffu)), vec4(float(x & 0xffu), 0.0, 0.0, 255.0));
}

TEST(PairsAreTestedFromTheLowestBitUp) {
    for (uint i = 0u; i < 8u; i++) putTriangle(i, 1.0 + float(i), 100u + i);
    uint mask = 1u + (randomUint() & 30u);
    if ((randomUint() & 1u) == 0u) mask &= ~1u;
    mask = mask == 0u ? 16u : mask;
    uint first = mask & (~mask + 1u);
    Traversal r = alongZ(0.0, kNoTriangle, 1e30, 2u, mask);
    testPair(r, false);
    EXPECT_EQ(r.pairMask, mask ^ first);
    EXPECT_EQ(r.triangle, 2u * (2u + uint(findLSB(first))));
    EXPECT_EQ(r.order, 102u + uint(findLSB(first)));
    EXPECT_NEAR(r.t, 3.0 + float(findLSB(first)), 1e-6);
    // All three barycentric coordinates are 1/3.
    EXPECT_NEAR(r.barycentric, vec2(1.0 / 3.0), 1e-6);
    // The following pairs are further away, or the same.
    Traversal before = r;
    r.pairMask = mask;
    testPair(r, (randomUint() & 1u) == 0u);
    EXPECT_EQ(vec3(r.t, r.barycentric), vec3(before.t, before.barycentric));
    if (r.pairMask != 0u) testPair(r, (randomUint() & 1u) == 0u);
    EXPECT_EQ(r.triangle, before.triangle);
}

// Excludes hits at both ends of the interval. An ordered traversal excludes only the last crossing and hits
// before it, and takes coincident hits in the order of primitives.
TEST_N(HitsLieBetweenTheDistances, 1) {
    putTriangle(0u, 2.0, 5u);
    Traversal r = alongZ(2.0, 4u, 9.0, 0u, 1u);
    testPair(r, false);
    EXPECT_EQ(r.triangle, kNoTriangle);
    r = alongZ(1.5, 4u, 2.0, 0u, 1u);
    testPair(r, false);
    EXPECT_EQ(r.triangle, kNoTriangle);
    EXPECT_EQ(r.t, 2.0);
    r = alongZ(1.5, 9u, 2.5, 0u, 1u);
    testPair(r, false);
    EXPECT_EQ(uvec2(r.triangle, r.order), uvec2(0u, 5u));
    EXPECT_EQ(r.t, 2.0);

    r = alongZ(2.0, 4u, 9.0, 0u, 1u);
    testPair(r, true);
    EXPECT_EQ(r.order, 5u);
    r = alongZ(2.0, 5u, 9.0, 0u, 1u);
    testPair(r, true);
    EXPECT_EQ(r.order, kNoTriangle);
    r = alongZ(2.5, 4u, 9.0, 0u, 1u);
    testPair(r, true);
    EXPECT_EQ(r.order, kNoTriangle);
    r = alongZ(1.5, 9u, 9.0, 0u, 1u);
    testPair(r, true);
    EXPECT_EQ(r.order, 5u);
    r = alongZ(1.5, 9u, 1.75, 0u, 1u);
    testPair(r, true);
    EXPECT_EQ(r.order, kNoTriangle);
}

TEST_N(OfCoincidentHitsTheFirstPrimitiveIsMetFirst, 1) {
    putTriangle(0u, 2.0, 5u);
    putTriangle(1u, 2.0, 3u);
    putTriangle(2u, 2.0, 4u);
    Traversal r = alongZ(0.0, kNoTriangle, 9.0, 0u, 7u);
    testPair(r, true);
    EXPECT_EQ(uvec2(r.triangle, r.order), uvec2(0u, 5u));
    testPair(r, true);
    EXPECT_EQ(uvec2(r.triangle, r.order), uvec2(2u, 3u));
    testPair(r, true);
    EXPECT_EQ(uvec2(r.triangle, r.order), uvec2(2u, 3u));
    EXPECT_EQ(r.pairMask, 0u);
    r = alongZ(2.0, 3u, 9.0, 0u, 7u);
    testPair(r, true);
    testPair(r, true);
    testPair(r, true);
    EXPECT_EQ(uvec2(r.triangle, r.order), uvec2(4u, 4u));
    // An unordered traversal keeps the first one tested.
    r = alongZ(0.0, kNoTriangle, 9.0, 0u, 7u);
    testPair(r, false);
    testPair(r, false);
    EXPECT_EQ(uvec2(r.triangle, r.order), uvec2(0u, 5u));
}

TEST(ATriangleThatIsNotHitChangesNothing) {
    putTriangle(0u, 2.0, 5u);
    vec3 beside = normalize(vec3(1.5, randomFloat(-1.0, 1.0), 1.0));
    Traversal r = traversalStart(0u, vec3(0.0), beside, 0.0, kNoTriangle, 9.0, false);
    r.pairMask = 1u;
    testPair(r, (randomUint() & 1u) == 0u);
    EXPECT_EQ(uvec3(r.triangle, r.order, r.pairMask), uvec3(kNoTriangle, kNoTriangle, 0u));
    EXPECT_EQ(vec3(r.t, r.barycentric), vec3(9.0, 0.0, 0.0));
}

// Either may be the nearer one. The first faces down, the second faces up.
TEST(BothTrianglesOfAPairAreMet) {
    float heights[2] = {randomFloat(1.0, 4.0), randomFloat(5.0, 9.0)};
    uint near = randomUint() & 1u;
    uint orders[2] = {7u, ~8u};
    putFolded(1u, heights[near], heights[1u - near], 7u, 8u);
    Traversal r = alongZ(0.0, kNoTriangle, 20.0, 1u, 1u);
    testPair(r, (randomUint() & 1u) == 0u);
    EXPECT_EQ(uvec3(r.triangle, r.order, r.pairMask), uvec3(2u + near, orders[near], 0u));
    EXPECT_NEAR(r.t, heights[0], 1e-5);
    // The axis is half way from the edge to the opposite corner; corners 0 and 3 come first.
    EXPECT_NEAR(r.barycentric, vec2(0.25), 1e-5);
    // The other triangle is behind it.
    r = alongZ(r.t, r.order, 20.0, 1u, 1u);
    testPair(r, true);
    EXPECT_EQ(uvec2(r.triangle, r.order), uvec2(3u - near, orders[1u - near]));
    EXPECT_NEAR(r.t, heights[1], 1e-5);
    r = alongZ(r.t, r.order, 20.0, 1u, 1u);
    testPair(r, true);
    EXPECT_EQ(r.triangle, kNoTriangle);
}

// Its triangles coincide: the one whose front is hit comes first, whatever the primitives.
TEST_N(APairFoldedShutIsMetFrontFirst, 1) {
    for (uint k = 0u; k < 2u; k++) {
        putFolded(0u, 3.0, 3.0, 5u + k, 6u - k);
        Traversal r = alongZ(0.0, kNoTriangle, 9.0, 0u, 1u);
        testPair(r, true);
        EXPECT_EQ(uvec2(r.triangle, r.order), uvec2(0u, 5u + k));
        r = alongZ(r.t, r.order, 9.0, 0u, 1u);
        testPair(r, true);
        EXPECT_EQ(uvec2(r.triangle, r.order), uvec2(1u, ~(6u - k)));
    }
}

// Six coincident triangles of both windings, crossed one after another by a ray and by the reverse ray.
TEST(AReverseRayMeetsCoincidentSurfacesInReverse) {
    uint fronts = randomUint();
    for (uint i = 0u; i < 6u; i++) putTriangle(i, 2.0, (i * 5u + 3u) % 6u, ((fronts >> i) & 1u) != 0u);
    uint met[12];
    for (uint way = 0u; way < 2u; way++) {
        vec3 origin = vec3(0.0, 0.0, way == 0u ? 0.0 : 4.0);
        float t = 0.0;
        uint order = kNoTriangle;
        for (uint i = 0u; i < 6u; i++) {
            Traversal r = traversalStart(0u, origin, vec3(0.0, 0.0, way == 0u ? 1.0 : -1.0), t, order, 9.0, false);
            r.nodesLeft = false;
            r.pairMask = 63u;
            while (r.pairMask != 0u) testPair(r, true);
            met[6u * way + i] = r.triangle;
            t = r.t;
            order = r.order;
        }
    }
    for (uint i = 0u; i < 6u; i++) EXPECT_EQ(met[i], met[11u - i]);
    // No surface is crossed twice.
    uint all = 0u;
    for (uint i = 0u; i < 6u; i++) all |= 1u << (met[i] / 2u);
    EXPECT_EQ(all, 63u);
}

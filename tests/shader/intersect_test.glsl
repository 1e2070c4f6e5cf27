// Rays against triangles and boxes, and points on triangles. See also watertight_test.glsl and intersect_test.cpp.
#include "shaders/lib/intersect.glsl"

TriangleHit shoot(Triangle tri, vec3 origin, vec3 direction) {
    vec3 axisU, axisV;
    orthonormalBasis(direction, axisU, axisV);
    return intersectTriangle(tri, origin, direction, axisU, axisV, testIndex() % 2u == 0u);
}

Triangle triangleOf(vec3 a, vec3 b, vec3 c) { return Triangle(a, b, c, 7u, 0u); }

// Corners within a cube of edge 2, the angle at v0 between 23 and 157 degrees.
Triangle randomTriangle() {
    vec3 a = randomVec3(-1.0, 1.0);
    vec3 d = randomDirection();
    vec3 e = randomDirection();
    for (int i = 0; i < 32 && abs(dot(d, e)) > 0.92; i++) e = randomDirection();
    return triangleOf(a, a + d * randomFloat(0.5, 2.0), a + e * randomFloat(0.5, 2.0));
}

Triangle scaled(Triangle tri, float scale, vec3 offset) {
    return triangleOf(tri.v0 * scale + offset, tri.v1 * scale + offset, tri.v2 * scale + offset);
}

vec3 normalOf(Triangle tri) { return normalize(cross(tri.v1 - tri.v0, tri.v2 - tri.v0)); }

vec3 at(Triangle tri, vec2 b) { return tri.v0 * (1.0 - b.x - b.y) + tri.v1 * b.x + tri.v2 * b.y; }

// At least 6 degrees off the plane.
vec3 randomDirectionAcross(Triangle tri) {
    vec3 d = randomDirection();
    for (int i = 0; i < 64 && abs(dot(d, normalOf(tri))) < 0.1; i++) d = randomDirection();
    return d;
}

vec2 randomInside(float margin) {
    vec2 b = randomVec2();
    b = b.x + b.y > 1.0 ? 1.0 - b : b;
    return margin + (1.0 - 3.0 * margin) * b;
}

TEST(HitsInsideAtTheDistanceAndBarycentricsOfV1AndV2) {
    Triangle tri = randomTriangle();
    vec2 b = randomInside(0.001);
    vec3 d = randomDirectionAcross(tri);
    float t = randomFloat(0.1, 4.0);
    TriangleHit h = shoot(tri, at(tri, b) - d * t, d);
    EXPECT_TRUE(h.hit);
    EXPECT_NEAR(h.t, t, 2e-5);
    EXPECT_NEAR(h.barycentric, b, 5e-5);
    // Behind the origin: the distance is negative.
    h = shoot(tri, at(tri, b) + d * t, d);
    EXPECT_TRUE(h.hit);
    EXPECT_NEAR(h.t, -t, 2e-5);
    EXPECT_NEAR(h.barycentric, b, 5e-5);
}

TEST(MissesBesideEveryEdge) {
    Triangle tri = randomTriangle();
    vec3 b = vec3(-randomFloat(0.001, 2.0), randomVec2());
    b.z = 1.0 - b.x - b.y;
    int turn = int(randomUint() % 3u);
    vec2 outside = turn == 0 ? b.xy : turn == 1 ? b.yz : b.zx;
    vec3 d = randomDirectionAcross(tri);
    EXPECT_FALSE(shoot(tri, at(tri, outside) - d * randomFloat(-3.0, 3.0), d).hit);
}

TEST(BothSidesAreHitWhateverTheOrderOfCorners) {
    Triangle tri = randomTriangle();
    vec2 b = randomInside(0.001);
    vec3 d = randomDirectionAcross(tri);
    vec3 origin = at(tri, b) - 2.0 * d;
    TriangleHit h = shoot(tri, origin, d);
    TriangleHit turned = shoot(triangleOf(tri.v1, tri.v2, tri.v0), origin, d);
    TriangleHit mirrored = shoot(triangleOf(tri.v0, tri.v2, tri.v1), origin, d);
    EXPECT_TRUE(h.hit && turned.hit && mirrored.hit);
    EXPECT_NEAR(vec2(turned.t, mirrored.t), vec2(h.t), 2e-6);
    EXPECT_NEAR(mirrored.barycentric, h.barycentric.yx, 2e-6);
    vec2 ofV0V1 = vec2(turned.barycentric.y, 1.0 - turned.barycentric.x - turned.barycentric.y);
    EXPECT_NEAR(ofV0V1, vec2(1.0 - h.barycentric.x - h.barycentric.y, h.barycentric.x), 3e-6);
}

// Multiplication by a power of two is exact, so that everything scales exactly, from 1e-15 to 1e18.
TEST(AScaledSceneIsHitAlikeToTheBit) {
    Triangle tri = randomTriangle();
    vec3 d = randomDirectionAcross(tri);
    vec3 origin = at(tri, randomInside(-0.1)) - d * randomFloat(0.1, 4.0);
    float scale = exp2(float(int(randomUint() % 111u)) - 50.0);
    TriangleHit h = shoot(tri, origin, d);
    TriangleHit s = shoot(scaled(tri, scale, vec3(0.0)), origin * scale, d);
    EXPECT_EQ(s.hit, h.hit);
    EXPECT_EQ(s.t, h.t * scale);
    EXPECT_EQ(s.barycentric, h.barycentric);
}

// Edge functions have the magnitude of areas: below 1e-15 they approach 2^-126, and devices may flush smaller numbers
// to zero.
TEST(ScalesFrom1eMinus18To1e18) {
    Triangle tri = randomTriangle();
    vec2 b = randomInside(0.05);
    vec3 d = randomDirectionAcross(tri);
    float scale = randomScale(-59.7, 59.7);
    TriangleHit h = shoot(scaled(tri, scale, vec3(0.0)), (at(tri, b) - d * 2.0) * scale, d);
    float allowed = 5e-5 + 16.0 * 1.2e-38 / (scale * scale);
    EXPECT_TRUE(h.hit || allowed > 0.05);
    EXPECT_NEAR(h.t / scale, h.hit ? 2.0 : h.t / scale, allowed);
    EXPECT_NEAR(h.barycentric, h.hit ? b : h.barycentric, allowed);
}

// With two equal corners, the edge functions cancel exactly.
TEST(TrianglesWithEqualCornersAreNeverHit) {
    vec3 p = randomVec3(-1.0, 1.0);
    vec3 q = randomVec3(-1.0, 1.0);
    float s = randomFloat(-0.5, 1.5);
    vec3 origin = randomVec3(-3.0, 3.0);
    vec3 d = normalize(p + (q - p) * s - origin);
    EXPECT_FALSE(shoot(triangleOf(p, p, q), origin, d).hit);
    EXPECT_FALSE(shoot(triangleOf(p, q, p), origin, d).hit);
    EXPECT_FALSE(shoot(triangleOf(q, p, p), origin, d).hit);
    EXPECT_FALSE(shoot(triangleOf(p, p, p), origin, normalize(p - origin)).hit);
}

// The ray passes exactly through an edge that lies along one of the axes of the projection.
TEST(AnEdgeAlongAnAxisBelongsToOneTriangle) {
    vec3 p = vec3(-randomFloat(0.1, 2.0), 0.0, 1.0);
    vec3 q = vec3(randomFloat(0.1, 2.0), 0.0, 1.0);
    vec3 above = vec3(randomFloat(-2.0, 2.0), randomFloat(0.1, 2.0), 1.0);
    vec3 below = vec3(randomFloat(-2.0, 2.0), -randomFloat(0.1, 2.0), 1.0);
    bool turned = (randomUint() & 1u) == 0u;  // with the edge along V
    vec3 axisU = turned ? vec3(0.0, 1.0, 0.0) : vec3(1.0, 0.0, 0.0);
    vec3 axisV = turned ? vec3(-1.0, 0.0, 0.0) : vec3(0.0, 1.0, 0.0);
    uint order = randomUint() % 3u;
    Triangle first = triangleOf(p, q, above);
    if (order == 1u) first = triangleOf(q, above, p);
    if (order == 2u) first = triangleOf(above, p, q);
    Triangle second = (randomUint() & 1u) == 0u ? triangleOf(q, p, below) : triangleOf(p, q, below);
    vec3 z = vec3(0.0, 0.0, 1.0);
    bool hitsFirst = intersectTriangle(first, vec3(0.0), z, axisU, axisV, true).hit;
    bool hitsSecond = intersectTriangle(second, vec3(0.0), z, axisU, axisV, true).hit;
    EXPECT_TRUE(hitsFirst != hitsSecond);
}

// Three collinear corners: no hit if the projection is exact. If it is rounded, the ray may hit the remaining sliver,
// but only on the line.
TEST(TrianglesWithCornersOnALineAreNoSurface) {
    vec3 p = floor(randomVec3(-100.0, 100.0));
    vec3 step = floor(randomVec3(-10.0, 11.0));
    float k = float(int(randomUint() % 9u) - 4);
    Triangle tri = triangleOf(p, p + step, p + k * step);
    int axis = int(randomUint() % 3u);
    vec3 along = vec3(0.0);
    along[axis] = (randomUint() & 1u) == 0u ? 1.0 : -1.0;
    vec3 target = p + floor(randomFloat(-4.0, 5.0)) * step;
    EXPECT_FALSE(shoot(tri, target - 200.0 * along, along).hit);

    vec3 origin = randomVec3(-200.0, 200.0);
    vec3 d = normalize(p + randomFloat(-4.0, 4.0) * step - origin);
    TriangleHit h = shoot(tri, origin, d);
    float a = dot(tri.v0 - origin, d);
    float b = dot(tri.v1 - origin, d);
    float c = dot(tri.v2 - origin, d);
    EXPECT_TRUE(!h.hit || (h.t >= min(a, min(b, c)) - 2e-3 && h.t <= max(a, max(b, c)) + 2e-3));
    vec3 aside = cross(d, step);
    origin += normalize(aside) * randomFloat(0.01, 10.0);
    EXPECT_FALSE(length(aside) > 0.1 && shoot(tri, origin, d).hit);
}

// A ray in the plane of a triangle sees no area, and a ray parallel to the plane does not hit it.
TEST(EdgeOnThereIsNoHit) {
    int axis = int(randomUint() % 3u);
    Triangle tri = randomTriangle();
    tri.v0[axis] = tri.v1[axis] = tri.v2[axis] = 0.25;
    vec3 d = vec3(0.0);
    d[(axis + 1 + int(randomUint() & 1u)) % 3] = (randomUint() & 1u) == 0u ? 1.0 : -1.0;
    vec3 origin = at(tri, randomInside(0.01)) - 3.0 * d;
    EXPECT_FALSE(shoot(tri, origin, d).hit);
    origin[axis] += randomFloat(-1e-3, 1e-3);
    EXPECT_FALSE(shoot(tri, origin, d).hit);
}

// NaN or infinity in a ray or a triangle: no traversal accepts the distance.
TEST(NotANumberAndInfinityAreNoAcceptedHit) {
    Triangle tri = randomTriangle();
    vec3 d = randomDirectionAcross(tri);
    vec3 origin = at(tri, randomInside(-0.2)) - d;
    uint place = randomUint() % 15u;
    uint kind = randomUint() % 4u;
    float bad = uintBitsToFloat((kind < 2u ? 0x7f800000u : 0xff800000u) | ((kind & 1u) << 22u));
    int axis = int(place % 3u);
    if (place < 3u) tri.v0[axis] = bad;
    if (place / 3u == 1u) tri.v1[axis] = bad;
    if (place / 3u == 2u) tri.v2[axis] = bad;
    if (place / 3u == 3u) origin[axis] = bad;
    if (place / 3u == 4u) d[axis] = bad;
    TriangleHit h = shoot(tri, origin, d);
    EXPECT_FALSE(h.hit && h.t > -1e30 && h.t < 1e30);
    // Two at once: opposite infinities.
    tri.v1.x = uintBitsToFloat(0x7f800000u);
    tri.v2.x = uintBitsToFloat(0xff800000u);
    h = shoot(tri, origin, d);
    EXPECT_FALSE(h.hit && h.t > -1e30 && h.t < 1e30);
}

TEST(RaysThatStartOnATriangleMeetItAtZeroWithinPointError) {
    Triangle tri = scaled(randomTriangle(), randomScale(-10.0, 20.0), vec3(0.0));
    vec3 d = randomDirectionAcross(tri);
    vec3 origin = pointOnTriangle(tri, randomInside(0.01));
    TriangleHit h = shoot(tri, origin, d);
    EXPECT_TRUE(h.hit);
    EXPECT_LE(abs(h.t) * abs(dot(d, normalOf(tri))), pointError(tri));
}

// Exact at corners; a weighted mean elsewhere, each corner by its own weight.
TEST(PointsOnATriangleAreWeightedMeansOfCorners) {
    Triangle tri = randomTriangle();
    EXPECT_EQ(pointOnTriangle(tri, vec2(0.0)), tri.v0);
    EXPECT_EQ(pointOnTriangle(tri, vec2(1.0, 0.0)), tri.v1);
    EXPECT_EQ(pointOnTriangle(tri, vec2(0.0, 1.0)), tri.v2);
    vec2 b = randomInside(0.0);
    EXPECT_NEAR(pointOnTriangle(tri, b), tri.v0 + (tri.v1 - tri.v0) * b.x + (tri.v2 - tri.v0) * b.y, 1e-6);
}

// 2^-19 of the largest magnitude of the nine coordinates.
TEST(PointErrorIsSetByTheLargestCoordinate) {
    Triangle tri = randomTriangle();
    uint place = randomUint() % 9u;
    float largest = (randomUint() & 1u) == 0u ? -randomFloat(4.0, 1e6) : randomFloat(4.0, 1e6);
    if (place < 3u) tri.v0[place] = largest;
    if (place / 3u == 1u) tri.v1[place % 3u] = largest;
    if (place / 3u == 2u) tri.v2[place % 3u] = largest;
    EXPECT_EQ(pointError(tri), abs(largest) / 524288.0);
}

TEST(SafeInverseIsTheInverseAwayFromZero) {
    float d = randomScale(-66.0, 66.0) * ((randomUint() & 1u) == 0u ? -1.0 : 1.0);
    EXPECT_ULP(safeInverse(d), 1.0 / d, 3);
    EXPECT_NEAR(safeInverse(d) * d, 1.0, 3e-7);
}

TEST_N(SafeInverseIsLargeAndFiniteAtZero, 1) {
    EXPECT_ULP(safeInverse(0.0), 1e20, 3);
    EXPECT_ULP(safeInverse(-0.0), 1e20, 3);
    EXPECT_ULP(safeInverse(1e-20), 1e20, 3);
    EXPECT_ULP(safeInverse(-1e-20), -1e20, 3);
    EXPECT_ULP(safeInverse(-1e-25), -1e20, 3);
    EXPECT_ULP(safeInverse(1e-25), 1e20, 3);
    EXPECT_ULP(safeInverse(2e-20), 5e19, 3);
    // Denormal numbers may be flushed to 0.
    EXPECT_ULP(abs(safeInverse(uintBitsToFloat(0x80000001u))), 1e20, 3);
    EXPECT_ULP(safeInverse(uintBitsToFloat(0x00000001u)), 1e20, 3);
}

// A random box, and a point inside it, or on a face if a component of `b` is 0 or 1.
struct Box { vec3 lower; vec3 upper; };
Box randomBox() {
    vec3 corner = randomVec3(-1.0, 1.0);
    return Box(corner, corner + randomVec3(0.1, 2.0));
}

TEST(BoxesAreMetThroughAnyPointOfThem) {
    Box box = randomBox();
    vec3 p = mix(box.lower, box.upper, randomVec3(0.001, 0.999));
    int axis = int(randomUint() % 3u);
    if ((randomUint() & 1u) == 0u) p[axis] = (randomUint() & 1u) == 0u ? box.lower[axis] : box.upper[axis];
    vec3 d = randomDirection();
    if ((randomUint() & 3u) == 0u) d[(axis + 1) % 3] = 0.0;
    float t = randomFloat(0.0, 5.0);
    d = normalize(abs(d) + 0.05) * sign(d);  // no component so small that the point's rounding decides
    EXPECT_TRUE(intersectBox(p - d * t, d, -0.001, box.lower, box.upper));
    EXPECT_FALSE(intersectBox(p + d * (t + length(box.upper - box.lower) * 21.0), d, 0.0, box.lower, box.upper));
}

// A ray from inside a box intersects it in every direction; beyond the far side it does not.
TEST(BoxesAreLeftBeyondTheFarSide) {
    Box box = randomBox();
    vec3 p = mix(box.lower, box.upper, randomVec3(0.0, 1.0));
    vec3 d = randomDirection();
    EXPECT_TRUE(intersectBox(p, d, 0.0, box.lower, box.upper));
    vec3 sides = max((box.lower - p) / d, (box.upper - p) / d);
    float far = min(sides.x, min(sides.y, sides.z));
    EXPECT_TRUE(intersectBox(p, d, far * 0.999 - 1e-6, box.lower, box.upper));
    EXPECT_FALSE(intersectBox(p, d, far * 1.001 + 1e-6, box.lower, box.upper));
}

// A ray parallel to an axis hits a box if it is within the other slabs, including their lower ends. (A ray in
// the upper face may miss: 0 times the large inverse of 0 is 0, where it leaves the slab. Builders widen
// boxes.)
TEST(RaysAlongAxesMeetBoxesWithinTheirSlabs) {
    Box box = Box(vec3(-1.0, -2.0, 0.5), vec3(3.0, 0.0, 0.75));
    int axis = int(randomUint() % 3u);
    vec3 p;
    for (int i = 0; i < 3; i++) {
        p[i] = mix(box.lower[i], box.upper[i], (randomUint() & 1u) == 0u ? 0.0 : randomFloat(0.0, 0.99));
    }
    vec3 d = vec3((randomUint() & 1u) == 0u ? 0.0 : -0.0);
    d[axis] = (randomUint() & 1u) == 0u ? 1.0 : -1.0;
    EXPECT_TRUE(intersectBox(p - 10.0 * d, d, 0.0, box.lower, box.upper));
    EXPECT_FALSE(intersectBox(p + 10.0 * d, d, 0.0, box.lower, box.upper));
    int other = (axis + 1 + int(randomUint() & 1u)) % 3;
    p[other] = (randomUint() & 1u) == 0u ? box.lower[other] - 1e-3 : box.upper[other] + 1e-3;
    EXPECT_FALSE(intersectBox(p - 10.0 * d, d, 0.0, box.lower, box.upper));
}

TEST(BoxesAreTouchedAtTMin) {
    vec3 lower = vec3(-1.0, -1.0, 2.0);
    vec3 upper = vec3(1.0, 1.0, 4.0);
    vec3 d = vec3(0.0, 0.0, 1.0);
    EXPECT_TRUE(intersectBox(vec3(0.0), d, 4.0, lower, upper));
    EXPECT_FALSE(intersectBox(vec3(0.0), d, 4.0001, lower, upper));
}

// A negative operand is allowed if the result is not negative; otherwise the result is some negative number.
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

TEST(SumsOfThreeDoNotDependOnTheirOrder) {
    float a = randomScale(-20.0, 0.0) * ((randomUint() & 1u) == 0u ? 1.0 : -1.0);
    float b = randomScale(-20.0, 0.0) * ((randomUint() & 1u) == 0u ? 1.0 : -1.0);
    float c = (randomUint() & 7u) == 0u ? a : -randomScale(-20.0, 0.0);
    float sum = sumOfThree(a, b, c);
    EXPECT_NEAR(sum, a + b + c, 4e-7 * (abs(a) + abs(b) + abs(c)));
    EXPECT_EQ(sumOfThree(b, c, a), sum);
    EXPECT_EQ(sumOfThree(c, a, b), sum);
    EXPECT_EQ(sumOfThree(c, b, a), sum);
    EXPECT_EQ(sumOfThree(a, c, b), sum);
    EXPECT_EQ(sumOfThree(b, a, c), sum);
}

// In memory, the first corner of a triangle depends on its neighbour in the pair.
TEST(ATriangleIsMetAlikeWhicheverCornerComesFirst) {
    float scale = exp2(randomFloat(-20.0, 20.0));
    Triangle tri = scaled(randomTriangle(), scale, randomVec3(-10.0, 10.0) * scale);
    vec3 direction = randomDirectionAcross(tri);
    vec3 origin = at(tri, randomInside(-0.1)) - direction * (scale * randomFloat(0.0, 10.0));
    TriangleHit h = shoot(tri, origin, direction);
    TriangleHit turned = shoot(triangleOf(tri.v1, tri.v2, tri.v0), origin, direction);
    EXPECT_EQ(turned.hit, h.hit);
    EXPECT_EQ(turned.t, h.t);
    EXPECT_EQ(turned.barycentric.x, h.barycentric.y);
    TriangleHit twice = shoot(triangleOf(tri.v2, tri.v0, tri.v1), origin, direction);
    EXPECT_EQ(twice.hit, h.hit);
    EXPECT_EQ(twice.t, h.t);
    EXPECT_EQ(twice.barycentric.y, h.barycentric.x);
    EXPECT_EQ(twice.barycentric.x, turned.barycentric.y);
}

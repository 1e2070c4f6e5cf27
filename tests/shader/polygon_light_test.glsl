// Lambert's formula: properties of the projected solid angle of any triangle.
#include "shaders/lib/polygon_light.glsl"

// A triangle about a point at distance 1, with a size from 0.1 to 7; some are cut by the horizon, some are
// below it.
struct Corners {
    vec3 a;
    vec3 b;
    vec3 c;
    vec3 normal;
};

Corners randomCorners() {
    float size = exp(randomFloat(-2.3, 2.0));
    vec3 centre = randomDirection();
    vec3 a = centre + size * randomDirection();
    vec3 b = centre + size * randomDirection();
    vec3 c = centre + size * randomDirection();
    return Corners(a, b, c, randomDirection());
}

float projected(Corners p) { return projectedSolidAngle(p.a, p.b - p.a, p.c - p.a, p.normal); }

// The sum over up to three triangles, minus a fourth. (A loop, because drivers compile each call slowly.)
float sumLess(Corners parts[3], int count, Corners whole) {
    float sum = 0.0;
    for (int i = 0; i <= count; i++) {
        if (i < count) {
            sum += projected(parts[i]);
        } else {
            sum -= projected(whole);
        }
    }
    return sum;
}

float changed(Corners p, Corners from) { return sumLess(Corners[3](p, p, p), 1, from); }

// For sums of at most six arcs.
const float kTolerance = 3e-6;

TEST(ProjectedSolidAngleIsBetweenNothingAndTheSky) {
    float angle = projected(randomCorners());
    EXPECT_GE(angle, 0.0);
    EXPECT_LE(angle, kPi + 2e-6);
}

TEST(SplittingATriangleAddsUp) {
    Corners p = randomCorners();
    vec3 d = mix(p.a, p.b, randomFloat(0.1, 0.9));
    Corners left = Corners(p.a, d, p.c, p.normal);
    EXPECT_NEAR(sumLess(Corners[3](left, Corners(d, p.b, p.c, p.normal), left), 2, p), 0.0, kTolerance);
}

// Into three, about a point inside.
TEST(SplittingATriangleInThreeAddsUp) {
    Corners p = randomCorners();
    vec2 u = randomVec2();
    u = u.x + u.y > 1.0 ? 1.0 - u : u;
    vec3 d = p.a + u.x * (p.b - p.a) + u.y * (p.c - p.a);
    Corners parts[3] = Corners[3](Corners(p.a, p.b, d, p.normal), Corners(p.b, p.c, d, p.normal),
                                  Corners(p.c, p.a, d, p.normal));
    EXPECT_NEAR(sumLess(parts, 3, p), 0.0, kTolerance);
}

TEST(NeitherWindingNorFirstCornerMatters) {
    Corners p = randomCorners();
    bool turned = testIndex() % 2u == 0u;
    EXPECT_NEAR(changed(turned ? Corners(p.a, p.c, p.b, p.normal) : Corners(p.b, p.c, p.a, p.normal), p), 0.0,
                kTolerance);
}

TEST(RotatingReceiverAndTriangleTogetherChangesNothing) {
    Corners p = randomCorners();
    vec3 x, y;
    vec3 z = randomDirection();
    orthonormalBasis(z, x, y);
    mat3 rotation = mat3(x, y, z);
    EXPECT_NEAR(changed(Corners(rotation * p.a, rotation * p.b, rotation * p.c, rotation * p.normal), p), 0.0,
                kTolerance);
}

// The result depends only on directions, also for an edge from a near to a distant corner that crosses the horizon.
TEST(MovingCornersTowardsTheReceiverAndAwayChangesNothing) {
    Corners p = randomCorners();
    vec3 s = vec3(randomScale(-12.0, 12.0), randomScale(-12.0, 12.0), randomScale(-12.0, 12.0));
    EXPECT_NEAR(changed(Corners(s.x * p.a, s.y * p.b, s.z * p.c, p.normal), p), 0.0, kTolerance);
}

// The signed sum over the edges of a whole triangle is the part above the horizon minus the part below.
TEST(BothSidesOfTheHorizonMakeTheWholeTriangle) {
    Corners p = randomCorners();
    vec3 heights = vec3(dot(p.a, p.normal), dot(p.b, p.normal), dot(p.c, p.normal));
    float upper = 0.0;
    float lower = 0.0;
    float whole = 0.0;
    for (int i = 0; i < 2; i++) {
        float side = projected(Corners(p.a, p.b, p.c, i == 0 ? p.normal : -p.normal));
        upper = i == 0 ? side : upper;
        lower = i == 1 ? side : lower;
    }
    for (int i = 0; i < 3; i++) {
        vec3 from = i == 0 ? p.a : (i == 1 ? p.b : p.c);
        whole += edgeIntegral(from, i == 0 ? p.b : (i == 1 ? p.c : p.a), p.normal);
    }
    EXPECT_NEAR(abs(0.5 * whole), abs(upper - lower), kTolerance);
    EXPECT_TRUE(all(greaterThan(heights, vec3(0.0))) ? lower == 0.0 : true);
    EXPECT_TRUE(all(lessThanEqual(heights, vec3(0.0))) ? upper == 0.0 : true);
}

// The faces of an octahedron around the receiver, in any orientation: its upper half covers the whole sky.
TEST(FacesAllAroundMakeTheWholeSky) {
    vec3 x, y;
    vec3 z = randomDirection();
    orthonormalBasis(z, x, y);
    vec3 normal = randomDirection();
    float sky = 0.0;
    for (uint octant = 0u; octant < 8u; octant++) {
        vec3 a = (octant & 1u) != 0u ? x : -x;
        vec3 b = (octant & 2u) != 0u ? y : -y;
        vec3 c = (octant & 4u) != 0u ? z : -z;
        sky += projectedSolidAngle(a, b - a, c - a, normal);
    }
    EXPECT_NEAR(sky, kPi, 6e-6);
}

// One octant with a corner overhead: a quarter of the sky.
TEST_N(OctantIsAQuarterOfTheSky, 1) {
    EXPECT_NEAR(projected(Corners(vec3(1, 0, 0), vec3(0, 1, 0), vec3(0, 0, 1), vec3(0, 0, 1))), 0.25 * kPi, 1e-6);
}

TEST(EdgeTurnsItsSignWithItsDirectionAndTheNormal) {
    vec3 a = randomDirection() * randomScale(-4.0, 4.0);
    vec3 b = randomDirection() * randomScale(-4.0, 4.0);
    vec3 normal = randomDirection();
    float edge = edgeIntegral(a, b, normal);
    EXPECT_NEAR(edgeIntegral(b, a, normal), -edge, 1e-6);
    EXPECT_EQ(edgeIntegral(a, b, -normal), -edge);
}

// A quarter circle about its axis, and about an axis in its plane; 135 degrees. Then an edge between points
// in the same direction, and an edge from the receiver itself: they span no plane, so the integral is 0.
TEST_N(EdgesByHand, 5) {
    vec3 from[5] = vec3[5](vec3(2, 0, 0), vec3(2, 0, 0), vec3(2, 0, 0), vec3(1, 2, 3), vec3(0, 0, 0));
    vec3 to[5] = vec3[5](vec3(0, 3, 0), vec3(0, 3, 0), vec3(-1, 1, 0), vec3(2, 4, 6), vec3(2, 4, 6));
    float expected[5] = float[5](0.5 * kPi, 0.0, 0.75 * kPi, 0.0, 0.0);
    uint i = testIndex();
    EXPECT_NEAR(edgeIntegral(from[i], to[i], i == 1u ? vec3(1, 0, 0) : vec3(0, 0, 1)), expected[i], 3e-7);
}

TEST(HorizonPointIsOnTheEdgeAndOnTheHorizon) {
    vec3 normal = randomDirection();
    vec3 a = randomVec3(-1.0, 1.0);
    vec3 b = randomVec3(-1.0, 1.0);
    float da = dot(a, normal);
    float db = dot(b, normal);
    // The ends are on different sides of the horizon, and not near it.
    a += normal * (0.1 + abs(da) - da);
    b -= normal * (0.1 + abs(db) + db);
    vec3 h = horizonPoint(a, b, dot(a, normal), dot(b, normal));
    EXPECT_NEAR(dot(h, normal), 0.0, 1e-6);
    EXPECT_NEAR(length(h - a) + length(h - b), length(b - a), 2e-6);
}

TEST_N(AnglesByHand, 7) {
    vec2 ratio[7] = vec2[7](vec2(0, 1), vec2(0, 0), vec2(0, -1), vec2(1, 0), vec2(1, 1), vec2(1, -1),
                            vec2(1, sqrt(3.0)));
    float expected[7] = float[7](0.0, 0.0, kPi, 0.5 * kPi, 0.25 * kPi, 0.75 * kPi, kPi / 6.0);
    uint i = testIndex();
    EXPECT_NEAR(angleOf(ratio[i].x, ratio[i].y), expected[i], 3e-7);
}

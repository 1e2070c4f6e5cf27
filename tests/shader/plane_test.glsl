// Planes of triangles, for surfaces that coincide and for large triangles.
#include "shaders/lib/plane.glsl"

vec4 stored;
uvec4 fetchPlaneTexel(uint index) { return floatBitsToUint(stored + float(int(index))); }

Plane planeThrough(vec3 normal, vec3 point) { return Plane(normal, dot(normal, point)); }

TEST(PlanesAreFetchedFromTheirTexels) {
    stored = vec4(randomVec3(-1.0, 1.0), randomFloat());
    uint index = randomUint() & 7u;
    Plane plane = fetchPlane(index);
    EXPECT_EQ(vec4(plane.normal, plane.offset), stored + float(int(index)));
}

TEST(DistanceLeadsToThePlane) {
    vec3 normal = randomDirection();
    vec3 point = randomVec3(-1.0, 1.0);
    Plane plane = planeThrough(normal, point);
    vec3 d = randomDirection();
    if (abs(dot(d, normal)) < 0.05) d = normal;
    vec3 origin = randomVec3(-4.0, 4.0);
    float t = planeDistance(plane, origin, d);
    EXPECT_NEAR(dot(origin + t * d - point, normal), 0.0, 4e-6 + 4e-7 * abs(t));
}

// Bitwise identical, so that both windings of a face have the same distance.
TEST(DistanceDoesNotDependOnTheOrientation) {
    Plane plane = planeThrough(randomDirection(), randomVec3(-9.0, 9.0));
    vec3 origin = randomVec3(-4.0, 4.0);
    vec3 d = randomDirection();
    EXPECT_EQ(floatBitsToUint(planeDistance(Plane(-plane.normal, -plane.offset), origin, d)),
              floatBitsToUint(planeDistance(plane, origin, d)));
}

// For all sizes, and far from the plane's point nearest to the origin: the remaining distance, also by
// planeDistance, is within the bound, which is a few roundings of the point's coordinates.
TEST(PointsPutOntoThePlaneAreWithinTheirError) {
    float size = randomScale(-20.0, 20.0);
    vec3 normal = randomDirection();
    Plane plane = Plane(normal, size * randomFloat(-2.0, 2.0));
    vec3 point = size * randomVec3(-8.0, 8.0);
    vec3 on = ontoPlane(plane, ontoPlane(plane, point));
    float error = planeError(plane, on);
    EXPECT_LE(abs(dot(plane.normal, on) - plane.offset), 0.5 * error);
    EXPECT_LE(error, 1e-5 * (length(on) + abs(plane.offset)));
    vec3 beside = on + normal * error;
    vec3 d = randomDirection();
    d = dot(d, normal) < 0.0 ? -d : d;
    if (dot(d, normal) > 0.01) EXPECT_LT(planeDistance(plane, beside, d), 0.0);
    if (dot(d, normal) > 0.01) EXPECT_GT(planeDistance(plane, on - normal * error, d), 0.0);
}

TEST(FrontsComeFirstAndBacksInReverse) {
    uint a = randomUint() >> 1u;
    uint b = randomUint() >> 1u;
    EXPECT_EQ(orderOfSurface(a, true) < orderOfSurface(b, false), true);
    EXPECT_EQ(orderOfSurface(a, true) < orderOfSurface(b, true), a < b);
    EXPECT_EQ(orderOfSurface(a, false) < orderOfSurface(b, false), b < a);
}

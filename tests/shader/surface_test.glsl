// A point on a surface, its normals, and directions in its frame.
#include "shaders/lib/frame.glsl"
#include "shaders/lib/surface.glsl"
#include "tests/shader/frame_inputs.glsl"

uvec4 texel;
uint fetchedIndex;

uvec4 planeTexel;
uvec4 pairTexel;
uvec4 fetchPlaneTexel(uint index) { return planeTexel; }
uvec4 fetchPairTexel(uint index) { return pairTexel; }

uvec4 fetchCornerTexel(uint index) { return uvec4(0u); }
uvec4 fetchVertexTexel(uint index) { return uvec4(0u); }
uvec4 fetchSecondUvTexel(uint index) { return uvec4(0u); }
uvec4 fetchNormalTexel(uint index) {
    fetchedIndex = index;
    return texel;
}

// Normals at the corners that are up to 90 degrees from z, or with sign -1 from -z.
void setCorners(float sign) {
    for (int i = 0; i < 3; i++) {
        vec2 e = vec2(randomFloat(-0.45, 0.45), randomFloat(-0.45, 0.45));
        vec2 signs = vec2(e.x >= 0.0 ? 1.0 : -1.0, e.y >= 0.0 ? 1.0 : -1.0);
        if (sign < 0.0) e = (1.0 - abs(e.yx)) * signs;
        texel[i] = packSnorm2x16(e);
    }
    texel.w = randomUint();
}

vec2 randomBarycentric() {
    vec2 u = randomVec2();
    return u.x + u.y > 1.0 ? 1.0 - u : u;
}

Triangle randomTriangle(uint flags) {
    vec3 a = randomVec3(-1.0, 1.0);
    vec3 b = randomVec3(-1.0, 1.0);
    return Triangle(a, b, randomVec3(-1.0, 1.0), randomUint(), flags);
}

// A triangle in the plane z = 0 that faces up.
Triangle flatTriangle(uint flags) {
    return Triangle(vec3(-1.0, -1.0, 0.0), vec3(3.0, -1.0, 0.0), vec3(-1.0, 3.0, 0.0), 0u, flags);
}

// The point is on the side from which the ray comes, even at grazing angles.
TEST(GeometricNormalIsOnTheRaysSide) {
    float side = (randomUint() & 1u) == 0u ? 1.0 : -1.0;
    vec3 ray = normalize(vec3(randomFloat(-1.0, 1.0), 1.0, 0.0));
    ray.z = -side * (testIndex() % 4u == 0u ? randomFloat(0.1, 1.0) : randomScale(-100.0, -1.0));
    SurfacePoint point = surfacePoint(flatTriangle(0u), 0u, vec2(0.25), vec3(0.0, 0.0, 1.0), ray, true);
    EXPECT_EQ(point.geometricNormal, vec3(0.0, 0.0, side));
    EXPECT_EQ(point.shadingNormal, point.geometricNormal);
    EXPECT_GT(point.position.z * side, 0.0);
}

TEST(PositionIsMovedOffByItsError) {
    Triangle tri = randomTriangle(0u);
    vec2 b = randomBarycentric();
    vec3 normal = normalize(cross(tri.v1 - tri.v0, tri.v2 - tri.v0));
    vec3 ray = randomDirection();
    SurfacePoint point = surfacePoint(tri, 0u, b, normal, ray, false);
    vec3 expected = pointOnTriangle(tri, b) + pointError(tri) * (dot(ray, normal) < 0.0 ? normal : -normal);
    EXPECT_NEAR(point.position, expected, 1.2e-7);
}

// Only if the triangle has smooth normals, and the caller asks for them.
TEST(SmoothNormalsAreUsedOnlyIfFlagged) {
    setCorners(1.0);
    vec3 ray = vec3(0.3, 0.2, -1.0);
    vec3 normal = vec3(0.0, 0.0, 1.0);
    vec2 b = randomBarycentric();
    uint triangle = randomUint() & 0xffffffu;
    uint material = randomUint() & kMaterialMask;
    vec3 smoothed = shadingNormal(triangle, b);
    Triangle flagged = flatTriangle(kTriangleSmooth | material);
    EXPECT_EQ(surfacePoint(flatTriangle(material), triangle, b, normal, ray, true).shadingNormal, normal);
    EXPECT_EQ(surfacePoint(flagged, triangle, b, normal, ray, false).shadingNormal, normal);
    fetchedIndex = 0u;
    EXPECT_NEAR(surfacePoint(flagged, triangle, b, normal, ray, true).shadingNormal, smoothed, 2e-7);
    EXPECT_EQ(fetchedIndex, triangle * kNormalTexels);
    EXPECT_EQ(surfacePoint(flagged, triangle, b, normal, ray, true).geometricNormal, normal);
}

// Both normals are on the ray's side, for both sides of the ray and of the corners' normals.
TEST(BothNormalsAreOnOneSide) {
    float side = (randomUint() & 1u) == 0u ? 1.0 : -1.0;
    float corners = (randomUint() & 1u) == 0u ? 1.0 : -1.0;
    setCorners(corners);
    vec3 ray = vec3(randomFloat(-1.0, 1.0), randomFloat(-1.0, 1.0), -side * randomFloat(0.01, 1.0));
    vec2 b = randomBarycentric();
    vec3 smoothed = shadingNormal(0u, b);
    SurfacePoint point = surfacePoint(flatTriangle(kTriangleSmooth), 0u, b, vec3(0.0, 0.0, 1.0), ray, true);
    EXPECT_EQ(point.geometricNormal, vec3(0.0, 0.0, side));
    EXPECT_GT(point.shadingNormal.z * side, 0.0);
    EXPECT_NEAR(point.shadingNormal, smoothed * (side * corners), 2e-7);
}

// A ray along the surface, or so nearly that products underflow, has no side; the normals still agree on one.
TEST(BothNormalsAreOnOneSideOfAGrazingRay) {
    setCorners((randomUint() & 1u) == 0u ? 1.0 : -1.0);
    float tiny = (randomUint() & 1u) == 0u ? 0.0 : randomScale(-126.0, -120.0);
    vec3 ray = vec3(1.0, 0.0, (randomUint() & 1u) == 0u ? tiny : -tiny);
    Triangle tri = flatTriangle(kTriangleSmooth);
    SurfacePoint point = surfacePoint(tri, 0u, randomBarycentric(), vec3(0.0, 0.0, 1.0), ray, true);
    EXPECT_EQ(abs(point.geometricNormal), vec3(0.0, 0.0, 1.0));
    EXPECT_GT(dot(point.shadingNormal, point.geometricNormal), 0.0);
    EXPECT_GT(point.position.z * point.geometricNormal.z, 0.0);
}

SurfacePoint pointWithNormals(vec3 geometric, vec3 shading) {
    return SurfacePoint(vec3(0.0), geometric, shading, 0u, 0u, 0.0);
}

// Normals 60 degrees apart: cosines are 1, 1/2, and 0 at 90 degrees from either.
TEST_N(AdjointKnownAnswers, 1) {
    vec3 z = vec3(0.0, 0.0, 1.0);
    vec3 tilted = vec3(0.8660254, 0.0, 0.5);
    SurfacePoint point = pointWithNormals(z, tilted);
    EXPECT_NEAR(shadingAdjoint(point, z), 0.5, 1e-6);
    EXPECT_NEAR(shadingAdjoint(point, tilted), 2.0, 1e-6);
    EXPECT_NEAR(shadingAdjoint(point, vec3(0.0, 0.6, 0.8)), 0.5, 1e-6);
    // Above the horizon of only one of the normals, of neither, or on the horizon of one or both.
    EXPECT_EQ(shadingAdjoint(point, vec3(-0.8, 0.0, 0.6)), 0.0);
    EXPECT_EQ(shadingAdjoint(point, vec3(0.96, 0.0, -0.28)), 0.0);
    EXPECT_EQ(shadingAdjoint(point, -z), 0.0);
    EXPECT_EQ(shadingAdjoint(point, vec3(1.0, 0.0, 0.0)), 0.0);
    EXPECT_EQ(shadingAdjoint(point, vec3(0.0, 1.0, 0.0)), 0.0);
    EXPECT_EQ(shadingAdjoint(pointWithNormals(z, vec3(1.0, 0.0, 0.0)), vec3(0.0, 0.6, 0.8)), 0.0);
    EXPECT_EQ(shadingAdjoint(pointWithNormals(z, z), vec3(0.0, 0.6, 0.8)), 1.0);
}

// |wi . Ns| / |wi . Ng| if both normals see wi, else 0 (Veach 1997, section 5.3): times f and the geometric
// cosine, it is what the path tracer computes: f times the shading cosine.
TEST(AdjointIsItsDefinition) {
    vec3 geometric = randomDirection();
    vec3 shading = normalize(geometric + 0.9 * randomDirection());
    vec3 wi = randomDirection();
    float cosGeometric = dot(geometric, wi);
    float cosShading = dot(shading, wi);
    float adjoint = shadingAdjoint(pointWithNormals(geometric, shading), wi);
    bool seen = min(cosGeometric, cosShading) > 1e-6;
    EXPECT_NEAR(adjoint * cosGeometric, seen ? cosShading : 0.0, 1.1e-6);
    EXPECT_GE(adjoint, 0.0);
    EXPECT_EQ(shadingAdjoint(pointWithNormals(geometric, geometric), wi), cosGeometric > 0.0 ? 1.0 : 0.0);
}

void expectFrame(vec3 n) {
    vec3 a = randomDirection();
    vec3 b = randomDirection();
    vec3 t, s;
    orthonormalBasis(n, t, s);
    EXPECT_NEAR(toFrame(n, n), vec3(0.0, 0.0, 1.0), 6e-7);
    EXPECT_NEAR(toFrame(n, t), vec3(1.0, 0.0, 0.0), 6e-7);
    EXPECT_NEAR(toFrame(n, s), vec3(0.0, 1.0, 0.0), 6e-7);
    EXPECT_NEAR(fromFrame(n, vec3(0.0, 0.0, 1.0)), n, 6e-7);
    EXPECT_NEAR(fromFrame(n, toFrame(n, a)), a, 8e-7);
    EXPECT_NEAR(toFrame(n, fromFrame(n, a)), a, 8e-7);
    EXPECT_NEAR(dot(toFrame(n, a), toFrame(n, b)), dot(a, b), 8e-7);
    EXPECT_NEAR(cross(toFrame(n, a), toFrame(n, b)), toFrame(n, cross(a, b)), 8e-7);
}

TEST_N(FramesAreThereAndBack, 8192) { expectFrame((testIndex() & 1u) == 0u ? randomDirection() : hardNormal()); }

// A direction transformed from a frame is unit, despite accumulated rounding errors of the inputs.
TEST(FromFrameIsUnit) {
    vec3 w = randomDirection() * randomFloat(0.5, 2.0);
    EXPECT_NEAR(length(fromFrame(hardNormal(), w)), 1.0, 3e-7);
}

// Without stored planes, points do not move, and rays that leave them start there.
TEST(WithoutPlanesNothingIsMoved) {
    SurfacePoint point = pointWithNormals(randomDirection(), randomDirection());
    point.position = randomVec3(-1.0, 1.0);
    SurfacePoint placed = placedByPlane(point, randomVec3(-1.0, 1.0), true);
    EXPECT_EQ(placed.position, point.position);
    vec3 direction = randomDirection();
    Segment segment = leaveSurface(placed, direction, false);
    EXPECT_EQ(segment.origin, point.position);
    EXPECT_EQ(segment.direction, direction);
    EXPECT_EQ(segment.t, 0.0);
    EXPECT_EQ(segment.order, kNoTriangle);
}

// A ray starts on the side to which it leaves, at the distance of the point's error bound.
TEST(RayLeavesOnItsOwnSide) {
    Triangle tri = randomTriangle(0u);
    vec2 b = randomBarycentric();
    vec3 normal = normalize(cross(tri.v1 - tri.v0, tri.v2 - tri.v0));
    SurfacePoint point = surfacePoint(tri, 0u, b, normal, randomDirection(), false);
    vec3 direction = randomDirection();
    float side = dot(point.geometricNormal, direction) < 0.0 ? -1.0 : 1.0;
    vec3 expected = pointOnTriangle(tri, b) + side * pointError(tri) * point.geometricNormal;
    EXPECT_NEAR(leaveSurface(point, direction, side < 0.0).origin, expected, 2e-7);
}

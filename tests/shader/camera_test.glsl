// The camera of light paths is that of camera rays, wherever it is.
#include "shaders/lib/camera.glsl"

// Somewhere, in any position; a focal length and a shape of its own. Right, up and backwards are right-handed.
PathParams randomCamera() {
    PathParams params;
    params.cameraPosition = randomVec3(-2.0, 2.0);
    params.cameraForward = randomDirection();
    vec3 other = abs(params.cameraForward.x) < 0.6 ? vec3(1.0, 0.0, 0.0) : vec3(0.0, 1.0, 0.0);
    vec3 right = normalize(cross(params.cameraForward, normalize(other + 0.5 * randomDirection())));
    params.width = 1u + randomUint() % 300u;
    params.height = 1u + randomUint() % 300u;
    float halfHeight = randomScale(-2.0, 1.0);
    float aspect = float(params.width) / float(params.height);
    params.cameraRight = right * (halfHeight * aspect);
    params.cameraUp = cross(right, params.cameraForward) * halfHeight;
    params.imageArea = 4.0 * halfHeight * halfHeight * aspect;
    // Rays begin at the camera, or ahead of it.
    params.cameraStartDepth = testIndex() % 2u == 0u ? 0.0 : 0.05;
    params.cameraStart = params.cameraPosition + params.cameraForward * params.cameraStartDepth;
    return params;
}

vec3 cameraDirection(PathParams params, vec2 position) { return cameraRay(params, position).direction; }

vec2 imageSize(PathParams params) { return vec2(params.width, params.height); }

// Rows count from the top: at the corners the ray's slopes are those of the edges of the image plane.
TEST(RaysThroughTheCornersSpanTheImagePlane) {
    PathParams params = randomCamera();
    vec2 corner = vec2(testIndex() & 1u, (testIndex() >> 1u) & 1u);
    vec3 d = cameraDirection(params, corner * imageSize(params));
    vec3 onPlane = d / dot(d, params.cameraForward);
    vec3 expected = params.cameraForward + (2.0 * corner.x - 1.0) * params.cameraRight +
                    (1.0 - 2.0 * corner.y) * params.cameraUp;
    EXPECT_NEAR(onPlane, expected, 4e-6 * dot(expected, expected));
}

TEST(RayThroughTheCentreGoesForward) {
    PathParams params = randomCamera();
    EXPECT_NEAR(cameraDirection(params, 0.5 * imageSize(params)), params.cameraForward, 4e-7);
}

TEST(RaysBeginOnTheirWayFromTheCamera) {
    PathParams params = randomCamera();
    CameraRay ray = cameraRay(params, randomVec2() * imageSize(params));
    float depth = params.cameraStartDepth;
    EXPECT_NEAR(ray.origin, params.cameraPosition + ray.direction * (depth / dot(ray.direction, params.cameraForward)), 1e-5);
}

TEST(RaysAreUnit) {
    PathParams params = randomCamera();
    EXPECT_NEAR(length(cameraDirection(params, randomVec2() * imageSize(params))), 1.0, 3e-7);
}

// A point on the ray through a pixel is seen in that pixel. Not within a hundredth of its edge, for single precision
// cannot tell on which side of it a point is.
TEST(PointOnARayIsSeenWhereTheRayCameFrom) {
    PathParams params = randomCamera();
    uvec2 cell = uvec2(randomUint() % params.width, randomUint() % params.height);
    vec3 direction = cameraDirection(params, vec2(cell) + mix(vec2(0.01), vec2(0.99), randomVec2()));
    float distance = randomScale(-2.0, 6.0);
    CameraConnection seen = connectToCamera(params, params.cameraPosition + direction * distance);
    float cosine = dot(direction, params.cameraForward);
    EXPECT_EQ(uvec2(seen.visible, seen.pixel), uvec2(1u, cell.y * params.width + cell.x));
    EXPECT_NEAR(seen.direction, -direction, 4e-6);
    EXPECT_NEAR(seen.distance / distance, 1.0, 4e-6);
    EXPECT_NEAR(seen.importance * params.imageArea * cosine * cosine * cosine, 1.0, 4e-5);
}

// Beyond each of the four edges, and behind: the same points mirrored at the camera.
TEST(NothingIsSeenBesideTheImageOrBehind) {
    PathParams params = randomCamera();
    vec2 inside = randomVec2();
    float beyond = randomScale(-6.0, 6.0);
    vec2 beside[4] = vec2[4](vec2(-beyond, inside.y), vec2(1.0 + beyond, inside.y), vec2(inside.x, -beyond),
                             vec2(inside.x, 1.0 + beyond));
    bool behind = testIndex() % 5u == 4u;
    vec2 position = (behind ? inside : beside[testIndex() % 5u % 4u]) * imageSize(params);
    vec3 direction = cameraDirection(params, position) * (behind ? -1.0 : 1.0);
    CameraConnection seen = connectToCamera(params, params.cameraPosition + direction * randomScale(-2.0, 6.0));
    EXPECT_FALSE(seen.visible);
}

// A camera at the origin that looks along -z, four by two pixels, without rounding: edges belong to the image at the
// left and the top, and to nothing at the right and the bottom.
PathParams plainCamera() {
    PathParams params;
    params.cameraPosition = vec3(0.0);
    params.cameraForward = vec3(0.0, 0.0, -1.0);
    params.cameraRight = vec3(2.0, 0.0, 0.0);
    params.cameraUp = vec3(0.0, 1.0, 0.0);
    params.width = 4u;
    params.height = 2u;
    params.imageArea = 8.0;
    params.cameraStart = vec3(0.0);
    params.cameraStartDepth = 0.0;
    return params;
}

TEST_N(EdgesOfPixelsByHand, 10) {
    vec3 point[10] = vec3[10](vec3(-2, 1, -1), vec3(2, 1, -1), vec3(-2, -1, -1), vec3(0, 0, -1), vec3(-1, 0, -1),
                              vec3(1.5, 0.5, -1), vec3(3, -1, -2), vec3(0, 0, 0), vec3(1, 1, 0), vec3(0, 0, 1));
    // Top left corner; beyond the right; below the bottom; the middle belongs to the third pixel of the second row.
    bool visible[10] = bool[10](true, false, false, true, true, true, true, false, false, false);
    uint pixel[10] = uint[10](0u, 0u, 0u, 6u, 5u, 3u, 7u, 0u, 0u, 0u);
    CameraConnection seen = connectToCamera(plainCamera(), point[testIndex()]);
    EXPECT_EQ(uvec2(seen.visible, seen.pixel), uvec2(visible[testIndex()], pixel[testIndex()]));
}

TEST_N(ImportanceByHand, 1) {
    CameraConnection ahead = connectToCamera(plainCamera(), vec3(0, 0, -5));
    EXPECT_EQ(vec2(ahead.importance, ahead.distance), vec2(0.125, 5.0));
    EXPECT_EQ(ahead.direction, vec3(0, 0, 1));
    // At 60 degrees cos^3 is an eighth.
    CameraConnection aside = connectToCamera(plainCamera(), vec3(sqrt(3.0), 0, -1));
    EXPECT_NEAR(aside.importance, 1.0, 1e-6);
}

// Connections to the camera are consistent with camera rays, for every position of the camera.
#include "shaders/lib/camera.glsl"

// Random position, orientation, focal length and aspect. Right, up and backwards are right-handed.
DeviceCamera randomCamera() {
    DeviceCamera camera;
    camera.position = randomVec3(-2.0, 2.0);
    camera.forward = randomDirection();
    vec3 other = abs(camera.forward.x) < 0.6 ? vec3(1.0, 0.0, 0.0) : vec3(0.0, 1.0, 0.0);
    vec3 right = normalize(cross(camera.forward, normalize(other + 0.5 * randomDirection())));
    camera.width = 1u + randomUint() % 300u;
    camera.height = 1u + randomUint() % 300u;
    float halfHeight = randomScale(-2.0, 1.0);
    float aspect = float(camera.width) / float(camera.height);
    camera.right = right * (halfHeight * aspect);
    camera.up = cross(right, camera.forward) * halfHeight;
    camera.area = 4.0 * halfHeight * halfHeight * aspect;
    // Rays start at the camera, or in front of it.
    camera.startDepth = testIndex() % 2u == 0u ? 0.0 : 0.05;
    camera.start = camera.position + camera.forward * camera.startDepth;
    return camera;
}

vec3 cameraDirection(DeviceCamera camera, vec2 position) { return cameraRay(camera, position).direction; }

vec2 imageSize(DeviceCamera camera) { return vec2(camera.width, camera.height); }

// Rows count from the top: at the corners, the ray's slopes are those of the edges of the image plane.
TEST(RaysThroughTheCornersSpanTheImagePlane) {
    DeviceCamera camera = randomCamera();
    vec2 corner = vec2(testIndex() & 1u, (testIndex() >> 1u) & 1u);
    vec3 d = cameraDirection(camera, corner * imageSize(camera));
    vec3 onPlane = d / dot(d, camera.forward);
    vec3 expected = camera.forward + (2.0 * corner.x - 1.0) * camera.right +
                    (1.0 - 2.0 * corner.y) * camera.up;
    EXPECT_NEAR(onPlane, expected, 4e-6 * dot(expected, expected));
}

TEST(PixelsAreNumberedRowByRow) {
    DeviceCamera camera = randomCamera();
    uvec2 place = uvec2(randomUint() % camera.width, randomUint() % camera.height);
    EXPECT_EQ(pixelCorner(camera, place.y * camera.width + place.x), vec2(place));
}

TEST(RayThroughTheCentreGoesForward) {
    DeviceCamera camera = randomCamera();
    EXPECT_NEAR(cameraDirection(camera, 0.5 * imageSize(camera)), camera.forward, 4e-7);
}

TEST(RaysBeginOnTheirWayFromTheCamera) {
    DeviceCamera camera = randomCamera();
    CameraRay ray = cameraRay(camera, randomVec2() * imageSize(camera));
    float depth = camera.startDepth;
    float cosine = dot(ray.direction, camera.forward);  // as small as 1/600
    EXPECT_NEAR(ray.origin, camera.position + ray.direction * (depth / cosine),
                1e-6 + 1e-7 * depth / (cosine * cosine));
}

TEST(RaysAreUnit) {
    DeviceCamera camera = randomCamera();
    EXPECT_NEAR(length(cameraDirection(camera, randomVec2() * imageSize(camera))), 1.0, 3e-7);
}

// A point on the ray through a pixel is seen in that pixel. Keeps a hundredth of a pixel away from the edges,
// where single precision cannot tell on which side a point is.
TEST(PointOnARayIsSeenWhereTheRayCameFrom) {
    DeviceCamera camera = randomCamera();
    uvec2 cell = uvec2(randomUint() % camera.width, randomUint() % camera.height);
    vec3 direction = cameraDirection(camera, vec2(cell) + mix(vec2(0.01), vec2(0.99), randomVec2()));
    float distance = randomScale(-2.0, 6.0);
    CameraConnection seen = connectToCamera(camera, camera.position + direction * distance);
    float cosine = dot(direction, camera.forward);
    EXPECT_EQ(uvec2(seen.visible, seen.pixel), uvec2(1u, cell.y * camera.width + cell.x));
    EXPECT_NEAR(seen.direction, -direction, 4e-6);
    EXPECT_NEAR(seen.distance / distance, 1.0, 4e-6);
    EXPECT_NEAR(seen.importance * camera.area * cosine * cosine * cosine * distance * distance, 1.0, 2e-6 / cosine);
}

// A position beyond one of the four edges, by at least 2^smallest times the image's size.
vec2 besideImage(uint edge, float smallest) {
    vec2 inside = randomVec2();
    float beyond = randomScale(smallest, 6.0);
    if (edge == 0u) return vec2(-beyond, inside.y);
    if (edge == 1u) return vec2(1.0 + beyond, inside.y);
    return vec2(inside.x, edge == 2u ? -beyond : 1.0 + beyond);
}

// Points beyond each of the four edges, and points of the image mirrored to behind the camera.
TEST(NothingIsSeenBesideTheImageOrBehind) {
    DeviceCamera camera = randomCamera();
    bool behind = testIndex() % 5u == 4u;
    vec2 position = (behind ? randomVec2() : besideImage(testIndex() % 5u, -6.0)) * imageSize(camera);
    vec3 direction = cameraDirection(camera, position) * (behind ? -1.0 : 1.0);
    CameraConnection seen = connectToCamera(camera, camera.position + direction * randomScale(-2.0, 6.0));
    EXPECT_FALSE(seen.visible);
}

// A camera at the origin that looks along -z, with 4 x 2 pixels and no rounding. The image includes its left
// and top edges, but not its right and bottom edges.
DeviceCamera plainCamera() {
    DeviceCamera camera;
    camera.position = vec3(0.0);
    camera.forward = vec3(0.0, 0.0, -1.0);
    camera.right = vec3(2.0, 0.0, 0.0);
    camera.up = vec3(0.0, 1.0, 0.0);
    camera.width = 4u;
    camera.height = 2u;
    camera.area = 8.0;
    camera.start = vec3(0.0);
    camera.startDepth = 0.0;
    return camera;
}

TEST_N(EdgesOfPixelsByHand, 10) {
    vec3 point[10] = vec3[10](vec3(-2, 1, -1), vec3(2, 1, -1), vec3(-2, -1, -1), vec3(0, 0, -1), vec3(-1, 0, -1),
                              vec3(1.5, 0.5, -1), vec3(3, -1, -2), vec3(0, 0, 0), vec3(1, 1, 0), vec3(0, 0, 1));
    // Top left corner; right edge; bottom edge; the centre belongs to the third pixel of the second row.
    bool visible[10] = bool[10](true, false, false, true, true, true, true, false, false, false);
    uint pixel[10] = uint[10](0u, 0u, 0u, 6u, 5u, 3u, 7u, 0u, 0u, 0u);
    CameraConnection seen = connectToCamera(plainCamera(), point[testIndex()]);
    EXPECT_EQ(uvec2(seen.visible, seen.pixel), uvec2(visible[testIndex()], pixel[testIndex()]));
}

TEST_N(ImportanceByHand, 1) {
    CameraConnection ahead = connectToCamera(plainCamera(), vec3(0, 0, -5));
    EXPECT_EQ(ahead.distance, 5.0);
    EXPECT_NEAR(ahead.importance * 25.0, 0.125, 1e-8);
    EXPECT_EQ(ahead.direction, vec3(0, 0, 1));
    // At 60 degrees cos^3 is an eighth.
    CameraConnection aside = connectToCamera(plainCamera(), vec3(sqrt(3.0), 0, -1));
    EXPECT_NEAR(aside.importance * 4.0, 1.0, 1e-6);
}

TEST(OrthographicRaysAreParallelAndSpanTheImagePlane) {
    DeviceCamera camera = randomCamera();
    vec2 position = randomVec2();
    CameraRay ray = orthographicRay(camera, position * imageSize(camera));
    EXPECT_EQ(ray.direction, camera.forward);
    vec3 expected = camera.start + (2.0 * position.x - 1.0) * camera.right + (1.0 - 2.0 * position.y) * camera.up;
    EXPECT_NEAR(ray.origin, expected, 2e-6 * (4.0 + length(camera.right) + length(camera.up)));
}

TEST(PointOnAnOrthographicRayIsSeenWhereTheRayCameFrom) {
    DeviceCamera camera = randomCamera();
    uvec2 cell = uvec2(randomUint() % camera.width, randomUint() % camera.height);
    CameraRay ray = orthographicRay(camera, vec2(cell) + mix(vec2(0.05), vec2(0.95), randomVec2()));
    float distance = randomScale(-2.0, 2.0);
    CameraConnection seen = connectToOrthographic(camera, ray.origin + ray.direction * distance);
    EXPECT_EQ(uvec2(seen.visible, seen.pixel), uvec2(1u, cell.y * camera.width + cell.x));
    EXPECT_EQ(seen.direction, -camera.forward);
    EXPECT_NEAR(seen.distance, distance + camera.startDepth, 2e-6 * (4.0 + length(camera.right) + length(camera.up)));
    // Independent of the distance.
    EXPECT_EQ(seen.importance, 1.0 / camera.area);
}

TEST(NothingIsSeenBesideOrBehindAnOrthographicImage) {
    DeviceCamera camera = randomCamera();
    bool behind = testIndex() % 5u == 4u;
    vec2 inImage = behind ? randomVec2() : besideImage(testIndex() % 5u, -4.0);
    CameraRay ray = orthographicRay(camera, inImage * imageSize(camera));
    float distance = randomScale(-2.0, 6.0) * (behind ? -1.0 : 1.0) - (behind ? camera.startDepth : 0.0);
    EXPECT_FALSE(connectToOrthographic(camera, ray.origin + ray.direction * distance).visible);
}

TEST_N(OrthographicByHand, 4) {
    // An image of 4 x 2 pixels and 4 x 2 units; cameraRay dispatches by the kind of camera.
    vec3 point[4] = vec3[4](vec3(-1.5, 0.5, -7), vec3(0.5, -0.5, -1), vec3(2.5, 0, -1), vec3(0, 0, 1));
    bool visible[4] = bool[4](true, true, false, false);
    uint pixel[4] = uint[4](0u, 6u, 0u, 0u);
    CameraConnection seen = connectToOrthographic(plainCamera(), point[testIndex()]);
    EXPECT_EQ(uvec2(seen.visible, seen.pixel), uvec2(visible[testIndex()], pixel[testIndex()]));
    EXPECT_EQ(seen.importance, 0.125);
}

// Normals from images, and normals that keep reflections above the surface.
#include "shaders/lib/normal_map.glsl"

uvec4 fetchCornerTexel(uint index) { return uvec4(0u); }
uvec4 fetchVertexTexel(uint index) { return uvec4(0u); }
uvec4 fetchSecondUvTexel(uint index) { return uvec4(0u); }

TangentFrame randomFrame() {
    TangentFrame frame;
    frame.normal = randomDirection();
    frame.tangent = normalize(cross(frame.normal, randomDirection()));
    frame.bitangent = cross(frame.normal, frame.tangent) * (testIndex() % 2u == 0u ? 1.0 : -1.0);
    return frame;
}

// A direction above the horizon of a normal, down to grazing angles.
vec3 randomView(vec3 normal) {
    vec3 d = randomDirection();
    d -= normal * dot(d, normal);
    return normalize(normalize(d) + normal * randomScale(-12.0, 4.0));
}

TEST(FlatTexelsChangeNothing) {
    TangentFrame frame = randomFrame();
    EXPECT_NEAR(mappedNormal(vec3(0.5, 0.5, 1.0), randomFloat(), frame), frame.normal, 4e-7);
    vec3 view = randomView(frame.normal);
    EXPECT_NEAR(normalMapped(vec3(0.5, 0.5, 1.0), 1.0, frame, frame.normal, view), frame.normal, 4e-7);
    // The back of the surface.
    EXPECT_NEAR(normalMapped(vec3(0.5, 0.5, 1.0), 1.0, frame, -frame.normal, -view), -frame.normal, 4e-7);
    // A viewer behind it.
    EXPECT_NEAR(normalMapped(vec3(0.5, 0.5, 1.0), 1.0, frame, -frame.normal, view), -frame.normal, 4e-7);
}

TEST(TexelsAreInTheFrame) {
    TangentFrame frame = randomFrame();
    EXPECT_NEAR(mappedNormal(vec3(0.8, 0.5, 0.9), 1.0, frame), frame.tangent * 0.6 + frame.normal * 0.8, 8e-7);
    EXPECT_NEAR(mappedNormal(vec3(0.5, 0.2, 0.9), 1.0, frame), frame.normal * 0.8 - frame.bitangent * 0.6, 8e-7);
    // Twice the slope.
    vec3 steeper = normalize(vec3(1.2, 0.0, 0.8));
    EXPECT_NEAR(mappedNormal(vec3(0.8, 0.5, 0.9), 2.0, frame), frame.tangent * steeper.x + frame.normal * steeper.z,
                8e-7);
    EXPECT_NEAR(mappedNormal(vec3(0.5, 0.8, 0.9), 2.0, frame), frame.bitangent * steeper.x + frame.normal * steeper.z,
                8e-7);
    EXPECT_EQ(mappedNormal(vec3(0.5), 1.0, frame), frame.normal);
}

// Of any slope, seen from any side of the horizon: the reflection is above the geometric surface, and the normal on the
// side of the viewer.
TEST_N(ReflectionsStayAboveTheSurface, 65536) {
    TangentFrame frame = randomFrame();
    vec3 geometric = normalize(frame.normal + 0.4 * randomDirection());
    vec3 view = randomView(geometric);
    vec3 n = normalMapped(randomVec3(0.0, 1.0), 1.0, frame, geometric, view);
    NOTE(view);
    NOTE(geometric);
    EXPECT_NEAR(length(n), 1.0, 4e-7);
    EXPECT_GT(dot(n, view), 0.0);
    EXPECT_GT(dot(n, geometric), 0.0);
    vec3 mirrored = 2.0 * dot(n, view) * n - view;
    EXPECT_GT(dot(mirrored, geometric), 0.0);
}

TEST(OtherNormalsAreNotBent) {
    vec3 geometric = randomDirection();
    vec3 view = randomView(geometric);
    vec3 n = normalize(geometric + 0.3 * randomDirection());
    vec3 mirrored = 2.0 * dot(n, view) * n - view;
    vec3 bent = bentNormal(n, geometric, view);
    if (dot(n, view) > 0.0 && dot(mirrored, geometric) > 0.01) EXPECT_EQ(bent, n);
    // A viewer below the horizon sees nothing.
    EXPECT_EQ(bentNormal(n, geometric, -view), n);
}

// In the plane of the normals: the reflection ends up at the lowest height allowed, and the normal is halfway.
TEST_N(BentNormalIsHalfwayToTheLowestReflection, 1) {
    vec3 view = normalize(vec3(-1.0, 0.0, 0.5));
    vec3 n = normalize(vec3(0.3, 0.0, 0.95));
    vec3 bent = bentNormal(n, vec3(0.0, 0.0, 1.0), view);
    vec3 mirrored = 2.0 * dot(bent, view) * bent - view;
    EXPECT_NEAR(mirrored.z, 0.01, 2e-4);
    EXPECT_GT(mirrored.x, 0.0);
    EXPECT_EQ(bent.y, 0.0);
}

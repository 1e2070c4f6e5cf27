// Mappings from the unit square.
#include "shaders/lib/warp.glsl"

TEST(CosineHemisphereIsUnit) {
    vec3 w = cosineHemisphere(randomVec2());
    EXPECT_NEAR(length(w), 1.0, 4e-7);
    EXPECT_GE(w.z, 0.0);
}

TEST(BasisIsOrthonormalAndRightHanded) {
    vec3 n = randomDirection();
    vec3 t, b;
    orthonormalBasis(n, t, b);
    EXPECT_NEAR(vec3(dot(t, t), dot(b, b), dot(t, b)), vec3(1.0, 1.0, 0.0), 1e-6);
    EXPECT_NEAR(vec2(dot(t, n), dot(b, n)), vec2(0.0), 1e-6);
    EXPECT_NEAR(cross(t, b), n, 1e-6);
}

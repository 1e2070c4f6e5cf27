// Emission and scattering of a material on each side.
#include "shaders/lib/material.glsl"

// Word k of texel i is 16 i + k + 1, as a float: no two fields hold the same.
uvec4 fetchMaterialTexel(uint index) { return floatBitsToUint(vec4(1.0, 2.0, 3.0, 4.0) + float(16u * index)); }

Material emitter(uint flags) {
    return Material(Bsdf(vec3(0.5)), flags, Light(vec3(1.0, 2.0, 3.0), vec3(4.0, 5.0, 6.0)), 7.0);
}

// All eight combinations of flags.
TEST_N(EmissionIsThatOfTheSideWhoseFlagIsSet, 8) {
    uint flags = testIndex();
    bool front = (flags & kMaterialEmitsFront) != 0u;
    bool back = (flags & kMaterialEmitsBack) != 0u;
    Light toFront = materialEmission(emitter(flags), true);
    Light toBack = materialEmission(emitter(flags), false);
    EXPECT_EQ(toFront.invisible, front ? vec3(1.0, 2.0, 3.0) : vec3(0.0));
    EXPECT_EQ(toFront.visible, front ? vec3(4.0, 5.0, 6.0) : vec3(0.0));
    EXPECT_EQ(toBack.invisible, back ? vec3(1.0, 2.0, 3.0) : vec3(0.0));
    EXPECT_EQ(toBack.visible, back ? vec3(4.0, 5.0, 6.0) : vec3(0.0));
}

// The front always scatters, the back only if f_opaque is two-sided; emission has no influence.
TEST_N(BackScattersWhereTheMaterialIsTwoSided, 8) {
    uint flags = testIndex();
    EXPECT_TRUE(materialScatters(emitter(flags), true));
    EXPECT_EQ(materialScatters(emitter(flags), false), (flags & kMaterialTwoSided) != 0u);
}

TEST_N(MatricesAreFourTexelsInARow, 64) {
    uint texel = testIndex();
    LightMatrix m = fetchMatrix(texel);
    vec3 first = vec3(1.0, 2.0, 3.0) + float(16u * texel);
    EXPECT_EQ(m.m00, first);
    EXPECT_EQ(m.m01, first + 16.0);
    EXPECT_EQ(m.m10, first + 32.0);
    EXPECT_EQ(m.m11, first + 48.0);
}

// Materials follow each other without gaps: of 11 texels the matrices are at 3 and 7.
TEST_N(MaterialsLieSideBySide, 64) {
    uint texel = testIndex() * 11u;
    Material material = fetchMaterial(testIndex());
    EXPECT_EQ(material.bsdf.diffuse.x, float(16u * texel + 1u));
    EXPECT_EQ(material.emission.visible.z, float(16u * (texel + 2u) + 3u));
    EXPECT_EQ(fetchOpaque(testIndex()).m00.x, float(16u * (texel + 3u) + 1u));
    EXPECT_EQ(fetchTransparent(testIndex()).m11.z, float(16u * (texel + 10u) + 3u));
}

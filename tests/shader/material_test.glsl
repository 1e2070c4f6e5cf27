// Sides of a material, and its matrices.
#include "shaders/lib/material.glsl"

// Word k of texel i is 16 i + k + 1, as a float: no two fields hold the same.
uvec4 fetchMaterialTexel(uint index) { return floatBitsToUint(vec4(1.0, 2.0, 3.0, 4.0) + float(16u * index)); }

Material materialWith(uint flags) { return Material(Bsdf(vec3(0.5), 0.0, 0.5), flags); }

// The front always scatters, the back only if f_opaque is two-sided.
TEST_N(BackScattersWhereTheMaterialIsTwoSided, 8) {
    uint flags = testIndex();
    EXPECT_TRUE(materialScatters(materialWith(flags), true));
    EXPECT_EQ(materialScatters(materialWith(flags), false), (flags & kMaterialTwoSided) != 0u);
}

TEST_N(MatricesAreFourTexelsInARow, 64) {
    uint texel = testIndex();
    ReflectanceMatrix m = fetchMatrix(texel);
    vec3 first = vec3(1.0, 2.0, 3.0) + float(16u * texel);
    EXPECT_EQ(m.m00, first);
    EXPECT_EQ(m.m01, first + 16.0);
    EXPECT_EQ(m.m10, first + 32.0);
    EXPECT_EQ(m.m11, first + 48.0);
}

// Materials follow each other without gaps: of 10 texels the matrices are at 2 and 6.
TEST_N(MaterialsLieSideBySide, 64) {
    uint texel = testIndex() * 10u;
    Material material = fetchMaterial(testIndex());
    EXPECT_EQ(material.bsdf.baseColor.x, float(16u * texel + 1u));
    EXPECT_EQ(material.bsdf.roughness, float(16u * (texel + 1u) + 2u));
    EXPECT_EQ(fetchOpaque(testIndex()).m00.x, float(16u * (texel + 2u) + 1u));
    EXPECT_EQ(fetchTransparent(testIndex()).m11.z, float(16u * (texel + 9u) + 3u));
}

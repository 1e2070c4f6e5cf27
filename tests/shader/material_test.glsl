// Sides of a material, and its matrices.
#include "shaders/lib/material.glsl"

// Word k of texel i is 16 i + k + 1, as a float: no two fields hold the same.
uvec4 fetchMaterialTexel(uint index) { return floatBitsToUint(vec4(1.0, 2.0, 3.0, 4.0) + float(16u * index)); }

Material materialWith(uint flags) {
    Material material = fetchMaterial(0u);
    material.flags = flags;
    return material;
}

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

// Materials follow each other without gaps: of 15 texels the matrices are at 7 and 11.
TEST_N(MaterialsLieSideBySide, 64) {
    uint texel = testIndex() * 16u;
    Material material = fetchMaterial(testIndex());
    EXPECT_EQ(material.baseColor.x, float(16u * texel + 1u));
    EXPECT_EQ(material.roughness, float(16u * (texel + 1u) + 2u));
    EXPECT_EQ(fetchOpaque(testIndex()).m00.x, float(16u * (texel + 7u) + 1u));
    EXPECT_EQ(fetchTransparent(testIndex()).m11.z, float(16u * (texel + 14u) + 3u));
}

Material plainMaterial() {
    Material material = fetchMaterial(0u);
    material.flags = 0u;
    material.roughness = 0.5;
    material.ior = 1.5;
    material.specular = 0.5;
    material.specularColor = vec3(1.0, 0.5, 1e3);
    material.anisotropy = 0.0;
    return material;
}

// Fresnel's reflectance at normal incidence is ((n - 1) / (n + 1))^2, 4 % for n = 1.5; KHR_materials_specular scales it,
// but not beyond 1, and the specular factor scales all reflection.
TEST_N(ReflectanceFollowsFromTheIndexOfRefraction, 1) {
    Bsdf bsdf = bsdfOf(plainMaterial(), true);
    EXPECT_NEAR(bsdf.f0, vec3(0.02, 0.01, 0.5), 1e-6);
    EXPECT_EQ(bsdf.specular, 0.5);
}

// From inside, the index of refraction of the other side is the inverse; a thin wall has no inside.
TEST_N(SidesOfGlass, 1) {
    Material material = plainMaterial();
    EXPECT_EQ(bsdfOf(material, true).eta, 1.5);
    EXPECT_NEAR(bsdfOf(material, false).eta, 1.0 / 1.5, 1e-7);
    EXPECT_FALSE(isOutside(bsdfOf(material, false)));
    material.flags = kMaterialThin;
    EXPECT_EQ(bsdfOf(material, false).eta, 1.5);
    EXPECT_TRUE(isThin(bsdfOf(material, false)));
}

// Layers such as a clearcoat lie only on the outside, which both sides of an opaque sheet are.
TEST_N(OpaqueSheetsHaveNoInside, 1) {
    Material material = plainMaterial();
    material.transmission = 0.0;
    EXPECT_TRUE(isOutside(bsdfOf(material, true)));
    EXPECT_TRUE(isOutside(bsdfOf(material, false)));
    material.transmission = 0.5;
    EXPECT_TRUE(isOutside(bsdfOf(material, true)));
    EXPECT_FALSE(isOutside(bsdfOf(material, false)));
}

// KHR_materials_anisotropy: alpha along the tangent grows from roughness^2 to 1 with the square of the strength.
TEST_N(AnisotropyStretchesAlongTheTangent, 1) {
    Material material = plainMaterial();
    material.anisotropy = 0.6;
    EXPECT_NEAR(bsdfOf(material, true).alpha, vec2(0.25 + 0.75 * 0.36, 0.25), 1e-6);
}

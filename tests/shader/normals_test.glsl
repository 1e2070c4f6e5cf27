// Shading normals. Signed 16-bit numbers stand for their value times 1 / 32767.
#include "shaders/lib/normals.glsl"

uvec4 texel;       // the texel to fetch
uint fetchedIndex;  // the index with which it was fetched

uvec4 fetchNormalTexel(uint index) {
    fetchedIndex = index;
    return texel;
}
uvec4 fetchCornerTexel(uint index) { return uvec4(0u); }
uvec4 fetchVertexTexel(uint index) { return uvec4(0u); }
uvec4 fetchSecondUvTexel(uint index) { return uvec4(0u); }

uint code(int x, int y) { return (uint(x) & 0xffffu) | (uint(y) << 16u); }

// The decoder as published (Cigolle et al., "A Survey of Efficient Representations for Independent Unit
// Vectors", 2014, section 3.2), with GLSL's own function to unpack.
vec3 published(uint bits) {
    vec2 e = unpackSnorm2x16(bits);
    vec3 v = vec3(e, 1.0 - abs(e.x) - abs(e.y));
    vec2 signs = vec2(v.x >= 0.0 ? 1.0 : -1.0, v.y >= 0.0 ? 1.0 : -1.0);
    if (v.z < 0.0) v.xy = (1.0 - abs(v.yx)) * signs;
    return normalize(v);
}

// Corners and centre of the square, which are the axes.
TEST_N(AxesAreWhereTheyBelong, 1) {
    EXPECT_NEAR(octahedralDecode(code(0, 0)), vec3(0.0, 0.0, 1.0), 4e-7);
    EXPECT_NEAR(octahedralDecode(code(32767, 0)), vec3(1.0, 0.0, 0.0), 4e-7);
    EXPECT_NEAR(octahedralDecode(code(-32767, 0)), vec3(-1.0, 0.0, 0.0), 4e-7);
    EXPECT_NEAR(octahedralDecode(code(0, 32767)), vec3(0.0, 1.0, 0.0), 4e-7);
    EXPECT_NEAR(octahedralDecode(code(0, -32767)), vec3(0.0, -1.0, 0.0), 4e-7);
    EXPECT_NEAR(octahedralDecode(code(32767, 32767)), vec3(0.0, 0.0, -1.0), 4e-7);
    EXPECT_NEAR(octahedralDecode(code(-32767, 32767)), vec3(0.0, 0.0, -1.0), 4e-7);
    EXPECT_NEAR(octahedralDecode(code(32767, -32767)), vec3(0.0, 0.0, -1.0), 4e-7);
    EXPECT_NEAR(octahedralDecode(code(-32767, -32767)), vec3(0.0, 0.0, -1.0), 4e-7);
}

// 2^22 codes, each first coordinate with 64 second coordinates: unit results, equal to the published ones.
// Excludes -32768, which no encoder writes.
TEST_N(DecodesAsPublished, 65536) {
    float furthest = 0.0;
    float longest = 0.0;
    float shortest = 1.0;
    for (uint i = 0u; i < 64u; i++) {
        uint bits = testIndex() | ((i << 10u) + (randomUint() & 1023u)) << 16u;
        if ((bits & 0xffffu) == 0x8000u || bits >> 16u == 0x8000u) continue;
        vec3 n = octahedralDecode(bits);
        vec3 off = abs(n - published(bits));
        furthest = max(furthest, max(off.x, max(off.y, off.z)));
        longest = max(longest, length(n));
        shortest = min(shortest, length(n));
    }
    EXPECT_LE(furthest, 4e-7);
    EXPECT_LE(longest, 1.0 + 4e-7);
    EXPECT_GE(shortest, 1.0 - 4e-7);
}

// Every code on the square's border, on its axes, and on the diamond that becomes the equator. -32768 decodes
// like -32767, up to rounding.
TEST_N(DecodesAsPublishedOnTheEdges, 65536) {
    int x = int(testIndex()) - 32768;
    int y = 32767 - min(abs(x), 32767);
    vec2 bound = vec2(4e-7, 7e-5);
    EXPECT_NEAR(octahedralDecode(code(x, 32767)), published(code(x, 32767)), x == -32768 ? bound.y : bound.x);
    EXPECT_NEAR(octahedralDecode(code(x, -32767)), published(code(x, -32767)), x == -32768 ? bound.y : bound.x);
    EXPECT_NEAR(octahedralDecode(code(-32768, x)), published(code(-32768, x)), bound.y);
    EXPECT_NEAR(octahedralDecode(code(x, 0)), published(code(x, 0)), x == -32768 ? bound.y : bound.x);
    EXPECT_NEAR(octahedralDecode(code(0, x)), published(code(0, x)), x == -32768 ? bound.y : bound.x);
    EXPECT_NEAR(octahedralDecode(code(x, y)), published(code(x, y)), x == -32768 ? bound.y : bound.x);
    EXPECT_NEAR(octahedralDecode(code(x, -y)), published(code(x, -y)), x == -32768 ? bound.y : bound.x);
    EXPECT_NEAR(octahedralDecode(code(x, y)).z, 0.0, 4e-5);
}

// The map is symmetric in both coordinates, and across the diagonal.
TEST(IsSymmetric) {
    int x = int(randomUint() % 32767u) + 1;
    int y = int(randomUint() % 32767u) + 1;
    vec3 n = octahedralDecode(code(x, y));
    EXPECT_EQ(octahedralDecode(code(-x, y)), n * vec3(-1.0, 1.0, 1.0));
    EXPECT_EQ(octahedralDecode(code(x, -y)), n * vec3(1.0, -1.0, 1.0));
    EXPECT_NEAR(octahedralDecode(code(y, x)), n.yxz, 4e-7);
}

// Corners of a triangle that are less than 90 degrees apart.
void setCorners() {
    int x = int(randomUint() % 65535u) - 32767;
    int y = int(randomUint() % 65535u) - 32767;
    ivec2 b = clamp(ivec2(x, y) + ivec2(randomUint() & 0x1fffu, randomUint() & 0x1fffu) - 4096, -32767, 32767);
    ivec2 c = clamp(ivec2(x, y) + ivec2(randomUint() & 0x1fffu, randomUint() & 0x1fffu) - 4096, -32767, 32767);
    texel = uvec4(code(x, y), code(b.x, b.y), code(c.x, c.y), randomUint());
}

TEST(ShadingNormalIsThatOfTheCorners) {
    setCorners();
    uint triangle = randomUint() & 0xffffffu;
    EXPECT_NEAR(shadingNormal(triangle, vec2(0.0, 0.0)), octahedralDecode(texel.x), 4e-7);
    EXPECT_NEAR(shadingNormal(triangle, vec2(1.0, 0.0)), octahedralDecode(texel.y), 4e-7);
    EXPECT_NEAR(shadingNormal(triangle, vec2(0.0, 1.0)), octahedralDecode(texel.z), 4e-7);
    EXPECT_EQ(fetchedIndex, triangle * kNormalTexels);
}

TEST(ShadingNormalIsInterpolated) {
    setCorners();
    vec3 a = octahedralDecode(texel.x);
    vec3 b = octahedralDecode(texel.y);
    vec3 c = octahedralDecode(texel.z);
    EXPECT_NEAR(shadingNormal(0u, vec2(0.5, 0.0)), normalize(a + b), 4e-7);
    EXPECT_NEAR(shadingNormal(0u, vec2(0.0, 0.5)), normalize(a + c), 4e-7);
    EXPECT_NEAR(shadingNormal(0u, vec2(0.5, 0.5)), normalize(b + c), 4e-7);
    EXPECT_NEAR(shadingNormal(0u, vec2(1.0 / 3.0)), normalize(a + b + c), 4e-7);
    EXPECT_NEAR(shadingNormal(0u, vec2(0.25, 0.125)), normalize(5.0 * a + 2.0 * b + c), 4e-7);
}

TEST(ShadingNormalIsUnit) {
    setCorners();
    vec2 u = randomVec2();
    EXPECT_NEAR(length(shadingNormal(0u, u.x + u.y > 1.0 ? 1.0 - u : u)), 1.0, 4e-7);
}

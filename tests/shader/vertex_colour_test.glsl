// Colours of vertices: square roots of the channels in 10 bits each.
#include "shaders/lib/vertex_colour.glsl"

uvec4 texel;        // the texel to fetch
uint fetchedIndex;  // the index with which it was fetched

uvec4 fetchColourTexel(uint index) {
    fetchedIndex = index;
    return texel;
}

uint code(uint r, uint g, uint b) { return r | g << 10u | b << 20u; }

TEST_N(ChannelsAreSquares, 1) {
    EXPECT_EQ(decodeColour(code(0u, 0u, 0u)), vec3(0.0));
    EXPECT_NEAR(decodeColour(code(1023u, 1023u, 1023u)), vec3(1.0), 2e-7);
    EXPECT_NEAR(decodeColour(code(1023u, 0u, 0u)), vec3(1.0, 0.0, 0.0), 2e-7);
    EXPECT_NEAR(decodeColour(code(0u, 1023u, 0u)), vec3(0.0, 1.0, 0.0), 2e-7);
    EXPECT_NEAR(decodeColour(code(0u, 0u, 1023u)), vec3(0.0, 0.0, 1.0), 2e-7);
    EXPECT_NEAR(decodeColour(code(341u, 682u, 93u)), vec3(1.0 / 9.0, 4.0 / 9.0, 1.0 / 121.0), 2e-7);
    EXPECT_NEAR(decodeColour(0xc0000000u | code(0u, 0u, 1023u)), vec3(0.0, 0.0, 1.0), 2e-7);
}

TEST(ColoursAreInterpolated) {
    texel = uvec4(code(1023u, 0u, 0u), code(0u, 1023u, 0u), code(0u, 0u, 1023u), 0xdeadbeefu);
    vec2 b = randomVec2();
    if (b.x + b.y > 1.0) b = 1.0 - b;
    vec3 colour = vertexColour(testIndex(), b);
    EXPECT_NEAR(colour, vec3(1.0 - b.x - b.y, b.x, b.y), 4e-7);
    EXPECT_EQ(fetchedIndex, testIndex());
}

TEST(AlphasAreInterpolated) {
    vec3 alphas = vec3(uvec3(randomUint(), randomUint(), randomUint()) & 1023u);
    texel = uvec4(uvec3(0xffffffffu), 0xc0000000u | code(uint(alphas.x), uint(alphas.y), uint(alphas.z)));
    vec2 b = randomVec2();
    if (b.x + b.y > 1.0) b = 1.0 - b;
    EXPECT_NEAR(vertexAlpha(testIndex(), b), dot(alphas / 1023.0, vec3(1.0 - b.x - b.y, b.x, b.y)), 4e-7);
    EXPECT_EQ(fetchedIndex, testIndex());
}

// Wraps, decoding of colours, and what a lookup makes of a single pixel.
#include "shaders/lib/texture.glsl"

uvec4 atlas[4];  // an image of 4 x 4 pixels with 8 bits per channel, or of 4 x 1 floats
uint fetched;    // the texels that were fetched: a bit each

uvec4 fetchTextureTexel(uint index) { return uvec4(0u); }
uvec4 fetchAtlasTexel(uint index) {
    fetched |= 1u << index;
    return atlas[min(index, 3u)];
}

// IEC 61966-2-1:1999, clause 5.2.
float exactly(float x) { return x <= 0.04045 ? x / 12.92 : pow((x + 0.055) / 1.055, 2.4); }

TEST_N(SrgbIsWithinATenthOfAPercent, 65536) {
    float x = (float(testIndex()) + 1.0) / 65536.0;
    NOTE(x);
    EXPECT_NEAR(srgbToLinear(x) / exactly(x), 1.0, 8e-4);
}

TEST_N(SrgbKeepsBlackAndWhite, 1) {
    EXPECT_EQ(srgbToLinear(0.0), 0.0);
    EXPECT_NEAR(srgbToLinear(1.0), 1.0, 3e-7);
}

// Coordinates that floats hold exactly, up to 2^20 periods away.
TEST(PeriodsAreExact) {
    float whole = float(int(randomUint() >> 11u) - 1048576);
    float fraction = float(randomUint() & 7u) * 0.125;
    EXPECT_EQ(wrapCoordinate(kWrapRepeat, whole + fraction), fraction);
    bool odd = (int(whole) & 1) != 0;
    EXPECT_EQ(wrapCoordinate(kWrapMirror, whole + fraction), odd ? 1.0 + fraction : fraction);
    EXPECT_EQ(wrapCoordinate(kWrapClamp, whole + fraction), clamp(whole + fraction, 0.0, 1.0));
}

// Against remainders of integers, in all periods that lookups use.
TEST(PixelsRepeatAndMirror) {
    int n = 1 + int(randomUint() % 17u);
    int i = int(randomUint() % uint(2 * n + 2)) - 1;
    NOTE(n);
    NOTE(i);
    int inMirror = (i + 2 * n) % (2 * n);
    EXPECT_EQ(wrapPixel(kWrapMirror, i, uint(n)), uint(inMirror < n ? inMirror : 2 * n - 1 - inMirror));
    EXPECT_EQ(wrapPixel(kWrapClamp, i, uint(n)), uint(min(max(i, 0), n - 1)));
    int within = min(i, n);
    EXPECT_EQ(wrapPixel(kWrapRepeat, within, uint(n)), uint((within + n) % n));
}

Texture image(uint width, uint height, uint flags) {
    return Texture(0u, width, height, flags, vec3(1.0, 0.0, 0.0), vec3(0.0, 1.0, 0.0));
}

// The word of pixel (x, y) is 0x10203000 + x + 16 y.
void setBlocks() {
    fetched = 0u;
    for (uint y = 0u; y < 4u; y++) {
        for (uint x = 0u; x < 4u; x++) {
            atlas[(y / 2u) * 2u + x / 2u][(x & 1u) + 2u * (y & 1u)] = 0x10203000u + x + 16u * y;
        }
    }
}

TEST_N(PixelsOfBlocksAreFound, 16) {
    setBlocks();
    uint x = testIndex() % 4u;
    uint y = testIndex() / 4u;
    EXPECT_NEAR(fetchPixel(image(4u, 4u, 0u), x, y) * 255.0, vec4(float(x + 16u * y), 48.0, 32.0, 16.0), 1e-5);
    EXPECT_EQ(fetched, 1u << ((y / 2u) * 2u + x / 2u));
}

// An odd width takes half a block more.
TEST_N(RowsOfBlocksAreWhole, 1) {
    setBlocks();
    EXPECT_NEAR(fetchPixel(image(3u, 4u, 0u), 2u, 3u).x * 255.0, 50.0, 1e-5);
}

TEST_N(FloatsAreAsTheyAre, 1) {
    atlas[2] = floatBitsToUint(vec4(-3.0, 1e6, 0.25, 0.5));
    EXPECT_EQ(fetchPixel(image(4u, 1u, kTextureFloat), 2u, 0u), vec4(-3.0, 1e6, 0.25, 0.5));
    // Alpha is never decoded.
    atlas[2] = floatBitsToUint(vec4(0.04, 0.0, 1.0, 0.04));
    vec4 decoded = fetchPixel(image(4u, 1u, kTextureFloat | kTextureSrgb), 2u, 0u);
    EXPECT_NEAR(decoded, vec4(0.04 / 12.92, 0.0, 1.0, 0.04), 3e-7);
}

TEST_N(CentresOfPixelsAreTheirValues, 16) {
    setBlocks();
    uvec2 pixel = uvec2(testIndex() % 4u, testIndex() / 4u);
    vec4 value = sampleTexture(image(4u, 4u, 0u), (vec2(pixel) + 0.5) / 4.0);
    EXPECT_NEAR(value.x * 255.0, float(pixel.x + 16u * pixel.y), 1e-4);
}

// Colours are decoded before they are filtered: halfway between black and white is one half.
TEST_N(FilterIsLinearInLight, 1) {
    atlas[0] = uvec4(0xff000000u, 0xffffffffu, 0xff000000u, 0xffffffffu);
    uint flags = kTextureSrgb | kWrapClamp << kTextureWrapUShift | kWrapClamp << kTextureWrapVShift;
    EXPECT_NEAR(sampleTexture(image(2u, 2u, flags), vec2(0.5, 0.5)), vec4(0.5, 0.5, 0.5, 1.0), 1e-6);
    EXPECT_NEAR(sampleTexture(image(2u, 2u, flags), vec2(0.375, 0.9)), vec4(0.25, 0.25, 0.25, 1.0), 1e-6);
    EXPECT_NEAR(sampleTexture(image(2u, 2u, flags | kTextureNearest), vec2(0.499, 0.5)), vec4(0.0, 0.0, 0.0, 1.0),
                1e-6);
    EXPECT_NEAR(sampleTexture(image(2u, 2u, flags | kTextureNearest), vec2(0.501, 0.5)), vec4(1.0), 1e-6);
}

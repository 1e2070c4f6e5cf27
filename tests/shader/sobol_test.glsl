// Owen-scrambled Sobol points.
#include "shaders/lib/sobol.glsl"

// Nested scrambling: bit k of the result is bit k of the number, flipped depending on the seed and the bits
// below. Hence it is one-to-one.
TEST(ScramblingFlipsBitsByLowerOnes) {
    uint x = randomUint();
    uint seed = randomUint();
    uint k = randomUint() & 31u;
    uint below = (1u << k) - 1u;
    uint scrambled = owenScrambleReversed(x, seed);
    uint flipped = owenScrambleReversed(x ^ (1u << k), seed);
    EXPECT_EQ((scrambled ^ flipped) & below, 0u);
    EXPECT_EQ((scrambled ^ flipped) & (1u << k), 1u << k);
    uint sameBelow = owenScrambleReversed((x & below) | (randomUint() & ~below), seed);
    EXPECT_EQ((scrambled ^ sameBelow) & below, 0u);
}

TEST(SecondDimensionIsLinear) {
    uint a = randomUint();
    uint b = randomUint();
    EXPECT_EQ(sobolSecondReversed(a ^ b), sobolSecondReversed(a) ^ sobolSecondReversed(b));
    EXPECT_EQ(sobolSecondReversed(sobolSecondReversed(a)), a);  // the Pascal matrix modulo 2 is its own inverse
}

// The two points of an aligned pair of indices are in opposite halves of each axis.
TEST(NeighboursAreInOppositeHalves) {
    uvec4 key = uvec4(randomUint(), randomUint(), randomUint(), randomUint());
    uint index = randomUint();
    uvec2 halves = (sobolPair(index, key) ^ sobolPair(index ^ 1u, key)) >> 31u;
    EXPECT_EQ(halves, uvec2(1u, 1u));
}

TEST(EachWordOfTheKeyHasItsUse) {
    uvec4 key = uvec4(randomUint(), randomUint(), randomUint(), randomUint());
    uint index = randomUint();
    uint other = randomUint();
    uvec2 point = sobolPair(index, key);
    EXPECT_EQ(sobolPair(index, uvec4(key.x, other, key.z, key.w)).y, point.y);
    EXPECT_NE(sobolPair(index, uvec4(key.x, key.y ^ 1u, key.z, key.w)).x, point.x);
    EXPECT_EQ(sobolPair(index, uvec4(key.x, key.y, other, key.w)).x, point.x);
    EXPECT_NE(sobolPair(index, uvec4(key.x, key.y, key.z ^ 1u, key.w)).y, point.y);
    EXPECT_EQ(sobolPair(index, uvec4(key.xyz, other)), point);
}

// Counter-based random numbers.
#include "shaders/lib/rng.glsl"

TEST(FloatsAreInTheHalfOpenInterval) {
    float x = uniformFloat(randomUint());
    EXPECT_GE(x, 0.0);
    EXPECT_LT(x, 1.0);
}

TEST(FloatsAreMonotonicInTheWord) {
    uint word = randomUint() & 0xfffffeffu;
    EXPECT_EQ(uniformFloat(word | 0x100u) - uniformFloat(word), 1.0 / 16777216.0);
}

TEST(TheLowestEightBitsDoNotCount) {
    uint word = randomUint();
    EXPECT_EQ(uniformFloat(word ^ (randomUint() & 0xffu)), uniformFloat(word));
}

TEST(PairsAreOneFloatPerWord) {
    uint first = randomUint();
    uint second = randomUint();
    EXPECT_EQ(uniformFloat2(uvec2(first, second)), vec2(uniformFloat(first), uniformFloat(second)));
}

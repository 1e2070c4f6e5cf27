// The results of a lane of the light tracer.
#include "shaders/lib/light_path.glsl"

uvec4 fetchNormalTexel(uint index) { return uvec4(index); }
uvec4 fetchCornerTexel(uint index) { return uvec4(0u); }
uvec4 fetchVertexTexel(uint index) { return uvec4(0u); }
uvec4 fetchSecondUvTexel(uint index) { return uvec4(0u); }
uvec4 fetchPlaneTexel(uint index) { return uvec4(0u); }
uvec4 fetchPairTexel(uint index) { return uvec4(0u); }

TEST_N(SumsAreEmptyAtFirst, 1) {
    LaneSums sums = emptyLaneSums();
    EXPECT_EQ(sums.nonFinite | sums.clamped | sums.lightRays | sums.bounceRays | sums.shadowRays, 0u);
    EXPECT_EQ(sums.lastBounce | sums.previousBounce | sums.invisible | sums.visible, uvec2(0u));
}

// Every field has a different value.
TEST_N(ResultHasEveryField, 1) {
    LaneResult result = laneResult(LaneSums(1u, 2u, 3u, 4u, 5u, uvec2(6u, 7u), uvec2(8u, 9u), uvec2(10u, 11u),
                                            uvec2(12u, 13u)));
    EXPECT_EQ(uvec2(result.nonFinite, result.clamped), uvec2(1u, 2u));
    EXPECT_EQ(uvec3(result.lightRays, result.bounceRays, result.shadowRays), uvec3(3u, 4u, 5u));
    EXPECT_EQ(uvec2(result.lastBounce[0], result.lastBounce[1]), uvec2(6u, 7u));
    EXPECT_EQ(uvec2(result.previousBounce[0], result.previousBounce[1]), uvec2(8u, 9u));
    EXPECT_EQ(uvec2(result.invisible[0], result.invisible[1]), uvec2(10u, 11u));
    EXPECT_EQ(uvec2(result.visible[0], result.visible[1]), uvec2(12u, 13u));
}

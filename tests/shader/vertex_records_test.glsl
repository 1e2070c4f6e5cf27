// Tangents that are not known, and frames without them.
#include "shaders/lib/vertex_records.glsl"

uvec4 fetchCornerTexel(uint index) { return uvec4(0u); }
uvec4 fetchVertexTexel(uint index) { return uvec4(0u); }
uvec4 fetchSecondUvTexel(uint index) { return uvec4(0u); }

TEST(UnknownTangentsAreZero) {
    uint angle = randomUint() & 0xffffu;
    EXPECT_EQ(tangentDecode(uvec4(randomUint(), 0u, 0u, angle)), vec3(0.0));
    EXPECT_NEAR(length(tangentDecode(uvec4(randomUint(), 0u, 0u, angle | kTangentKnown))), 1.0, 1e-6);
}

TEST(FramesWithoutTangentsAreOrthonormal) {
    uvec4 vertex = uvec4(randomUint(), 0u, 0u, 0u);
    vec3 normal = randomDirection();
    TangentFrame frame = tangentFrame(VertexRecords(vertex, vertex, vertex), vec2(0.25, 0.5), normal);
    EXPECT_EQ(frame.normal, normal);
    EXPECT_NEAR(length(frame.tangent), 1.0, 1e-6);
    EXPECT_NEAR(dot(frame.tangent, normal), 0.0, 1e-6);
    EXPECT_NEAR(frame.bitangent, cross(normal, frame.tangent), 1e-6);
}

#pragma once

namespace duolux::test {

// Functions of kernels that a library requires, for tests that do not call them.

inline constexpr const char* kNoVertexRecords =
    "uvec4 fetchCornerTexel(uint index) { return uvec4(0u); }"
    "uvec4 fetchVertexTexel(uint index) { return uvec4(0u); }"
    "uvec4 fetchSecondUvTexel(uint index) { return uvec4(0u); }";

inline constexpr const char* kNoEmissionTextures =
    "vec3 emissionTexel(uint triangle, vec2 barycentric) { return vec3(1.0); }";

}  // namespace duolux::test

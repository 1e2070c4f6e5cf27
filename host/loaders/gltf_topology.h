#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace duolux {

/// How indices form triangles (glTF 2.0, section 3.7.2.1).
enum class GltfMode : std::uint8_t { kTriangles = 4, kStrip = 5, kFan = 6 };

/// The triangles of a sequence of vertices. Strips and fans lose those with two equal corners, which only
/// connect others. Vertices at the end that form no triangle are left out.
std::vector<glm::uvec3> trianglesOf(GltfMode mode, const std::vector<std::uint32_t>& indices);

/// Renumbers the vertices that triangles use, in the order of their first use. Returns their old numbers.
/// `vertexCount`: above all indices.
std::vector<std::uint32_t> compactVertices(std::vector<glm::uvec3>& triangles, std::size_t vertexCount);

}  // namespace duolux

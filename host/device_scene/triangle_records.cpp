#include "host/device_scene/triangle_records.h"

#include <cmath>
#include <cstddef>
#include <cstdint>

#include "host/base/parallel.h"
#include "host/device_scene/octahedral.h"

namespace duolux {

namespace {

/// See decodeColour in shaders/lib/vertex_colour.glsl.
std::uint32_t encodeColour(const glm::vec3& colour) {
    const glm::vec3 root = glm::sqrt(glm::clamp(colour, 0.0f, 1.0f)) * 1023.0f;
    const auto rounded = [](float x) { return static_cast<std::uint32_t>(std::lround(x)); };
    return rounded(root.x) | rounded(root.y) << 10 | rounded(root.z) << 20;
}

bool isSmooth(const Geometry& geometry, std::uint32_t triangle) {
    return !geometry.normals.empty() && geometry.normalIndices[triangle].x != Geometry::kNoNormal;
}

std::uint32_t materialFlags(const Geometry& geometry, std::uint32_t triangle) {
    return geometry.materials[triangle] | (isSmooth(geometry, triangle) ? shared::kTriangleSmooth : 0u);
}

shared::DevicePair devicePair(const Geometry& geometry, const TriangleRanks& ranks, const TrianglePair& pair,
                              const PairCorners& corners) {
    const auto position = [&](std::size_t corner) { return geometry.positions[corners.positions[corner]]; };
    const std::uint32_t second = pair.isSingle() ? pair.first : pair.second;
    const std::uint32_t secondRank = pair.isSingle() ? TrianglePair::kNone : ranks.rankOf(pair.second);
    return {position(0), ranks.rankOf(pair.first),
            position(1), materialFlags(geometry, second),
            position(2), materialFlags(geometry, pair.first),
            position(3), secondRank};
}

/// `turn`: the index of the corner that comes first.
shared::DeviceNormals deviceNormals(const Geometry& geometry, std::uint32_t triangle, std::uint32_t turn) {
    if (!isSmooth(geometry, triangle)) return {};
    const glm::uvec3 index = geometry.normalIndices[triangle];
    const auto normal = [&](std::uint32_t corner) {
        return octahedralEncode(geometry.normals[index[static_cast<int>((turn + corner) % 3)]]);
    };
    return {{normal(0), normal(1), normal(2)}, 0};
}

/// As deviceNormals. White and opaque where the geometry has no colours or alphas.
shared::DeviceColours deviceColours(const Geometry& geometry, std::uint32_t triangle, std::uint32_t turn) {
    const glm::uvec3 index = geometry.triangles[triangle];
    shared::DeviceColours record{};
    for (std::uint32_t k = 0; k < 3; ++k) {
        const std::uint32_t position = index[static_cast<int>((turn + k) % 3)];
        record.roots[k] =
            encodeColour(geometry.colours.empty() ? glm::vec3(1.0f) : geometry.colours[position]);
        const float alpha = geometry.alphas.empty() ? 1.0f : geometry.alphas[position];
        record.alphas |= static_cast<std::uint32_t>(std::lround(glm::clamp(alpha, 0.0f, 1.0f) * 1023.0f))
                         << (10 * k);
    }
    return record;
}

}  // namespace

TriangleRecords makeTriangleRecords(const Geometry& geometry, std::span<const TrianglePair> pairs,
                                    const TriangleRanks& ranks, const SurfacePlanes& surfaces,
                                    bool vertexRecords) {
    TriangleRecords out;
    out.pairs.resize(pairs.size());
    if (!geometry.normals.empty() && !vertexRecords) out.normals.resize(2 * pairs.size());
    if (!geometry.colours.empty() || !geometry.alphas.empty()) out.colours.resize(2 * pairs.size());
    if (surfaces.used()) out.planes.resize(2 * pairs.size());
    parallelFor(pairs.size(), 1 << 15, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const TrianglePair& pair = pairs[i];
            const PairCorners corners = cornersOf(geometry, pair).value();
            out.pairs[i] = devicePair(geometry, ranks, pair, corners);
            for (std::size_t k = 0; k < 2; ++k) {
                const std::uint32_t triangle = k == 0 ? pair.first : pair.second;
                if (triangle == TrianglePair::kNone) continue;
                const std::size_t at = 2 * i + k;
                if (!out.normals.empty())
                    out.normals[at] = deviceNormals(geometry, triangle, corners.turns[k]);
                if (!out.colours.empty())
                    out.colours[at] = deviceColours(geometry, triangle, corners.turns[k]);
                if (!out.planes.empty()) out.planes[at] = surfaces.planeOf(triangle);
            }
        }
    });
    return out;
}

}  // namespace duolux

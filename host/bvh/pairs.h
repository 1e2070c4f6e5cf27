#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "host/bvh/binary_bvh.h"
#include "host/scene/scene.h"

namespace duolux {

/// An entry of a leaf: one triangle, or two that share an edge in opposite directions. The shared edge is
/// tested once, and four corners are stored instead of six.
struct TrianglePair {
    static constexpr std::uint32_t kNone = 0xffffffffu;

    std::uint32_t first = kNone, second = kNone;  ///< indices into Geometry::triangles

    bool isSingle() const { return second == kNone; }
    bool operator==(const TrianglePair&) const = default;
};

/// Groups triangles (each listed at most once) into pairs. A triangle is paired with the remaining neighbour
/// that gives the smallest common box, or stays single if two separate boxes are smaller.
std::vector<TrianglePair> pairTriangles(const Geometry& geometry, std::span<const std::uint32_t> triangles);

/// Indices of all triangles, in order.
std::vector<std::uint32_t> allTriangles(const Geometry& geometry);

/// The bounding box of each pair; the primitive is the index of the pair.
std::vector<PrimitiveRef> boxesOf(const Geometry& geometry, std::span<const TrianglePair> pairs);

/// The corners of a pair, with the shared edge stored once.
struct PairCorners {
    /// Indices into Geometry::positions. The triangles have the corners 0 1 2 and 3 2 1, in this order. For a
    /// single triangle, corner 3 equals corner 1.
    std::array<std::uint32_t, 4> positions;
    /// For each triangle, which of its corners in Geometry::triangles comes first here.
    std::array<std::uint32_t, 2> turns;
};

/// Empty if the triangles have no common edge.
std::optional<PairCorners> cornersOf(const Geometry& geometry, const TrianglePair& pair);

}  // namespace duolux

#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "host/bvh/binary_bvh.h"
#include "host/scene/scene.h"

namespace duolux {

/// What the leaves of a tree hold: two triangles with a common edge, which they run along in opposite
/// directions, or one. (An edge that both have is tested once, and memory has four corners in place of six.)
struct TrianglePair {
    static constexpr std::uint32_t kNone = 0xffffffffu;

    std::uint32_t first = kNone, second = kNone;  ///< indices into Geometry::triangles

    bool isSingle() const { return second == kNone; }
    bool operator==(const TrianglePair&) const = default;
};

/// Sorts triangles (each at most once) into pairs: each takes, of the neighbours that are left, the one with
/// which it has the smallest box, unless two boxes are smaller than one.
std::vector<TrianglePair> pairTriangles(const Geometry& geometry, std::span<const std::uint32_t> triangles);

/// Indices of all triangles, in order.
std::vector<std::uint32_t> allTriangles(const Geometry& geometry);

/// Around each pair; its number is the primitive's.
std::vector<PrimitiveRef> boxesOf(const Geometry& geometry, std::span<const TrianglePair> pairs);

/// A pair without the edge that its triangles share twice.
struct PairCorners {
    /// Indices into Geometry::positions: the triangles have the corners 0 1 2 and 3 2 1, in this order. A
    /// single triangle's corner 3 is corner 1 again.
    std::array<std::uint32_t, 4> positions;
    /// The number in Geometry::triangles of each triangle's first corner here.
    std::array<std::uint32_t, 2> turns;
};

/// None if the triangles have no common edge.
std::optional<PairCorners> cornersOf(const Geometry& geometry, const TrianglePair& pair);

}  // namespace duolux

#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "host/bvh/pairs.h"
#include "host/scene/scene.h"
#include "shaders/shared/bvh_layout.h"

namespace duolux {

/// The tree as the device traverses it. Node 0 is the root.
struct WideBvh {
    std::vector<shared::WideNode> nodes;
    std::vector<TrianglePair> pairs;  ///< in the order of the leaves
    std::uint32_t depth = 0;          ///< levels of nodes
    double sahCost = 0.0;             ///< expected node visits + kPairCost * pair tests of a random ray
};

/// Builds a tree over the given triangles of the geometry (at least one; each at most once).
WideBvh buildWideBvh(const Geometry& geometry, std::span<const std::uint32_t> triangles);

/// Over all triangles.
WideBvh buildWideBvh(const Geometry& geometry);

/// Checks every invariant of the layout: each of `triangles` is in exactly one pair of one leaf, pairs have a
/// common edge, child boxes contain the triangles below them, indices are in range, each node is reached
/// once, the depth is within kMaxTreeDepth. Returns the violations; empty if there are none.
std::vector<std::string> auditWideBvh(const WideBvh& bvh, const Geometry& geometry,
                                      std::span<const std::uint32_t> triangles);

}  // namespace duolux

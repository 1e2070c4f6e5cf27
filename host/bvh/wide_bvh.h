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
    std::vector<TrianglePair> pairs;  ///< in the order leaves refer to
    std::uint32_t depth = 0;          ///< levels of nodes
    double sahCost = 0.0;             ///< expected node visits + kPairCost * pair tests of a random ray
};

/// Builds over the given triangles of the geometry (at least one; each at most once).
WideBvh buildWideBvh(const Geometry& geometry, std::span<const std::uint32_t> triangles);

/// Over all triangles.
WideBvh buildWideBvh(const Geometry& geometry);

/// Checks every invariant of the layout: each of `triangles` in exactly one pair of one leaf, pairs with a
/// common edge, child boxes contain what is below them, indices in range, each node reached once, depth
/// within kMaxTreeDepth. Empty if all hold, else what does not.
std::vector<std::string> auditWideBvh(const WideBvh& bvh, const Geometry& geometry,
                                      std::span<const std::uint32_t> triangles);

}  // namespace duolux

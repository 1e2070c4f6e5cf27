#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace duolux {

struct Aabb {
    glm::vec3 lower{1e30f}, upper{-1e30f};

    void grow(const Aabb& other) {
        lower = glm::min(lower, other.lower);
        upper = glm::max(upper, other.upper);
    }
    /// Half of the surface area: all that the surface-area heuristic needs.
    float halfArea() const {
        const glm::vec3 d = upper - lower;
        return d.x * d.y + d.y * d.z + d.z * d.x;
    }
};

/// A box around one primitive, and which.
struct PrimitiveRef {
    glm::vec3 lower;
    std::uint32_t primitive;
    glm::vec3 upper;
    std::uint32_t padding = 0;
};

/// A binary tree with one primitive per leaf. The subtree of a node over n primitives takes exactly 2n - 1
/// nodes in depth-first order: its left child is the next node, its right child comes after the left subtree.
struct BinaryBvh {
    struct Node {
        Aabb bounds;
        std::uint32_t count;  ///< primitives below
        std::uint32_t right;  ///< index of the right child; for a leaf (count == 1) the primitive
    };
    std::vector<Node> nodes;
};

enum class SplitMethod {
    kBinnedSah,  ///< Wald, "On fast Construction of SAH-based Bounding Volume Hierarchies", 2007
    kMedian      ///< by count: the depth is at most ceil(log2(n))
};

/// Builds on all cores; the tree does not depend on how many there are. `refs` is reordered. At least one
/// reference.
BinaryBvh buildBinaryBvh(std::span<PrimitiveRef> refs, SplitMethod method);

}  // namespace duolux

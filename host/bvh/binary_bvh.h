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
    /// Half of the surface area, which is sufficient for the surface-area heuristic.
    float halfArea() const {
        const glm::vec3 d = upper - lower;
        return d.x * d.y + d.y * d.z + d.z * d.x;
    }
};

/// The bounding box of a primitive, and the primitive's number.
struct PrimitiveRef {
    glm::vec3 lower;
    std::uint32_t primitive;
    glm::vec3 upper;
    std::uint32_t padding = 0;
};

/// A binary tree with one primitive per leaf. The subtree over n primitives has exactly 2n - 1 nodes, in
/// depth-first order: the left child follows its parent, the right child follows the left subtree.
struct BinaryBvh {
    struct Node {
        Aabb bounds;
        std::uint32_t count;  ///< primitives below
        std::uint32_t right;  ///< index of the right child; in a leaf (count == 1) the primitive
    };
    std::vector<Node> nodes;
};

enum class SplitMethod {
    kBinnedSah,  ///< Wald, "On fast Construction of SAH-based Bounding Volume Hierarchies", 2007
    kMedian      ///< by count: the depth is at most ceil(log2(n))
};

/// Builds a tree on all cores; the result does not depend on their number. Reorders `refs`, which must not be
/// empty.
BinaryBvh buildBinaryBvh(std::span<PrimitiveRef> refs, SplitMethod method);

}  // namespace duolux

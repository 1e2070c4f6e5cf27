#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "host/bvh/binary_bvh.h"

namespace duolux {

/// Chooses the nodes of a binary tree that become the nodes and leaves of an 8-wide tree with the least SAH
/// cost, by dynamic programming (Ylitie, Karras, Laine 2017, section 3.1).
class CollapsePlan {
  public:
    /// Cost of testing one pair of triangles, in node visits.
    static constexpr float kPairCost = 0.4f;

    explicit CollapsePlan(const BinaryBvh& bvh);

    /// The children of the wide node that `binaryNode` becomes.
    struct Children {
        std::array<std::uint32_t, 8> node{};
        std::array<bool, 8> leaf{};  ///< false: an inner node
        std::size_t count = 0;
    };
    Children childrenOf(std::uint32_t binaryNode) const;

    double sahCost() const { return sahCost_; }

  private:
    /// The best forest of at most i + 1 subtrees that covers a binary node. One record per inner binary node.
    struct Record {
        std::array<float, 7> cost;
        std::array<std::uint8_t, 8> split;  ///< [i], i >= 1: trees given to the left child (0: use i - 1
                                            ///< trees); [0]: kLeaf or kInner; [7]: the split of 8 trees
    };
    static constexpr std::uint8_t kLeaf = 1, kInner = 0;

    /// The area of a node's box relative to the root's: the probability that a random ray that intersects the
    /// root's box intersects the node's.
    float relativeArea(const BinaryBvh::Node& node) const;
    float cost(std::uint32_t node, int trees) const;
    void computeSubtree(std::uint32_t root, std::uint32_t firstRecord);
    void compute(std::uint32_t node);
    void collect(std::uint32_t node, int trees, Children& children) const;

    const BinaryBvh& bvh_;
    std::vector<std::uint32_t> recordOf_;  // per binary node; records are in the order of the nodes
    std::vector<Record> records_;
    double inverseRootArea_ = 0.0;
    double sahCost_ = 0.0;
};

}  // namespace duolux

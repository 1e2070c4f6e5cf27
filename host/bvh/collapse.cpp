#include "host/bvh/collapse.h"

#include <algorithm>
#include <cassert>

#include "host/base/parallel.h"
#include "shaders/shared/bvh_layout.h"

namespace duolux {

namespace {

constexpr std::uint32_t kSmallSubtree = 8192;  // primitives; one thread handles a small subtree

/// In double precision: single precision overflows for boxes larger than 10^19.
double halfAreaInDouble(const Aabb& box) {
    const glm::dvec3 d = glm::dvec3(box.upper) - glm::dvec3(box.lower);
    return d.x * d.y + d.y * d.z + d.z * d.x;
}

}  // namespace

CollapsePlan::CollapsePlan(const BinaryBvh& bvh) : bvh_(bvh), recordOf_(bvh.nodes.size()) {
    const double rootArea = halfAreaInDouble(bvh.nodes[0].bounds);
    inverseRootArea_ = rootArea > 0.0 ? 1.0 / rootArea : 0.0;
    records_.resize(bvh.nodes[0].count - 1);
    // Small subtrees are computed on all cores, then the nodes above them.
    std::vector<std::uint32_t> above, small, firstRecord;
    std::uint32_t records = 0;
    for (std::uint32_t i = 0; i < bvh.nodes.size();) {
        const std::uint32_t count = bvh.nodes[i].count;
        if (count > kSmallSubtree) {
            recordOf_[i] = records++;
            above.push_back(i++);
        } else {
            small.push_back(i);
            firstRecord.push_back(records);
            records += count - 1;
            i += 2 * count - 1;
        }
    }
    parallelFor(small.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            computeSubtree(small[i], firstRecord[i]);
    });
    for (std::size_t i = above.size(); i-- > 0;)
        compute(above[i]);
    sahCost_ = static_cast<double>(cost(0, 1));
}

float CollapsePlan::relativeArea(const BinaryBvh::Node& node) const {
    return static_cast<float>(halfAreaInDouble(node.bounds) * inverseRootArea_);
}

float CollapsePlan::cost(std::uint32_t node, int trees) const {
    const BinaryBvh::Node& n = bvh_.nodes[node];
    if (n.count == 1) return relativeArea(n) * kPairCost;
    return records_[recordOf_[node]].cost[static_cast<std::size_t>(trees - 1)];
}

void CollapsePlan::computeSubtree(std::uint32_t root, std::uint32_t firstRecord) {
    const std::uint32_t end = root + 2 * bvh_.nodes[root].count - 1;
    for (std::uint32_t i = root; i < end; ++i)
        recordOf_[i] = bvh_.nodes[i].count > 1 ? firstRecord++ : 0;
    // Children follow their parents, so descending indices are bottom-up.
    for (std::uint32_t i = end; i-- > root;) {
        if (bvh_.nodes[i].count > 1) compute(i);
    }
}

void CollapsePlan::compute(std::uint32_t node) {
    const BinaryBvh::Node& n = bvh_.nodes[node];
    Record& record = records_[recordOf_[node]];
    const std::uint32_t left = node + 1;
    const std::uint32_t right = n.right;
    float leftCost[7];
    float rightCost[7];
    for (int i = 0; i < 7; ++i) {
        leftCost[i] = cost(left, i + 1);
        rightCost[i] = cost(right, i + 1);
    }
    // The best distribution of `trees` trees over the two children.
    auto distribute = [&](int trees, std::uint8_t& split) {
        float best = std::numeric_limits<float>::max();
        for (int k = 1; k < trees; ++k) {
            if (k > 7 || trees - k > 7) continue;
            const float c = leftCost[k - 1] + rightCost[trees - k - 1];
            if (c < best) {
                best = c;
                split = static_cast<std::uint8_t>(k);
            }
        }
        return best;
    };
    const float area = relativeArea(n);
    const float innerCost = distribute(8, record.split[7]) + area;
    const float leafCost = n.count <= shared::kMaxLeafPairs ? area * kPairCost * static_cast<float>(n.count)
                                                            : std::numeric_limits<float>::max();
    record.split[0] = leafCost <= innerCost ? kLeaf : kInner;
    record.cost[0] = std::min(leafCost, innerCost);
    for (int i = 1; i < 7; ++i) {
        const auto index = static_cast<std::size_t>(i);
        const float c = distribute(i + 1, record.split[index]);
        if (c < record.cost[index - 1]) {
            record.cost[index] = c;
        } else {
            record.cost[index] = record.cost[index - 1];
            record.split[index] = 0;
        }
    }
}

void CollapsePlan::collect(std::uint32_t node, int trees, Children& children) const {
    const BinaryBvh::Node& n = bvh_.nodes[node];
    if (n.count > 1) {
        const Record& record = records_[recordOf_[node]];
        while (trees > 1 && record.split[static_cast<std::size_t>(trees - 1)] == 0)
            --trees;
        if (trees > 1) {
            const int toLeft = record.split[static_cast<std::size_t>(trees - 1)];
            collect(node + 1, toLeft, children);
            collect(n.right, trees - toLeft, children);
            return;
        }
        children.leaf[children.count] = record.split[0] == kLeaf;
    } else {
        children.leaf[children.count] = true;
    }
    assert(children.count < 8);
    children.node[children.count++] = node;
}

CollapsePlan::Children CollapsePlan::childrenOf(std::uint32_t binaryNode) const {
    Children children;
    const BinaryBvh::Node& n = bvh_.nodes[binaryNode];
    if (n.count == 1) {  // the root of a tree with one primitive has one leaf
        children.node[0] = binaryNode;
        children.leaf[0] = true;
        children.count = 1;
        return children;
    }
    const Record& record = records_[recordOf_[binaryNode]];
    const int toLeft = record.split[7];
    collect(binaryNode + 1, toLeft, children);
    collect(n.right, 8 - toLeft, children);
    return children;
}

}  // namespace duolux

#include "host/bvh/wide_bvh.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstring>

#include "host/base/error.h"
#include "host/base/parallel.h"
#include "host/bvh/binary_bvh.h"
#include "host/bvh/collapse.h"

namespace duolux {

namespace {

// Boxes are enlarged by this fraction of a quantisation step, so that rounding in the slab test (relative to
// the node's size) cannot make a ray miss a box whose face coincides with a step.
constexpr float kQuantisationMargin = 1.0f / 32.0f;

/// Assigns children to slots greedily, so that the sum of centre . direction(slot) over the children is
/// large.
std::array<int, 8> assignSlots(std::span<const Aabb> children, const Aabb& parent) {
    std::array<int, 8> slotOf{};
    float score[8][8];
    const glm::vec3 centre = parent.lower + parent.upper;
    for (std::size_t c = 0; c < children.size(); ++c) {
        const glm::vec3 offset = children[c].lower + children[c].upper - centre;
        for (int s = 0; s < 8; ++s) {
            score[c][s] = ((s & 4) != 0 ? offset.x : -offset.x) + ((s & 2) != 0 ? offset.y : -offset.y) +
                          ((s & 1) != 0 ? offset.z : -offset.z);
        }
    }
    unsigned freeSlots = 0xff;
    unsigned freeChildren = (1u << children.size()) - 1;
    while (freeChildren != 0) {
        float best = -std::numeric_limits<float>::infinity();
        int bestChild = -1;
        int bestSlot = -1;
        for (unsigned left = freeChildren; left != 0; left &= left - 1) {
            const int c = std::countr_zero(left);
            for (unsigned slots = freeSlots; slots != 0; slots &= slots - 1) {
                const int s = std::countr_zero(slots);
                if (bestChild < 0 || score[c][s] > best) {
                    best = score[c][s];
                    bestChild = c;
                    bestSlot = s;
                }
            }
        }
        slotOf[static_cast<std::size_t>(bestChild)] = bestSlot;
        freeChildren &= ~(1u << bestChild);
        freeSlots &= ~(1u << bestSlot);
    }
    return slotOf;
}

/// A subtree of the wide tree that is emitted separately from the nodes above it.
struct Branch {
    std::uint32_t binaryNode;  // its root
    std::uint32_t wideNode;    // index reserved for its root
    std::uint32_t level;       // of its root
    // Numbers of nodes and pairs of the top tree that precede the branch's other nodes and its pairs.
    std::uint32_t nodesBefore, pairsBefore;
};

/// Emits a wide tree in depth-first order, except that the inner children of a node are consecutive.
class Emitter {
  public:
    Emitter(const BinaryBvh& binary, const CollapsePlan& plan, std::span<const TrianglePair> pairs)
        : binary_(binary), plan_(plan), pairs_(pairs) {}

    /// Emits the tree below a binary node. Subtrees of at most `branchPairs` pairs become branches.
    WideBvh emit(std::uint32_t root, std::uint32_t branchPairs = 0) {
        struct Work {
            std::uint32_t binaryNode, wideNode, level;
        };
        std::vector<Work> stack{{root, 0, 1}};
        out_.nodes.resize(1);
        while (!stack.empty()) {
            const auto [binaryNode, wideNode, level] = stack.back();
            stack.pop_back();
            if (binary_.nodes[binaryNode].count <= branchPairs) {
                branches_.push_back({binaryNode, wideNode, level,
                                     static_cast<std::uint32_t>(out_.nodes.size()),
                                     static_cast<std::uint32_t>(out_.pairs.size())});
                continue;
            }
            out_.depth = std::max(out_.depth, level);
            const Inner inner = fill(binaryNode, wideNode);
            const std::uint32_t base = out_.nodes[wideNode].childBase;
            for (std::uint32_t i = inner.count; i-- > 0;)
                stack.push_back({inner.binaryNode[i], base + i, level + 1});
        }
        return std::move(out_);
    }

    /// In depth-first order of the whole tree.
    const std::vector<Branch>& branches() const { return branches_; }

  private:
    /// The binary nodes of a wide node's inner children, by slot.
    struct Inner {
        std::array<std::uint32_t, 8> binaryNode{};
        std::uint32_t count = 0;
    };

    /// Fills one wide node.
    Inner fill(std::uint32_t binaryNode, std::uint32_t wideNode) {
        const CollapsePlan::Children children = plan_.childrenOf(binaryNode);
        std::array<Aabb, 8> boxes;
        for (std::size_t c = 0; c < children.count; ++c)
            boxes[c] = binary_.nodes[children.node[c]].bounds;
        const Aabb& bounds = binary_.nodes[binaryNode].bounds;
        const std::array<int, 8> slotOf = assignSlots({boxes.data(), children.count}, bounds);

        shared::WideNode node{};
        node.childBase = static_cast<std::uint32_t>(out_.nodes.size());
        node.pairBase = static_cast<std::uint32_t>(out_.pairs.size());
        for (int axis = 0; axis < 3; ++axis)
            quantiseAxis(node, bounds, axis, {boxes.data(), children.count}, slotOf);

        Inner inner;
        std::uint32_t pairOffset = 0;
        for (int slot = 0; slot < 8; ++slot) {
            for (std::size_t c = 0; c < children.count; ++c) {
                if (slotOf[c] != slot) continue;
                if (!children.leaf[c]) {
                    node.meta[slot] = static_cast<std::uint8_t>(shared::kMetaInner | (24 + slot));
                    node.innerMask = static_cast<std::uint8_t>(node.innerMask | 1 << slot);
                    inner.binaryNode[inner.count++] = children.node[c];
                } else {
                    const std::uint32_t count = appendPairs(children.node[c]);
                    const std::uint32_t unary = (1u << count) - 1;
                    node.meta[slot] = static_cast<std::uint8_t>(unary << 5 | pairOffset);
                    pairOffset += count;
                }
            }
        }
        out_.nodes[wideNode] = node;
        out_.nodes.resize(out_.nodes.size() + inner.count);
        return inner;
    }

    static void quantiseAxis(shared::WideNode& node, const Aabb& bounds, int axis,
                             std::span<const Aabb> boxes, const std::array<int, 8>& slotOf) {
        const double margin = static_cast<double>(kQuantisationMargin);
        const double lower = static_cast<double>(bounds.lower[axis]);
        const double upper = static_cast<double>(bounds.upper[axis]);
        // The smallest step with which all offsets from the origin (rounded down to a float) fit into 0..255.
        int exponent = 0;
        std::frexp(std::max(upper - lower, 1e-36) / (255.0 - 4.0 * margin), &exponent);
        exponent = std::clamp(exponent + 127, 1, 254);
        float origin = 0.0f;
        double step = 0.0;
        for (;; ++exponent) {
            step = std::ldexp(1.0, exponent - 127);
            const double wanted = lower - 2.0 * margin * step;
            origin = static_cast<float>(wanted);
            if (static_cast<double>(origin) > wanted) {
                origin = std::nextafter(origin, -std::numeric_limits<float>::max());
            }
            if ((upper - static_cast<double>(origin)) / step + margin <= 255.0 || exponent == 254) break;
        }
        node.origin[axis] = origin;
        node.exponent[axis] = static_cast<std::uint8_t>(exponent);
        const double inverseStep = 1.0 / step;  // exact: a power of two
        for (std::size_t c = 0; c < boxes.size(); ++c) {
            const auto steps = [&](float x) {
                return (static_cast<double>(x) - static_cast<double>(origin)) * inverseStep;
            };
            const auto slot = static_cast<std::size_t>(slotOf[c]);
            const double first = std::clamp(steps(boxes[c].lower[axis]) - margin, 0.0, 255.0);
            const double last = std::clamp(steps(boxes[c].upper[axis]) + margin, 0.0, 255.0);
            const auto below = static_cast<std::uint8_t>(first), above = static_cast<std::uint8_t>(last);
            node.lower[axis][slot] = below;
            node.upper[axis][slot] = static_cast<std::uint8_t>(above < last ? above + 1 : above);
        }
    }

    std::uint32_t appendPairs(std::uint32_t binaryNode) {
        // A subtree over n primitives occupies the 2n - 1 nodes that start at its root.
        const std::uint32_t count = binary_.nodes[binaryNode].count;
        for (std::uint32_t i = binaryNode; i < binaryNode + 2 * count - 1; ++i) {
            if (binary_.nodes[i].count == 1) out_.pairs.push_back(pairs_[binary_.nodes[i].right]);
        }
        return count;
    }

    const BinaryBvh& binary_;
    const CollapsePlan& plan_;
    const std::span<const TrianglePair> pairs_;
    WideBvh out_;
    std::vector<Branch> branches_;
};

/// Inserts branches into the tree above them. The result equals that of a single emission, except for
/// childBase and pairBase of nodes without inner children or pairs.
class Grafter {
  public:
    Grafter(const WideBvh& top, const std::vector<Branch>& branches, const std::vector<WideBvh>& parts)
        : top_(top), branches_(branches), parts_(parts), nodesOf_{0}, pairsOf_{0} {
        for (const WideBvh& part : parts) {
            nodesOf_.push_back(nodesOf_.back() + static_cast<std::uint32_t>(part.nodes.size()) - 1);
            pairsOf_.push_back(pairsOf_.back() + static_cast<std::uint32_t>(part.pairs.size()));
        }
    }

    WideBvh graft() {
        WideBvh out;
        out.depth = top_.depth;
        out.nodes.resize(top_.nodes.size() + nodesOf_.back());
        out.pairs.resize(top_.pairs.size() + pairsOf_.back());
        for (std::uint32_t i = 0; i < top_.nodes.size(); ++i) {
            shared::WideNode node = top_.nodes[i];
            node.childBase = nodePlace(node.childBase);
            node.pairBase = pairPlace(node.pairBase);
            out.nodes[nodePlace(i)] = node;
        }
        for (std::uint32_t i = 0; i < top_.pairs.size(); ++i)
            out.pairs[pairPlace(i)] = top_.pairs[i];
        for (std::size_t b = 0; b < branches_.size(); ++b)
            out.depth = std::max(out.depth, branches_[b].level - 1 + parts_[b].depth);
        parallelFor(branches_.size(), 1, [&](std::size_t begin, std::size_t end) {
            for (std::size_t b = begin; b < end; ++b)
                place(b, out);
        });
        return out;
    }

  private:
    void place(std::size_t b, WideBvh& out) const {
        const std::uint32_t firstNode = branches_[b].nodesBefore + nodesOf_[b] - 1;  // of a root among them
        const std::uint32_t firstPair = branches_[b].pairsBefore + pairsOf_[b];
        for (std::uint32_t i = 0; i < parts_[b].nodes.size(); ++i) {
            shared::WideNode node = parts_[b].nodes[i];
            node.childBase += firstNode;
            node.pairBase += firstPair;
            out.nodes[i == 0 ? nodePlace(branches_[b].wideNode) : firstNode + i] = node;
        }
        std::copy(parts_[b].pairs.begin(), parts_[b].pairs.end(), out.pairs.begin() + firstPair);
    }

    /// The final index of a node of the top tree: it follows the branches that precede it.
    std::uint32_t nodePlace(std::uint32_t i) const {
        return i + nodesOf_[branchesUpTo(i, &Branch::nodesBefore)];
    }
    std::uint32_t pairPlace(std::uint32_t i) const {
        return i + pairsOf_[branchesUpTo(i, &Branch::pairsBefore)];
    }
    std::size_t branchesUpTo(std::uint32_t i, std::uint32_t Branch::*before) const {
        const auto after = std::upper_bound(branches_.begin(), branches_.end(), i,
                                            [&](std::uint32_t x, const Branch& b) { return x < b.*before; });
        return static_cast<std::size_t>(after - branches_.begin());
    }

    const WideBvh& top_;
    const std::vector<Branch>& branches_;
    const std::vector<WideBvh>& parts_;
    std::vector<std::uint32_t> nodesOf_, pairsOf_;  // totals of the preceding branches, without their roots
};

WideBvh emit(const BinaryBvh& binary, const CollapsePlan& plan, std::span<const TrianglePair> pairs) {
    constexpr std::uint32_t kBranchPairs = 8192;
    if (binary.nodes[0].count <= kBranchPairs) return Emitter(binary, plan, pairs).emit(0);
    Emitter above(binary, plan, pairs);
    const WideBvh top = above.emit(0, kBranchPairs);
    std::vector<WideBvh> parts(above.branches().size());
    parallelFor(parts.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            parts[i] = Emitter(binary, plan, pairs).emit(above.branches()[i].binaryNode);
    });
    return Grafter(top, above.branches(), parts).graft();
}

WideBvh build(const Geometry& geometry, std::span<const std::uint32_t> triangles, SplitMethod method) {
    const std::vector<TrianglePair> pairs = pairTriangles(geometry, triangles);
    std::vector<PrimitiveRef> refs = boxesOf(geometry, pairs);
    const BinaryBvh binary = buildBinaryBvh(refs, method);
    refs = {};
    const CollapsePlan plan(binary);
    WideBvh wide = emit(binary, plan, pairs);
    wide.sahCost = plan.sahCost();
    return wide;
}

}  // namespace

WideBvh buildWideBvh(const Geometry& geometry, std::span<const std::uint32_t> triangles) {
    assert(!triangles.empty());
    WideBvh wide = build(geometry, triangles, SplitMethod::kBinnedSah);
    // The SAH builds such a deep tree only for contrived input, for which a balanced tree is also faster.
    if (wide.depth > shared::kMaxTreeDepth) wide = build(geometry, triangles, SplitMethod::kMedian);
    if (wide.depth > shared::kMaxTreeDepth) {
        throw MachineError(fmt::format("{} triangles need a tree of more than {} levels", triangles.size(),
                                       shared::kMaxTreeDepth));
    }
    return wide;
}

WideBvh buildWideBvh(const Geometry& geometry) {
    return buildWideBvh(geometry, allTriangles(geometry));
}

}  // namespace duolux

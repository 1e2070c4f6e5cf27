#include "host/bvh/wide_bvh.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstring>
#include <numeric>

#include "host/base/error.h"
#include "host/base/parallel.h"
#include "host/bvh/binary_bvh.h"
#include "host/bvh/collapse.h"

namespace duolux {

namespace {

// Boxes are widened by this part of a quantisation step, so that rounding in the slab test (relative to the
// node's size) cannot make a ray miss a box whose face coincides with a step.
constexpr float kQuantisationMargin = 1.0f / 32.0f;

PrimitiveRef refOf(const Geometry& geometry, std::uint32_t triangle) {
    const glm::uvec3 index = geometry.triangles[triangle];
    const glm::vec3 a = geometry.positions[index.x];
    const glm::vec3 b = geometry.positions[index.y];
    const glm::vec3 c = geometry.positions[index.z];
    return {glm::min(a, glm::min(b, c)), triangle, glm::max(a, glm::max(b, c)), 0};
}

/// Places children in slots so that the sum over children of centre . direction(slot) is large: greedy
/// assignment.
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
        for (int c = 0; c < 8; ++c) {
            if ((freeChildren >> c & 1) == 0) continue;
            for (int s = 0; s < 8; ++s) {
                if ((freeSlots >> s & 1) != 0 && (bestChild < 0 || score[c][s] > best)) {
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

/// Writes the wide tree in breadth-first-per-node order: the inner children of a node are consecutive.
class Emitter {
  public:
    Emitter(const BinaryBvh& binary, const CollapsePlan& plan, WideBvh& out)
        : binary_(binary), plan_(plan), out_(out) {}

    void emit() {
        struct Work {
            std::uint32_t binaryNode, wideNode, level;
        };
        std::vector<Work> stack{{0, 0, 1}};
        out_.nodes.resize(1);
        while (!stack.empty()) {
            const Work work = stack.back();
            stack.pop_back();
            out_.depth = std::max(out_.depth, work.level);
            const std::vector<std::uint32_t> inner = fill(work.binaryNode, work.wideNode);
            const std::uint32_t base = out_.nodes[work.wideNode].childBase;
            for (std::uint32_t i = static_cast<std::uint32_t>(inner.size()); i-- > 0;) {
                stack.push_back({inner[i], base + i, work.level + 1});
            }
        }
    }

  private:
    /// Fills one wide node; returns the binary nodes of its inner children in order of slots.
    std::vector<std::uint32_t> fill(std::uint32_t binaryNode, std::uint32_t wideNode) {
        const CollapsePlan::Children children = plan_.childrenOf(binaryNode);
        std::array<Aabb, 8> boxes;
        for (std::size_t c = 0; c < children.count; ++c)
            boxes[c] = binary_.nodes[children.node[c]].bounds;
        const Aabb& bounds = binary_.nodes[binaryNode].bounds;
        const std::array<int, 8> slotOf = assignSlots({boxes.data(), children.count}, bounds);

        shared::WideNode node{};
        node.childBase = static_cast<std::uint32_t>(out_.nodes.size());
        node.triangleBase = static_cast<std::uint32_t>(out_.triangles.size());
        for (int axis = 0; axis < 3; ++axis)
            quantiseAxis(node, bounds, axis, {boxes.data(), children.count}, slotOf);

        std::vector<std::uint32_t> inner;
        std::uint32_t triangleOffset = 0;
        for (int slot = 0; slot < 8; ++slot) {
            for (std::size_t c = 0; c < children.count; ++c) {
                if (slotOf[c] != slot) continue;
                if (!children.leaf[c]) {
                    node.meta[slot] = static_cast<std::uint8_t>(shared::kMetaInner | (24 + slot));
                    node.innerMask = static_cast<std::uint8_t>(node.innerMask | 1 << slot);
                    inner.push_back(children.node[c]);
                } else {
                    const std::uint32_t count = appendTriangles(children.node[c]);
                    const std::uint32_t unary = (1u << count) - 1;
                    node.meta[slot] = static_cast<std::uint8_t>(unary << 5 | triangleOffset);
                    triangleOffset += count;
                }
            }
        }
        out_.nodes[wideNode] = node;
        out_.nodes.resize(out_.nodes.size() + inner.size());
        return inner;
    }

    static void quantiseAxis(shared::WideNode& node, const Aabb& bounds, int axis,
                             std::span<const Aabb> boxes, const std::array<int, 8>& slotOf) {
        const double margin = static_cast<double>(kQuantisationMargin);
        const double lower = static_cast<double>(bounds.lower[axis]);
        const double upper = static_cast<double>(bounds.upper[axis]);
        // The smallest step with which all fits into 0..255, the origin rounded down to a float included.
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
        for (std::size_t c = 0; c < boxes.size(); ++c) {
            const auto steps = [&](float x) {
                return (static_cast<double>(x) - static_cast<double>(origin)) / step;
            };
            const auto slot = static_cast<std::size_t>(slotOf[c]);
            const double first = std::floor(steps(boxes[c].lower[axis]) - margin);
            const double last = std::ceil(steps(boxes[c].upper[axis]) + margin);
            node.lower[axis][slot] = static_cast<std::uint8_t>(std::clamp(first, 0.0, 255.0));
            node.upper[axis][slot] = static_cast<std::uint8_t>(std::clamp(last, 0.0, 255.0));
        }
    }

    std::uint32_t appendTriangles(std::uint32_t binaryNode) {
        // The leaves of a subtree of n primitives are among the 2n - 1 nodes from its root on.
        const std::uint32_t count = binary_.nodes[binaryNode].count;
        for (std::uint32_t i = binaryNode; i < binaryNode + 2 * count - 1; ++i) {
            if (binary_.nodes[i].count == 1) out_.triangles.push_back(binary_.nodes[i].right);
        }
        return count;
    }

    const BinaryBvh& binary_;
    const CollapsePlan& plan_;
    WideBvh& out_;
};

WideBvh build(const Geometry& geometry, std::span<const std::uint32_t> triangles, SplitMethod method) {
    std::vector<PrimitiveRef> refs(triangles.size());
    parallelFor(refs.size(), 1 << 16, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            refs[i] = refOf(geometry, triangles[i]);
    });
    const BinaryBvh binary = buildBinaryBvh(refs, method);
    refs = {};
    const CollapsePlan plan(binary);
    WideBvh wide;
    wide.triangles.reserve(triangles.size());
    wide.sahCost = plan.sahCost();
    Emitter(binary, plan, wide).emit();
    return wide;
}

}  // namespace

WideBvh buildWideBvh(const Geometry& geometry, std::span<const std::uint32_t> triangles) {
    assert(!triangles.empty());
    WideBvh wide = build(geometry, triangles, SplitMethod::kBinnedSah);
    // Only contrived input makes the SAH build a chain this long; a balanced tree is then the better one,
    // too.
    if (wide.depth > shared::kMaxTreeDepth) wide = build(geometry, triangles, SplitMethod::kMedian);
    if (wide.depth > shared::kMaxTreeDepth) {
        throw MachineError(fmt::format("{} triangles make a tree of more than {} levels", triangles.size(),
                                       shared::kMaxTreeDepth));
    }
    return wide;
}

WideBvh buildWideBvh(const Geometry& geometry) {
    std::vector<std::uint32_t> all(geometry.triangles.size());
    std::iota(all.begin(), all.end(), 0u);
    return buildWideBvh(geometry, all);
}

}  // namespace duolux

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "host/bvh/wide_bvh.h"

namespace duolux {

namespace {

struct Box {
    glm::dvec3 lower{1e300}, upper{-1e300};

    bool contains(const glm::dvec3& p) const {
        return glm::all(glm::lessThanEqual(lower, p)) && glm::all(glm::lessThanEqual(p, upper));
    }
};

Box childBox(const shared::WideNode& node, std::size_t slot) {
    Box box;
    for (int axis = 0; axis < 3; ++axis) {
        const double step = std::ldexp(1.0, node.exponent[axis] - 127);
        box.lower[axis] = static_cast<double>(node.origin[axis]) + node.lower[axis][slot] * step;
        box.upper[axis] = static_cast<double>(node.origin[axis]) + node.upper[axis][slot] * step;
    }
    return box;
}

class Audit {
  public:
    Audit(const WideBvh& bvh, const Geometry& geometry, std::span<const std::uint32_t> triangles)
        : bvh_(bvh),
          geometry_(geometry),
          triangles_(triangles),
          nodeSeen_(bvh.nodes.size()),
          pairSeen_(bvh.pairs.size()) {}

    std::vector<std::string> run() {
        visit(0, 1, {});
        for (std::size_t i = 0; i < nodeSeen_.size(); ++i) {
            if (nodeSeen_[i] != 1) fail("node {} is reached {} times", i, nodeSeen_[i]);
        }
        for (std::size_t i = 0; i < pairSeen_.size(); ++i) {
            if (pairSeen_[i] != 1) fail("leaf entry {} is referred to {} times", i, pairSeen_[i]);
        }
        std::vector<int> uses(geometry_.triangles.size());
        for (const TrianglePair& pair : bvh_.pairs) {
            bool inRange = true;
            for (std::uint32_t t : trianglesOf(pair)) {
                if (t < uses.size()) {
                    ++uses[t];
                } else {
                    fail("triangle index {} is out of range", t);
                    inRange = false;
                }
            }
            if (inRange && !cornersOf(geometry_, pair))
                fail("triangles {} and {} have no common edge", pair.first, pair.second);
        }
        for (std::uint32_t t : triangles_)
            --uses[t];
        for (std::size_t t = 0; t < uses.size(); ++t) {
            if (uses[t] != 0) fail("triangle {} is in {} leaves too many", t, uses[t]);
        }
        if (deepest_ != bvh_.depth) fail("depth is {}, not {}", deepest_, bvh_.depth);
        if (deepest_ > shared::kMaxTreeDepth)
            fail("depth {} is over the limit {}", deepest_, shared::kMaxTreeDepth);
        return std::move(problems_);
    }

  private:
    static std::vector<std::uint32_t> trianglesOf(const TrianglePair& pair) {
        return pair.isSingle() ? std::vector{pair.first} : std::vector{pair.first, pair.second};
    }

    template <typename... Args>
    void fail(fmt::format_string<Args...> format, Args&&... args) {
        if (problems_.size() < 32) problems_.push_back(fmt::format(format, std::forward<Args>(args)...));
    }

    /// `ancestors`: the child boxes on the path from the root; they must all contain every triangle below.
    void visit(std::size_t index, std::uint32_t level, const std::vector<Box>& ancestors) {
        if (index >= bvh_.nodes.size()) return fail("node index {} is out of range", index);
        if (nodeSeen_[index]++ != 0) return;
        deepest_ = std::max(deepest_, level);
        const shared::WideNode& node = bvh_.nodes[index];
        std::uint32_t innerBefore = 0;
        for (std::size_t slot = 0; slot < 8; ++slot) {
            const std::uint8_t meta = node.meta[slot];
            const bool inner = (node.innerMask >> slot & 1) != 0;
            if (meta == 0) {
                if (inner) fail("node {} slot {}: empty, but in the inner mask", index, slot);
                continue;
            }
            std::vector<Box> boxes = ancestors;
            boxes.push_back(childBox(node, slot));
            if (inner) {
                if (meta != (shared::kMetaInner | (24 + slot)))
                    fail("node {} slot {}: meta {:#x}", index, slot, meta);
                visit(node.childBase + innerBefore++, level + 1, boxes);
                continue;
            }
            const unsigned unary = meta >> 5;
            if (unary != 1 && unary != 3 && unary != 7)
                fail("node {} slot {}: meta {:#x}", index, slot, meta);
            for (int i = 0; i < std::popcount(unary); ++i)
                leafEntry(node.pairBase + (meta & 31) + static_cast<std::uint32_t>(i), boxes);
        }
    }

    void leafEntry(std::size_t entry, const std::vector<Box>& boxes) {
        if (entry >= bvh_.pairs.size()) return fail("leaf entry {} is out of range", entry);
        ++pairSeen_[entry];
        for (const std::uint32_t triangle : trianglesOf(bvh_.pairs[entry])) {
            if (triangle >= geometry_.triangles.size()) continue;
            for (int k = 0; k < 3; ++k) {
                const glm::dvec3 p = geometry_.positions[geometry_.triangles[triangle][k]];
                for (std::size_t level = 0; level < boxes.size(); ++level) {
                    if (!boxes[level].contains(p))
                        fail("triangle {} sticks out of its box at level {}", triangle, level);
                }
            }
        }
    }

    const WideBvh& bvh_;
    const Geometry& geometry_;
    std::span<const std::uint32_t> triangles_;
    std::vector<int> nodeSeen_, pairSeen_;
    std::uint32_t deepest_ = 0;
    std::vector<std::string> problems_;
};

}  // namespace

std::vector<std::string> auditWideBvh(const WideBvh& bvh, const Geometry& geometry,
                                      std::span<const std::uint32_t> triangles) {
    return Audit(bvh, geometry, triangles).run();
}

}  // namespace duolux

#include "host/loaders/clip_ears.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <optional>
#include <set>
#include <span>

namespace duolux {

namespace {

/// Points on the border are inside, except the corners of the triangle.
bool contains(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c, const glm::dvec2& p) {
    if (p == a || p == b || p == c) return false;
    return turnAt(a, b, p) >= 0.0 && turnAt(b, c, p) >= 0.0 && turnAt(c, a, p) >= 0.0;
}

/// A k-d tree over points that can be enabled and disabled. Node i has the children 2 i and 2 i + 1.
class PointTree {
  public:
    explicit PointTree(const std::vector<glm::dvec2>& points) : points_(points), order_(points.size()) {
        std::iota(order_.begin(), order_.end(), 0u);
        std::size_t nodes = 2;
        while (nodes * kLeaf < 2 * points.size())
            nodes *= 2;
        nodes_.resize(2 * nodes);
        leafOf_.resize(points.size());
        on_.assign(points.size(), false);
        constexpr double kRounding = 32.0 * std::numeric_limits<double>::epsilon();
        for (const glm::dvec2& point : points)
            slack_ = std::max({slack_, kRounding * std::abs(point.x), kRounding * std::abs(point.y)});
        build(1, 0, points.size());
    }

    void set(std::uint32_t point, bool on) {
        if (on_[point] == on) return;
        on_[point] = on;
        for (std::size_t node = leafOf_[point]; node > 0; node /= 2)
            nodes_[node].on += on ? 1 : -1;
    }

    /// An enabled point inside the counter-clockwise triangle, if any.
    std::optional<std::uint32_t> findIn(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) const {
        std::size_t stack[64];
        std::size_t depth = 0;
        stack[depth++] = 1;
        while (depth > 0) {
            const std::size_t index = stack[--depth];
            const Node& node = nodes_[index];
            if (node.on == 0 || !mayOverlap(node, a, b, c)) continue;
            // Several points may coincide with a corner.
            if (node.lower == node.upper && !contains(a, b, c, node.lower)) continue;
            if (node.isLeaf) {
                for (std::size_t i = node.begin; i < node.end; ++i) {
                    const std::uint32_t point = order_[i];
                    if (on_[point] && contains(a, b, c, points_[point])) return point;
                }
                continue;
            }
            stack[depth++] = 2 * index;
            stack[depth++] = 2 * index + 1;
        }
        return std::nullopt;
    }

  private:
    static constexpr std::size_t kLeaf = 8;

    /// Each node has two boxes, one along the axes and one along the main direction of its points: a long
    /// thin triangle along a slanting line of points would intersect all axis-aligned boxes there.
    struct Node {
        glm::dvec2 lower, upper;
        glm::dvec2 along{1.0, 0.0};         ///< unit length
        glm::dvec2 ownLower, ownUpper;      ///< (along, across)
        std::array<glm::dvec2, 4> corners;  ///< of the box along the main direction
        std::size_t begin = 0, end = 0;     ///< in order_
        std::ptrdiff_t on = 0;              ///< number of enabled points
        bool isLeaf = true;

        double area() const { return (ownUpper.x - ownLower.x) * (ownUpper.y - ownLower.y); }
        glm::dvec2 own(const glm::dvec2& p) const {
            return {along.x * p.x + along.y * p.y, along.x * p.y - along.y * p.x};
        }
    };

    void build(std::size_t index, std::size_t begin, std::size_t end) {
        Node& node = nodes_[index];
        node.begin = begin;
        node.end = end;
        bound(node);
        node.isLeaf = end - begin <= kLeaf;
        if (node.isLeaf) {
            for (std::size_t i = begin; i < end; ++i)
                leafOf_[order_[i]] = index;
            return;
        }
        const std::size_t middle = begin + (end - begin) / 2;
        split(node);
        build(2 * index, begin, middle);
        build(2 * index + 1, middle, end);
    }

    /// Halves the points of a node along the longer axis, or across their main direction if the halves then
    /// cover much less area: the two sides of a long strip are better apart.
    void split(const Node& node) {
        const glm::dvec2 size = node.upper - node.lower;
        const int axis = size.x >= size.y ? 0 : 1;
        const double lengthwise = halve(node, [&](const glm::dvec2& point) { return point[axis]; });
        constexpr double kMuchLess = 0.5;
        if (lengthwise <= kMuchLess * node.area()) return;
        const double across = halve(node, [&](const glm::dvec2& point) { return node.own(point).y; });
        if (across > kMuchLess * lengthwise)
            halve(node, [&](const glm::dvec2& point) { return point[axis]; });
    }

    /// Halves the points of a node by a coordinate. Returns the area of the two boxes along the main
    /// directions of the halves.
    template <typename Coordinate>
    double halve(const Node& node, const Coordinate& coordinate) {
        const std::size_t middle = node.begin + (node.end - node.begin) / 2;
        const auto at = [&](std::size_t i) { return order_.begin() + static_cast<std::ptrdiff_t>(i); };
        // Ties are broken by index, so that the tree does not depend on the standard library.
        std::nth_element(at(node.begin), at(middle), at(node.end), [&](std::uint32_t p, std::uint32_t q) {
            const double x = coordinate(points_[p]), y = coordinate(points_[q]);
            return x < y || (x == y && p < q);
        });
        Node left, right;
        left.begin = node.begin;
        left.end = right.begin = middle;
        right.end = node.end;
        bound(left);
        bound(right);
        return left.area() + right.area();
    }

    void bound(Node& node) const {
        glm::dvec2 mean(0.0);
        node.lower = node.upper = points_[order_[node.begin]];
        for (std::size_t i = node.begin; i < node.end; ++i) {
            const glm::dvec2& point = points_[order_[i]];
            node.lower = glm::min(node.lower, point);
            node.upper = glm::max(node.upper, point);
            mean += point / static_cast<double>(node.end - node.begin);
        }
        // The main direction of the points: the eigenvector of the larger eigenvalue of their covariance.
        double xx = 0.0, xy = 0.0, yy = 0.0;
        for (std::size_t i = node.begin; i < node.end; ++i) {
            const glm::dvec2 d = points_[order_[i]] - mean;
            xx += d.x * d.x;
            xy += d.x * d.y;
            yy += d.y * d.y;
        }
        const double angle = 0.5 * std::atan2(2.0 * xy, xx - yy);
        node.along = {std::cos(angle), std::sin(angle)};
        node.ownLower = node.ownUpper = node.own(points_[order_[node.begin]]);
        for (std::size_t i = node.begin; i < node.end; ++i) {
            node.ownLower = glm::min(node.ownLower, node.own(points_[order_[i]]));
            node.ownUpper = glm::max(node.ownUpper, node.own(points_[order_[i]]));
        }
        // The margin ensures that rounding leaves no point outside.
        node.ownLower -= slack_;
        node.ownUpper += slack_;
        const auto corner = [&](double u, double v) {
            return glm::dvec2(node.along.x * u - node.along.y * v, node.along.y * u + node.along.x * v);
        };
        node.corners = {corner(node.ownLower.x, node.ownLower.y), corner(node.ownUpper.x, node.ownLower.y),
                        corner(node.ownUpper.x, node.ownUpper.y), corner(node.ownLower.x, node.ownUpper.y)};
    }

    static bool areApart(const glm::dvec2& lower, const glm::dvec2& upper, const glm::dvec2& a,
                         const glm::dvec2& b, const glm::dvec2& c) {
        return glm::any(glm::lessThan(glm::max(glm::max(a, b), c), lower)) ||
               glm::any(glm::lessThan(upper, glm::min(glm::min(a, b), c)));
    }

    /// False if a side of the triangle, or of one of the boxes, separates triangle and boxes.
    static bool mayOverlap(const Node& box, const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
        return !areApart(box.lower, box.upper, a, b, c) &&
               !areApart(box.ownLower, box.ownUpper, box.own(a), box.own(b), box.own(c)) &&
               !isBeyond(box, a, b) && !isBeyond(box, b, c) && !isBeyond(box, c, a);
    }

    /// Whether all corners of the box, and therefore all its points, are on the outer side.
    static bool isBeyond(const Node& box, const glm::dvec2& from, const glm::dvec2& to) {
        return std::all_of(box.corners.begin(), box.corners.end(),
                           [&](const glm::dvec2& corner) { return turnAt(from, to, corner) < 0.0; });
    }

    const std::vector<glm::dvec2>& points_;
    std::vector<std::uint32_t> order_;
    std::vector<Node> nodes_;
    std::vector<std::size_t> leafOf_;
    std::vector<bool> on_;
    double slack_ = 0.0;
};

class EarClipper {
  public:
    explicit EarClipper(const std::vector<glm::dvec2>& points)
        : points_(points), tree_(points), count_(static_cast<std::uint32_t>(points.size())) {
        corners_.resize(count_);
        blocks_.assign(count_, {});
        blocker_.assign(count_, kNone);
        for (std::uint32_t i = 0; i < count_; ++i)
            corners_[i] = {(i + count_ - 1) % count_, (i + 1) % count_};
        for (std::uint32_t i = 0; i < count_; ++i)
            updateTurn(i);
        for (std::uint32_t i = 0; i < count_; ++i)
            updateEar(i);
    }

    void run(std::vector<std::array<std::uint32_t, 3>>& triangles) {
        std::uint32_t from = 0;
        for (std::uint32_t left = count_; left > 3; --left) {
            const std::uint32_t ear = chooseCorner(from);
            triangles.push_back({corners_[ear].previous, ear, corners_[ear].next});
            // Leaving out the next corner prevents all triangles from sharing the previous one.
            from = corners_[corners_[ear].next].next;
            remove(ear);
        }
        // The last three corners, in the order of the polygon.
        std::array<std::uint32_t, 3> rest{corners_[from].previous, from, corners_[from].next};
        std::sort(rest.begin(), rest.end());
        triangles.push_back(rest);
    }

  private:
    struct Corner {
        std::uint32_t previous, next;
        double turn = 0.0;
    };

    std::uint32_t chooseCorner(std::uint32_t from) {
        while (const auto ear = firstFrom(ears_, from)) {
            // Corners that have become reflex since then may lie inside the ear.
            if (!findBlocker(*ear)) return *ear;
            updateEar(*ear);
        }
        return firstFrom(straight_, from).value_or(from);
    }

    /// The first corner of the set from `from` on, cyclically.
    static std::optional<std::uint32_t> firstFrom(const std::set<std::uint32_t>& set, std::uint32_t from) {
        if (set.empty()) return std::nullopt;
        const auto found = set.lower_bound(from);
        return found == set.end() ? *set.begin() : *found;
    }

    void remove(std::uint32_t corner) {
        const auto [previous, next, turn] = corners_[corner];
        corners_[previous].next = next;
        corners_[next].previous = previous;
        ears_.erase(corner);
        straight_.erase(corner);
        corners_[corner].turn = 0.0;
        isGone(corner);
        updateTurn(previous);
        updateTurn(next);
        updateEar(previous);
        updateEar(next);
        retry();
    }

    void updateTurn(std::uint32_t i) {
        Corner& corner = corners_[i];
        corner.turn = turnAt(points_[corner.previous], points_[i], points_[corner.next]);
        if (corner.turn == 0.0) {
            straight_.insert(i);
        } else {
            straight_.erase(i);
        }
        if (corner.turn <= 0.0) {
            tree_.set(i, true);
        } else {
            isGone(i);
        }
    }

    /// Removes a corner from the tree, and unblocks the corners that it has blocked.
    void isGone(std::uint32_t corner) {
        tree_.set(corner, false);
        for (const std::uint32_t other : blocks_[corner]) {
            if (blocker_[other] != corner) continue;  // another corner blocks it now
            blocker_[other] = kNone;
            retry_.push_back(other);
        }
        blocks_[corner] = {};
    }

    void retry() {
        for (const std::uint32_t corner : retry_) {
            if (corners_[corner].turn > 0.0 && !ears_.contains(corner)) updateEar(corner);
        }
        retry_.clear();
    }

    /// A reflex or straight corner inside the triangle that would be cut off, if any.
    std::optional<std::uint32_t> findBlocker(std::uint32_t i) const {
        const Corner& corner = corners_[i];
        return tree_.findIn(points_[corner.previous], points_[i], points_[corner.next]);
    }

    void updateEar(std::uint32_t i) {
        ears_.erase(i);
        const std::uint32_t before = blocker_[i];
        blocker_[i] = kNone;
        if (corners_[i].turn <= 0.0) return;
        if (const auto blocker = findBlocker(i)) {
            blocker_[i] = *blocker;
            if (*blocker != before) blocks_[*blocker].push_back(i);
        } else {
            ears_.insert(i);
        }
    }

    static constexpr std::uint32_t kNone = 0xffffffffu;

    const std::vector<glm::dvec2>& points_;
    PointTree tree_;  ///< of the reflex and straight corners
    std::uint32_t count_;
    std::vector<Corner> corners_;
    std::set<std::uint32_t> ears_, straight_;
    std::vector<std::uint32_t> blocker_;  ///< per corner: the corner that prevents it from being an ear
    std::vector<std::vector<std::uint32_t>> blocks_;  ///< per corner: those that it blocks, or has blocked
    std::vector<std::uint32_t> retry_;
};

}  // namespace

void clipEars(const std::vector<glm::dvec2>& points, std::vector<std::array<std::uint32_t, 3>>& triangles) {
    EarClipper(points).run(triangles);
}

}  // namespace duolux

#include "host/device_scene/flat_triangles.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <optional>
#include <span>

namespace duolux {

DisjointSets::DisjointSets(std::size_t count) : parents_(count) {
    std::iota(parents_.begin(), parents_.end(), 0u);
}

std::uint32_t DisjointSets::rootOf(std::uint32_t number) {
    while (parents_[number] != number) {
        parents_[number] = parents_[parents_[number]];
        number = parents_[number];
    }
    return number;
}

void DisjointSets::unite(std::uint32_t a, std::uint32_t b) {
    const std::uint32_t rootA = rootOf(a), rootB = rootOf(b);
    parents_[std::max(rootA, rootB)] = std::min(rootA, rootB);
}

namespace {

double cross(const glm::dvec2& a, const glm::dvec2& b) {
    return a.x * b.y - a.y * b.x;
}

/// A convex polygon, counter-clockwise.
using Polygon = std::vector<glm::dvec2>;

/// Andrew's monotone chain.
Polygon hullOf(Polygon points) {
    std::sort(points.begin(), points.end(),
              [](const auto& a, const auto& b) { return a.x < b.x || (a.x == b.x && a.y < b.y); });
    points.erase(std::unique(points.begin(), points.end()), points.end());
    if (points.size() < 3) return points;
    Polygon hull;
    const auto add = [&](const glm::dvec2& p, std::size_t chain) {
        while (hull.size() >= chain + 2 &&
               cross(hull.back() - hull[hull.size() - 2], p - hull[hull.size() - 2]) <= 0.0)
            hull.pop_back();
        hull.push_back(p);
    };
    for (const glm::dvec2& p : points)
        add(p, 0);
    const std::size_t upper = hull.size() - 1;
    for (std::size_t i = points.size() - 1; i-- > 0;)
        add(points[i], upper);
    hull.pop_back();
    return hull;
}

/// A corner in place of an edge, where the edges beside it meet, and the area that this adds.
struct Replacement {
    glm::dvec2 corner;
    double area;
};

/// Empty if the edges beside edge i do not meet beyond it.
std::optional<Replacement> withoutEdge(const Polygon& polygon, std::size_t i) {
    const std::size_t n = polygon.size();
    const glm::dvec2 &begin = polygon[i], &end = polygon[(i + 1) % n];
    const glm::dvec2 before = begin - polygon[(i + n - 1) % n], after = polygon[(i + 2) % n] - end;
    const double turn = cross(before, after);
    if (!(turn > 0.0)) return std::nullopt;
    const double along = cross(end - begin, after) / turn, back = cross(end - begin, before) / -turn;
    if (!(along >= 0.0 && back >= 0.0 && std::isfinite(along))) return std::nullopt;
    const glm::dvec2 corner = begin + along * before;
    return Replacement{corner, std::abs(cross(end - begin, corner - begin))};
}

/// A polygon of at most `most` corners that contains the given one and extends little beyond it.
void simplify(Polygon& polygon, std::size_t most) {
    while (polygon.size() > most) {
        std::optional<Replacement> least;
        std::size_t edge = 0;
        for (std::size_t i = 0; i < polygon.size(); ++i) {
            const auto replacement = withoutEdge(polygon, i);
            if (!replacement || (least && replacement->area >= least->area)) continue;
            least = replacement;
            edge = i;
        }
        if (!least) {  // only if all corners are in one line within rounding
            glm::dvec2 lower = polygon[0], upper = polygon[0];
            for (const glm::dvec2& p : polygon) {
                lower = glm::min(lower, p);
                upper = glm::max(upper, p);
            }
            polygon = {lower, {upper.x, lower.y}, upper, {lower.x, upper.y}};
            return;
        }
        polygon[edge] = least->corner;
        polygon.erase(polygon.begin() + static_cast<std::ptrdiff_t>((edge + 1) % polygon.size()));
    }
}

/// Whether a line along an edge of `a` separates the polygons but for the tolerance.
bool isSeparatedByEdge(const Polygon& a, const Polygon& b, double tolerance) {
    for (std::size_t i = 0; i < a.size(); ++i) {
        const glm::dvec2 edge = a[(i + 1) % a.size()] - a[i], outward(edge.y, -edge.x);
        const double limit = glm::dot(outward, a[i]) - tolerance * glm::length(edge);
        const auto isBeyond = [&](const glm::dvec2& p) { return glm::dot(outward, p) >= limit; };
        if (edge != glm::dvec2(0.0) && std::all_of(b.begin(), b.end(), isBeyond)) return true;
    }
    return false;
}

/// A binary tree over the triangles, whose nodes have convex polygons around them: unlike boxes, those of
/// neighbours in a fan of slender triangles are disjoint.
class OverlapTree {
  public:
    using Compare = std::function<void(const FlatTriangle&, const FlatTriangle&)>;

    OverlapTree(std::span<const FlatTriangle> triangles, double tolerance, double most, DisjointSets& sets,
                const Compare& compare)
        : triangles_(triangles), tolerance_(tolerance), most_(most), sets_(sets), compare_(compare) {}

    void run() {
        order_.resize(triangles_.size());
        std::iota(order_.begin(), order_.end(), 0u);
        build(0, static_cast<std::uint32_t>(order_.size()));
        compareWithin(0);
    }

  private:
    static constexpr std::uint32_t kLeaf = 4;    // triangles
    static constexpr std::size_t kCorners = 12;  // of a polygon

    struct Node {
        std::uint32_t begin, end;  ///< triangles, in order_
        std::uint32_t right = 0;   ///< the second child; the first is the next node. 0: none
        bool united = false;       ///< whether all triangles are known to be in one set
        double extent = 0.0, lowest = 0.0, highest = 0.0;
        Polygon polygon;
    };

    /// The height is the third coordinate.
    glm::dvec3 centreOf(std::uint32_t i) const {
        const FlatTriangle& t = triangles_[i];
        return 0.5 * (glm::dvec3(t.lower, t.lowest) + glm::dvec3(t.upper, t.highest));
    }

    std::uint32_t build(std::uint32_t begin, std::uint32_t end) {
        const auto index = static_cast<std::uint32_t>(nodes_.size());
        nodes_.push_back({begin, end, 0, false, 0.0, 0.0, 0.0, {}});
        Polygon points;
        if (end - begin <= kLeaf) {
            for (std::uint32_t i = begin; i < end; ++i) {
                const auto& corners = triangles_[order_[i]].corners;
                points.insert(points.end(), corners.begin(), corners.end());
            }
        } else {
            const std::uint32_t middle = begin + (end - begin) / 2;
            split(begin, middle, end);
            build(begin, middle);
            const std::uint32_t right = build(middle, end);
            nodes_[index].right = right;
            points = nodes_[index + 1].polygon;
            points.insert(points.end(), nodes_[right].polygon.begin(), nodes_[right].polygon.end());
        }
        Node& node = nodes_[index];
        node.polygon = hullOf(std::move(points));
        simplify(node.polygon, kCorners);
        for (const glm::dvec2& p : node.polygon)
            node.extent = std::max(node.extent, glm::distance(p, node.polygon[0]));
        node.lowest = node.highest = triangles_[order_[begin]].lowest;
        for (std::uint32_t i = begin; i < end; ++i) {
            node.lowest = std::min(node.lowest, triangles_[order_[i]].lowest);
            node.highest = std::max(node.highest, triangles_[order_[i]].highest);
        }
        return index;
    }

    /// Parts layers of triangles first.
    void split(std::uint32_t begin, std::uint32_t middle, std::uint32_t end) {
        glm::dvec3 lower = centreOf(order_[begin]), upper = lower;
        for (std::uint32_t i = begin; i < end; ++i) {
            lower = glm::min(lower, centreOf(order_[i]));
            upper = glm::max(upper, centreOf(order_[i]));
        }
        const glm::dvec3 sides = upper - lower;
        const int axis = sides.z > most_ ? 2 : (sides.x >= sides.y ? 0 : 1);
        const auto at = [&](std::uint32_t i) { return order_.begin() + static_cast<std::ptrdiff_t>(i); };
        std::nth_element(at(begin), at(middle), at(end), [&](std::uint32_t a, std::uint32_t b) {
            const double x = centreOf(a)[axis], y = centreOf(b)[axis];
            return x < y || (x == y && a < b);
        });
    }

    std::uint32_t firstSet(const Node& node) { return sets_.rootOf(triangles_[order_[node.begin]].triangle); }

    /// Whether all triangles of a node are known to be in one set.
    bool isUnited(Node& node) {
        if (node.united) return true;
        if (node.right == 0) {
            const std::uint32_t set = firstSet(node);
            node.united =
                std::all_of(order_.begin() + node.begin, order_.begin() + node.end,
                            [&](std::uint32_t i) { return sets_.rootOf(triangles_[i].triangle) == set; });
        } else {
            const Node &left = *(&node + 1), &right = nodes_[node.right];
            node.united = left.united && right.united && firstSet(left) == firstSet(right);
        }
        return node.united;
    }

    void compareIfSeparate(std::uint32_t i, std::uint32_t j) {
        const FlatTriangle &a = triangles_[i], &b = triangles_[j];
        if (sets_.rootOf(a.triangle) == sets_.rootOf(b.triangle)) return;
        if (a.triangle > b.triangle) {
            compare_(a, b);
        } else {
            compare_(b, a);
        }
    }

    void compareWithin(std::uint32_t index) {
        Node& node = nodes_[index];
        if (node.right != 0) {
            compareWithin(index + 1);
            compareWithin(node.right);
            compareBetween(index + 1, node.right);
        } else {
            for (std::uint32_t i = node.begin; i < node.end; ++i) {
                for (std::uint32_t j = node.begin; j < i; ++j)
                    compareIfSeparate(order_[i], order_[j]);
            }
        }
        isUnited(node);
    }

    void compareBetween(std::uint32_t indexA, std::uint32_t indexB) {
        Node &a = nodes_[indexA], &b = nodes_[indexB];
        if (isUnited(a) && isUnited(b) && firstSet(a) == firstSet(b)) return;
        if (std::max(a.lowest, b.lowest) - std::min(a.highest, b.highest) >= most_ ||
            isSeparatedByEdge(a.polygon, b.polygon, tolerance_) ||
            isSeparatedByEdge(b.polygon, a.polygon, tolerance_))
            return;
        if (a.right == 0 && b.right == 0) {
            for (std::uint32_t i = a.begin; i < a.end; ++i) {
                for (std::uint32_t j = b.begin; j < b.end; ++j)
                    compareIfSeparate(order_[i], order_[j]);
            }
        } else if (b.right == 0 || (a.right != 0 && a.extent >= b.extent)) {
            compareBetween(indexA + 1, indexB);
            compareBetween(a.right, indexB);
        } else {
            compareBetween(indexA, indexB + 1);
            compareBetween(indexA, b.right);
        }
        isUnited(a);
        isUnited(b);
    }

    std::span<const FlatTriangle> triangles_;
    double tolerance_, most_;
    DisjointSets& sets_;
    const Compare& compare_;
    std::vector<std::uint32_t> order_;
    std::vector<Node> nodes_;
};

}  // namespace

void compareOverlapping(std::span<const FlatTriangle> triangles, double tolerance, double most,
                        DisjointSets& sets,
                        const std::function<void(const FlatTriangle&, const FlatTriangle&)>& compare) {
    if (!triangles.empty()) OverlapTree(triangles, tolerance, most, sets, compare).run();
}

}  // namespace duolux

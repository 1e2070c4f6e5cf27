#include "host/bvh/pairs.h"

#include <algorithm>
#include <limits>
#include <numeric>

#include "host/base/parallel.h"

namespace duolux {

namespace {

Aabb boundsOf(const Geometry& geometry, std::uint32_t triangle) {
    Aabb box;
    for (int k = 0; k < 3; ++k) {
        const glm::vec3 corner = geometry.positions[geometry.triangles[triangle][k]];
        box.grow({corner, corner});
    }
    return box;
}

/// The edges of a list of triangles, grouped by their first vertex.
class Edges {
  public:
    struct Edge {
        std::uint32_t end;    // position of the second vertex
        std::uint32_t owner;  // index of the triangle in the list
    };

    Edges(const Geometry& geometry, std::span<const std::uint32_t> triangles)
        : first_(geometry.positions.size() + 1), edges_(3 * triangles.size()) {
        for (const std::uint32_t triangle : triangles) {
            for (int k = 0; k < 3; ++k)
                ++first_[geometry.triangles[triangle][k]];
        }
        std::uint32_t sum = 0;
        for (std::uint32_t& first : first_)
            first = sum += first;
        for (std::size_t i = triangles.size(); i-- > 0;) {
            const glm::uvec3 corners = geometry.triangles[triangles[i]];
            for (int k = 0; k < 3; ++k)
                edges_[--first_[corners[k]]] = {corners[(k + 1) % 3], static_cast<std::uint32_t>(i)};
        }
        for (std::size_t i = 0; i + 1 < first_.size(); ++i) {
            if (first_[i + 1] - first_[i] > kFew)
                std::ranges::stable_sort(edges_.begin() + first_[i], edges_.begin() + first_[i + 1], {},
                                         &Edge::end);
        }
    }

    /// The edges between two positions in the order of the list, among a few others that start at `begin`.
    std::span<const Edge> between(std::uint32_t begin, std::uint32_t end) const {
        const std::span<const Edge> all(edges_.data() + first_[begin], edges_.data() + first_[begin + 1]);
        if (all.size() <= kFew) return all;
        const auto found = std::ranges::equal_range(all, end, {}, &Edge::end);
        return {found.begin(), found.end()};
    }

  private:
    static constexpr std::uint32_t kFew = 32;  // edges that are searched one by one

    std::vector<std::uint32_t> first_;
    std::vector<Edge> edges_;
};

}  // namespace

std::vector<TrianglePair> pairTriangles(const Geometry& geometry, std::span<const std::uint32_t> triangles) {
    const Edges edges(geometry, triangles);
    std::vector<char> taken(triangles.size());
    std::vector<TrianglePair> pairs;
    pairs.reserve(triangles.size() / 2 + 1);
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        if (taken[i] != 0) continue;
        taken[i] = 1;
        const glm::uvec3 corners = geometry.triangles[triangles[i]];
        const Aabb box = boundsOf(geometry, triangles[i]);
        std::optional<std::uint32_t> best;
        float smallest = std::numeric_limits<float>::infinity();
        for (int k = 0; k < 3; ++k) {
            for (const Edges::Edge& edge : edges.between(corners[(k + 1) % 3], corners[k])) {
                if (edge.end != corners[k] || taken[edge.owner] != 0) continue;
                const Aabb other = boundsOf(geometry, triangles[edge.owner]);
                Aabb both = box;
                both.grow(other);
                const float area = both.halfArea();
                if (area >= smallest || area > box.halfArea() + other.halfArea()) continue;
                smallest = area;
                best = edge.owner;
            }
        }
        pairs.push_back({triangles[i], best ? triangles[*best] : TrianglePair::kNone});
        if (best) taken[*best] = 1;
    }
    return pairs;
}

std::vector<std::uint32_t> allTriangles(const Geometry& geometry) {
    std::vector<std::uint32_t> all(geometry.triangles.size());
    std::iota(all.begin(), all.end(), 0u);
    return all;
}

std::vector<PrimitiveRef> boxesOf(const Geometry& geometry, std::span<const TrianglePair> pairs) {
    std::vector<PrimitiveRef> boxes(pairs.size());
    parallelFor(pairs.size(), 1 << 15, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            Aabb box = boundsOf(geometry, pairs[i].first);
            if (!pairs[i].isSingle()) box.grow(boundsOf(geometry, pairs[i].second));
            boxes[i] = {box.lower, static_cast<std::uint32_t>(i), box.upper, 0};
        }
    });
    return boxes;
}

std::optional<PairCorners> cornersOf(const Geometry& geometry, const TrianglePair& pair) {
    const glm::uvec3 a = geometry.triangles[pair.first];
    if (pair.isSingle()) return PairCorners{{a.x, a.y, a.z, a.y}, {0, 0}};
    const glm::uvec3 b = geometry.triangles[pair.second];
    for (std::uint32_t i = 0; i < 3; ++i) {
        for (std::uint32_t j = 0; j < 3; ++j) {
            const std::uint32_t begin = a[(i + 1) % 3], end = a[(i + 2) % 3];
            if (begin == b[(j + 2) % 3] && end == b[(j + 1) % 3])
                return PairCorners{{a[i], begin, end, b[j]}, {i, j}};
        }
    }
    return {};
}

}  // namespace duolux

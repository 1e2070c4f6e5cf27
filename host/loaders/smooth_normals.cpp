#include "host/loaders/smooth_normals.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>
#include <tuple>
#include <utility>
#include <vector>

namespace duolux {

namespace {

double angleBetween(const glm::vec3& a, const glm::vec3& b) {
    return static_cast<double>(std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)));
}

/// Smooths one group at a time. `slot_` maps a vertex to its normal within the group, and is cleared between
/// groups.
class Smoother {
  public:
    explicit Smoother(Geometry& geometry) : geometry_(geometry), slot_(geometry.positions.size(), kNone) {}

    void smooth(std::span<const std::uint32_t> group) {
        sums_.clear();
        for (const std::uint32_t triangle : group)
            accumulate(geometry_.triangles[triangle]);
        const auto firstNormal = static_cast<std::uint32_t>(geometry_.normals.size());
        for (const glm::dvec3& sum : sums_) {
            const double length = glm::length(sum);
            geometry_.normals.emplace_back(length > 0.0 ? sum / length : glm::dvec3(0.0));
        }
        for (const std::uint32_t triangle : group)
            assign(triangle, firstNormal);
        for (const std::uint32_t triangle : group) {
            const glm::uvec3& corners = geometry_.triangles[triangle];
            for (int i = 0; i < 3; ++i)
                slot_[corners[i]] = kNone;
        }
    }

  private:
    static constexpr std::uint32_t kNone = 0xffffffffu;

    void accumulate(const glm::uvec3& corners) {
        const glm::vec3 p[3] = {geometry_.positions[corners[0]], geometry_.positions[corners[1]],
                                geometry_.positions[corners[2]]};
        const glm::dvec3 normal =
            glm::cross(glm::dvec3(p[1]) - glm::dvec3(p[0]), glm::dvec3(p[2]) - glm::dvec3(p[0]));
        const double length = glm::length(normal);
        for (int i = 0; i < 3; ++i) {
            std::uint32_t& slot = slot_[corners[i]];
            if (slot == kNone) {
                slot = static_cast<std::uint32_t>(sums_.size());
                sums_.emplace_back(0.0);
            }
            if (length == 0.0) continue;
            const double angle = angleBetween(p[(i + 1) % 3] - p[i], p[(i + 2) % 3] - p[i]);
            sums_[slot] += normal * (angle / length);
        }
    }

    /// A triangle stays flat if the normals around one of its corners cancel.
    void assign(std::uint32_t triangle, std::uint32_t firstNormal) {
        const glm::uvec3& corners = geometry_.triangles[triangle];
        glm::uvec3 normals;
        for (int i = 0; i < 3; ++i) {
            normals[i] = firstNormal + slot_[corners[i]];
            if (geometry_.normals[normals[i]] == glm::vec3(0.0f)) return;
        }
        geometry_.normalIndices[triangle] = normals;
    }

    Geometry& geometry_;
    std::vector<std::uint32_t> slot_;
    std::vector<glm::dvec3> sums_;
};

/// Smooths by angle, around one vertex at a time. A corner is 3 * triangle + (0, 1 or 2).
class AngleSmoother {
  public:
    AngleSmoother(Geometry& geometry, double crease)
        : geometry_(geometry),
          smallestCosine_(std::cos(glm::radians(crease))),
          isSmooth_(geometry.triangles.size(), false) {
        faceNormals_.reserve(geometry.triangles.size());
        for (const glm::uvec3& triangle : geometry.triangles) {
            const auto at = [&](int k) { return glm::dvec3(geometry.positions[triangle[k]]); };
            const glm::dvec3 normal = glm::cross(at(1) - at(0), at(2) - at(0));
            const double length = glm::length(normal);
            faceNormals_.push_back(length > 0.0 ? normal / length : glm::dvec3(0.0));
        }
    }

    /// `corners`: all that are at a vertex.
    void smooth(std::span<const std::uint32_t> corners) {
        connect(corners);
        sums_.assign(corners.size(), glm::dvec3(0.0));
        sizes_.assign(corners.size(), 0);
        for (std::uint32_t i = 0; i < corners.size(); ++i) {
            const std::uint32_t group = root(i);
            const glm::vec3 tip = position(corners[i], 0);
            const double angle = angleBetween(position(corners[i], 1) - tip, position(corners[i], 2) - tip);
            sums_[group] += faceNormals_[corners[i] / 3] * angle;
            ++sizes_[group];
        }
        slots_.assign(corners.size(), Geometry::kNoNormal);
        for (std::uint32_t i = 0; i < corners.size(); ++i) {
            const double length = glm::length(sums_[i]);
            if (!(length > 0.0)) continue;
            slots_[i] = static_cast<std::uint32_t>(geometry_.normals.size());
            geometry_.normals.emplace_back(sums_[i] / length);
        }
        for (std::uint32_t i = 0; i < corners.size(); ++i) {
            const std::uint32_t triangle = corners[i] / 3, group = root(i);
            geometry_.normalIndices[triangle][static_cast<int>(corners[i] % 3)] = slots_[group];
            if (sizes_[group] > 1) isSmooth_[triangle] = true;
        }
    }

    /// Makes those triangles flat that are alone at all corners or have a corner without a normal.
    void finish() {
        if (std::none_of(isSmooth_.begin(), isSmooth_.end(), [](bool smooth) { return smooth; })) {
            geometry_.normals.clear();
            geometry_.normalIndices.clear();
            return;
        }
        for (std::size_t i = 0; i < geometry_.triangles.size(); ++i) {
            glm::uvec3& normals = geometry_.normalIndices[i];
            const bool isComplete = glm::all(glm::notEqual(normals, glm::uvec3(Geometry::kNoNormal)));
            if (!isSmooth_[i] || !isComplete) normals = glm::uvec3(Geometry::kNoNormal);
        }
    }

  private:
    struct Edge {
        std::uint32_t vertex;  ///< its other end
        std::uint32_t corner;  ///< index into the corners
    };

    /// The vertex at a corner, or at one of the next two of its triangle.
    std::uint32_t vertexAt(std::uint32_t corner, std::uint32_t next) const {
        return geometry_.triangles[corner / 3][static_cast<int>((corner % 3 + next) % 3)];
    }
    glm::vec3 position(std::uint32_t corner, std::uint32_t next) const {
        return geometry_.positions[vertexAt(corner, next)];
    }

    std::uint32_t root(std::uint32_t corner) {
        while (parents_[corner] != corner)
            corner = parents_[corner] = parents_[parents_[corner]];
        return corner;
    }

    /// Unites the corners of triangles that share an edge which is no crease.
    void connect(std::span<const std::uint32_t> corners) {
        parents_.resize(corners.size());
        edges_.clear();
        for (std::uint32_t i = 0; i < corners.size(); ++i) {
            parents_[i] = i;
            for (const std::uint32_t next : {1u, 2u})
                edges_.push_back({vertexAt(corners[i], next), i});
        }
        std::sort(edges_.begin(), edges_.end(), [](const Edge& a, const Edge& b) {
            return std::tie(a.vertex, a.corner) < std::tie(b.vertex, b.corner);
        });
        for (std::size_t i = 1; i < edges_.size(); ++i) {
            const Edge &one = edges_[i - 1], &other = edges_[i];
            if (one.vertex != other.vertex) continue;
            const double cosine =
                glm::dot(faceNormals_[corners[one.corner] / 3], faceNormals_[corners[other.corner] / 3]);
            if (cosine > smallestCosine_) parents_[root(other.corner)] = root(one.corner);
        }
    }

    Geometry& geometry_;
    double smallestCosine_;
    std::vector<glm::dvec3> faceNormals_;  ///< unit, or 0 of triangles without area
    std::vector<bool> isSmooth_;
    // Of the current vertex. All but `edges_` have an item per corner; a group has that of its root.
    std::vector<std::uint32_t> parents_, sizes_, slots_;
    std::vector<glm::dvec3> sums_;
    std::vector<Edge> edges_;
};

}  // namespace

void addNormalsByAngle(Geometry& geometry, double crease) {
    assert(geometry.normals.empty() && geometry.normalIndices.empty());
    // The corners of vertex v are corners[begins[v]] up to corners[begins[v + 1]].
    std::vector<std::uint32_t> begins(geometry.positions.size() + 1, 0),
        corners(3 * geometry.triangles.size());
    const auto vertexOf = [&](std::size_t corner) {
        return geometry.triangles[corner / 3][static_cast<int>(corner % 3)];
    };
    for (std::size_t i = 0; i < corners.size(); ++i)
        ++begins[vertexOf(i)];
    std::partial_sum(begins.begin(), begins.end(), begins.begin());  // now the ends
    for (std::size_t i = corners.size(); i-- > 0;)
        corners[--begins[vertexOf(i)]] = static_cast<std::uint32_t>(i);

    geometry.normalIndices.assign(geometry.triangles.size(), glm::uvec3(Geometry::kNoNormal));
    AngleSmoother smoother(geometry, crease);
    for (std::size_t vertex = 0; vertex + 1 < begins.size(); ++vertex) {
        const std::uint32_t begin = begins[vertex], end = begins[vertex + 1];
        smoother.smooth(std::span(corners).subspan(begin, end - begin));
    }
    smoother.finish();
}

void addSmoothNormals(Geometry& geometry, std::span<const std::uint32_t> groups) {
    assert(groups.size() == geometry.triangles.size());
    assert(geometry.normalIndices.size() == geometry.triangles.size());
    std::vector<std::pair<std::uint32_t, std::uint32_t>> members;  // (group, triangle)
    for (std::uint32_t i = 0; i < groups.size(); ++i) {
        if (groups[i] != 0 && geometry.normalIndices[i].x == Geometry::kNoNormal)
            members.emplace_back(groups[i], i);
    }
    std::stable_sort(members.begin(), members.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    std::vector<std::uint32_t> triangles;
    triangles.reserve(members.size());
    for (const auto& member : members)
        triangles.push_back(member.second);

    Smoother smoother(geometry);
    for (std::size_t begin = 0; begin < members.size();) {
        std::size_t end = begin;
        while (end < members.size() && members[end].first == members[begin].first)
            ++end;
        smoother.smooth(std::span(triangles).subspan(begin, end - begin));
        begin = end;
    }
}

}  // namespace duolux

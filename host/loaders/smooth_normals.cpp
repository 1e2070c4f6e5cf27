#include "host/loaders/smooth_normals.h"

#include <algorithm>
#include <cassert>
#include <cmath>
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

}  // namespace

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

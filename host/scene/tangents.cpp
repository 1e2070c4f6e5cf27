#include "host/scene/tangents.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "host/base/key_numbers.h"

namespace duolux {

namespace {

/// What corners that share a tangent have in common: the bits of position, normal and texture coordinates,
/// and the orientation.
using CornerKey = std::array<std::uint32_t, 9>;

std::uint32_t bitsOf(float value) {
    return std::bit_cast<std::uint32_t>(value + 0.0f);  // -0 as 0
}

/// The triangle's part in the tangents of its corners.
class TangentTriangle {
  public:
    TangentTriangle(const Geometry& geometry, std::uint32_t triangle) {
        const glm::uvec3 uvs = geometry.uvIndices[triangle];
        for (int k = 0; k < 3; ++k) {
            positions_[k] = geometry.positions[geometry.triangles[triangle][k]];
            uvs_[k] = geometry.uvs[uvs[k]];
        }
        const glm::dvec3 edge1 = position(1) - position(0), edge2 = position(2) - position(0);
        const glm::dvec2 uv1 = uv(1) - uv(0), uv2 = uv(2) - uv(0);
        const double area = uv1.x * uv2.y - uv1.y * uv2.x;
        // v points down the image, so that the sign of the area is opposite to the turn seen in the image.
        orientation_ = area < 0.0 ? 1 : area > 0.0 ? -1 : 0;
        gradient_ = (edge1 * uv2.y - edge2 * uv1.y) * (area < 0.0 ? -1.0 : 1.0);
        const bool smooth =
            !geometry.normals.empty() && geometry.normalIndices[triangle].x != Geometry::kNoNormal;
        const glm::vec3 flat(glm::normalize(glm::cross(edge1, edge2)));
        for (int k = 0; k < 3; ++k)
            normals_[k] = smooth ? geometry.normals[geometry.normalIndices[triangle][k]] : flat;
    }

    /// 1, -1 for mirrored texture coordinates, 0 for those without area.
    int orientation() const { return orientation_; }

    CornerKey key(int corner, int orientation) const {
        const glm::vec3 p = positions_[corner], n = normals_[corner];
        const glm::vec2 uv = uvs_[corner];
        return {bitsOf(p.x),  bitsOf(p.y),  bitsOf(p.z),
                bitsOf(n.x),  bitsOf(n.y),  bitsOf(n.z),
                bitsOf(uv.x), bitsOf(uv.y), orientation > 0 ? 1u : 0u};
    }

    /// Zero if the gradient is along the normal.
    glm::dvec3 weighted(int corner) const {
        const glm::dvec3 normal(normals_[corner]);
        const auto inPlane = [&](const glm::dvec3& v) {
            const glm::dvec3 projected = v - glm::dot(normal, v) * normal;
            const double length = glm::length(projected);
            return length > 0.0 ? projected / length : glm::dvec3(0.0);
        };
        const glm::dvec3 a = inPlane(position((corner + 1) % 3) - position(corner));
        const glm::dvec3 b = inPlane(position((corner + 2) % 3) - position(corner));
        return inPlane(gradient_) * std::acos(std::clamp(glm::dot(a, b), -1.0, 1.0));
    }

  private:
    glm::dvec3 position(int corner) const { return glm::dvec3(positions_[corner]); }
    glm::dvec2 uv(int corner) const { return glm::dvec2(uvs_[corner]); }

    glm::mat3 positions_{}, normals_{};
    glm::mat3x2 uvs_{};
    glm::dvec3 gradient_;  ///< of u; its length is of no interest
    int orientation_;
};

}  // namespace

CornerTangents computeTangents(const Geometry& geometry, const std::vector<bool>& wanted) {
    CornerTangents out;
    out.indices.assign(geometry.triangles.size(), glm::uvec3(CornerTangents::kNone));
    if (geometry.uvs.empty()) return out;
    const auto isWanted = [&](std::uint32_t triangle) {
        return wanted[triangle] && geometry.uvIndices[triangle].x != Geometry::kNoUv;
    };
    KeyNumbers<CornerKey> groups(geometry.uvs.size());
    std::vector<glm::dvec3> sums;
    std::vector<std::uint32_t> withoutArea;
    for (std::uint32_t i = 0; i < geometry.triangles.size(); ++i) {
        if (!isWanted(i)) continue;
        const TangentTriangle triangle(geometry, i);
        if (triangle.orientation() == 0) {
            withoutArea.push_back(i);
            continue;
        }
        for (int k = 0; k < 3; ++k) {
            const std::uint32_t group = groups.numberOf(triangle.key(k, triangle.orientation()));
            if (group == sums.size()) sums.emplace_back(0.0);
            sums[group] += triangle.weighted(k);
            out.indices[i][k] = group;
        }
    }
    // Triangles whose texture coordinates have no area take the tangents of their neighbours.
    for (const std::uint32_t i : withoutArea) {
        const TangentTriangle triangle(geometry, i);
        for (int k = 0; k < 3; ++k) {
            const auto same = groups.find(triangle.key(k, 1));
            out.indices[i][k] =
                (same ? same : groups.find(triangle.key(k, -1))).value_or(CornerTangents::kNone);
        }
    }
    for (std::size_t group = 0; group < sums.size(); ++group) {
        const double length = glm::length(sums[group]);
        const float side = groups.keys()[group].back() == 1u ? 1.0f : -1.0f;
        out.tangents.emplace_back(length > 0.0 ? glm::vec3(sums[group] / length) : glm::vec3(0.0f),
                                  length > 0.0 ? side : 0.0f);
    }
    for (glm::uvec3& indices : out.indices) {
        for (int k = 0; k < 3; ++k) {
            if (indices[k] != CornerTangents::kNone && out.tangents[indices[k]].w == 0.0f)
                indices[k] = CornerTangents::kNone;
        }
    }
    return out;
}

}  // namespace duolux

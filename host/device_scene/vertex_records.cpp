#include "host/device_scene/vertex_records.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "host/base/key_numbers.h"
#include "host/device_scene/octahedral.h"
#include "host/scene/tangents.h"

namespace duolux {

namespace {

constexpr std::uint32_t kNone = 0xffffffffu;
/// Marks the index of a flat triangle in place of that of a normal.
constexpr std::uint32_t kOfTriangle = 0x80000000u;
/// Marks the index of a computed tangent in place of that of a given one.
constexpr std::uint32_t kComputed = 0x80000000u;

/// A vertex: the index of its normal (or kOfTriangle | triangle), texture coordinates, and tangent (or
/// kComputed | index); each may be kNone.
using VertexKey = std::array<std::uint32_t, 3>;

bool isSmoothTriangle(const Geometry& geometry, std::uint32_t triangle) {
    return !geometry.normals.empty() && geometry.normalIndices[triangle].x != Geometry::kNoNormal;
}

glm::vec3 frontNormal(const Geometry& geometry, std::uint32_t triangle) {
    const glm::uvec3 index = geometry.triangles[triangle];
    const glm::dvec3 a(geometry.positions[index.x]), b(geometry.positions[index.y]),
        c(geometry.positions[index.z]);
    return glm::vec3(glm::normalize(glm::cross(b - a, c - a)));
}

/// See tangentDecode in shaders/lib/vertex_records.glsl.
std::uint32_t encodeTangent(std::uint32_t octahedral, const glm::vec4& tangent) {
    const glm::vec3 n = octahedralDecode(octahedral);
    // As orthonormalBasis in shaders/lib/warp.glsl.
    const float s = n.z < 0.0f ? -1.0f : 1.0f;
    const float a = -1.0f / (s + n.z);
    const float b = n.x * n.y * a;
    const glm::vec3 x(1.0f + s * n.x * n.x * a, s * b, -s * n.x), y(b, s + n.y * n.y * a, -n.y);
    const glm::vec3 t(tangent);
    const double turns =
        std::atan2(static_cast<double>(glm::dot(t, y)), static_cast<double>(glm::dot(t, x))) /
        (2.0 * std::numbers::pi);
    constexpr std::uint32_t kSteps = 1u << shared::kTangentAngleBits;
    const auto step = static_cast<std::uint32_t>(std::lround((turns + 1.0) * kSteps)) & (kSteps - 1);
    return step | shared::kTangentKnown | (tangent.w < 0.0f ? shared::kTangentNegative : 0u);
}

/// Whether the normals of a triangle's vertices and its tangents are given by the scene.
bool hasTangents(const Geometry& geometry, std::uint32_t triangle) {
    const glm::uvec3 uvs = geometry.uvIndices[triangle];
    if (geometry.tangents.empty() || uvs.x == Geometry::kNoUv || !isSmoothTriangle(geometry, triangle))
        return false;
    return geometry.tangents[uvs.x].w != 0.0f && geometry.tangents[uvs.y].w != 0.0f &&
           geometry.tangents[uvs.z].w != 0.0f;
}

class VertexTable {
  public:
    VertexTable(const Geometry& geometry, const VertexNeeds& needs)
        : geometry_(geometry), needs_(needs), keys_(std::max(geometry.uvs.size(), geometry.normals.size())) {
        std::vector<bool> wanted(geometry.triangles.size());
        bool any = false;
        for (std::uint32_t i = 0; i < wanted.size(); ++i) {
            wanted[i] = needsTangents(i) && !hasTangents(geometry, i);
            any = any || wanted[i];
        }
        if (any) computed_ = computeTangents(geometry, wanted);
    }

    /// The vertices of a triangle's corners. `turn`: the index of the corner that comes first.
    shared::DeviceCorners cornersOf(std::uint32_t triangle, std::uint32_t turn) {
        shared::DeviceCorners corners{};
        const bool hasUvs = geometry_.uvIndices[triangle].x != Geometry::kNoUv;
        const bool smooth = isSmoothTriangle(geometry_, triangle);
        const bool tangents = hasUvs && needsTangents(triangle);
        const bool given = tangents && hasTangents(geometry_, triangle);
        for (std::uint32_t k = 0; k < 3; ++k) {
            const auto corner = static_cast<int>((turn + k) % 3);
            VertexKey key{kNone, kNone, kNone};
            if (smooth) key[0] = geometry_.normalIndices[triangle][corner];
            if (hasUvs) key[1] = geometry_.uvIndices[triangle][corner];
            if (given) key[2] = key[1];
            if (tangents && !given) {
                const std::uint32_t index = computed_.indices[triangle][corner];
                if (index != CornerTangents::kNone) key[2] = kComputed | index;
            }
            if (key[2] != kNone && !smooth) key[0] = kOfTriangle | triangle;
            corners.vertices[k] = keys_.numberOf(key);
        }
        return corners;
    }

    std::vector<shared::DeviceVertex> vertices() const {
        std::vector<shared::DeviceVertex> out;
        out.reserve(keys_.keys().size());
        for (const auto& [normal, uv, tangent] : keys_.keys()) {
            shared::DeviceVertex vertex{};
            if (normal != kNone) {
                vertex.octahedral = octahedralEncode((normal & kOfTriangle) != 0
                                                         ? frontNormal(geometry_, normal & ~kOfTriangle)
                                                         : geometry_.normals[normal]);
            }
            if (uv != kNone) vertex.uv = geometry_.uvs[uv];
            if (tangent != kNone) {
                vertex.tangent = encodeTangent(
                    vertex.octahedral, (tangent & kComputed) != 0 ? computed_.tangents[tangent & ~kComputed]
                                                                  : geometry_.tangents[tangent]);
            }
            out.push_back(vertex);
        }
        return out;
    }

    std::vector<glm::vec4> secondUvs() const {
        std::vector<glm::vec4> out((keys_.keys().size() + 1) / 2);
        for (std::size_t i = 0; i < keys_.keys().size(); ++i) {
            const std::uint32_t uv = keys_.keys()[i][1];
            if (uv == kNone) continue;
            const int first = i % 2 == 0 ? 0 : 2;
            out[i / 2][first] = geometry_.secondUvs[uv].x;
            out[i / 2][first + 1] = geometry_.secondUvs[uv].y;
        }
        return out;
    }

  private:
    bool needsTangents(std::uint32_t triangle) const {
        return needs_.tangents[geometry_.materials[triangle]];
    }

    const Geometry& geometry_;
    const VertexNeeds& needs_;
    CornerTangents computed_;
    KeyNumbers<VertexKey> keys_;
};

}  // namespace

VertexNeeds vertexNeeds(const Scene& scene) {
    const Geometry& geometry = scene.geometry;
    VertexNeeds needs;
    needs.tangents.resize(scene.materials.size());
    if (geometry.uvs.empty()) return needs;
    std::vector<bool> used(scene.materials.size());
    for (std::size_t i = 0; i < geometry.triangles.size(); ++i) {
        if (geometry.uvIndices[i].x != Geometry::kNoUv) used[geometry.materials[i]] = true;
    }
    for (std::size_t i = 0; i < used.size(); ++i) {
        if (!used[i]) continue;
        const Material& material = scene.materials[i];
        needs.tangents[i] = material.anisotropy > 0.0f;
        for (const auto& [input, texture, channel] : material.textures) {
            static_cast<void>(channel);
            needs.records = true;
            if (input == MaterialInput::kNormal || input == MaterialInput::kClearcoatNormal)
                needs.tangents[i] = true;
            if (texture.uvSet == 1 && !geometry.secondUvs.empty()) needs.secondUvs = true;
        }
        if (needs.tangents[i]) needs.records = true;
    }
    return needs;
}

VertexRecords makeVertexRecords(const Geometry& geometry, std::span<const TrianglePair> pairs,
                                const VertexNeeds& needs) {
    VertexRecords out;
    if (!needs.records) return out;
    VertexTable table(geometry, needs);
    out.corners.resize(2 * pairs.size());
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        const PairCorners corners = cornersOf(geometry, pairs[i]).value();
        out.corners[2 * i] = table.cornersOf(pairs[i].first, corners.turns[0]);
        if (!pairs[i].isSingle()) out.corners[2 * i + 1] = table.cornersOf(pairs[i].second, corners.turns[1]);
    }
    out.vertices = table.vertices();
    if (needs.secondUvs) out.secondUvs = table.secondUvs();
    return out;
}

}  // namespace duolux

#include "host/tools/gl/vertices.h"

#include <algorithm>
#include <bit>
#include <numeric>
#include <unordered_map>

namespace duolux {

namespace {

struct Corner {
    std::uint32_t position;
    glm::vec3 normal;
    bool operator==(const Corner&) const = default;
};

struct CornerHash {
    std::size_t operator()(const Corner& c) const {
        std::size_t h = c.position;
        for (int i = 0; i < 3; ++i)
            h = (h ^ std::bit_cast<std::uint32_t>(c.normal[i])) * 0x9e3779b97f4a7c15ull;
        return h ^ h >> 32;
    }
};

}  // namespace

GlMesh makeGlMesh(const Scene& scene) {
    const Geometry& geometry = scene.geometry;
    std::vector<std::uint32_t> order(geometry.triangles.size());
    std::iota(order.begin(), order.end(), 0u);
    std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
        return geometry.materials[a] < geometry.materials[b];
    });

    GlMesh mesh;
    std::unordered_map<Corner, std::uint32_t, CornerHash> known;
    known.reserve(3 * geometry.triangles.size());
    for (const std::uint32_t t : order) {
        const glm::uvec3 v = geometry.triangles[t];
        const glm::vec3 edge1 = geometry.positions[v.y] - geometry.positions[v.x];
        const glm::vec3 edge2 = geometry.positions[v.z] - geometry.positions[v.x];
        const glm::vec3 cross = glm::cross(edge1, edge2);
        if (!(glm::dot(cross, cross) > 0.0f)) continue;
        const glm::vec3 flat = glm::normalize(cross);
        const bool smooth = !geometry.normals.empty() && geometry.normalIndices[t].x != Geometry::kNoNormal;
        if (mesh.ranges.empty() || mesh.ranges.back().material != geometry.materials[t])
            mesh.ranges.push_back(
                {geometry.materials[t], static_cast<std::uint32_t>(mesh.indices.size()), 0});
        for (int i = 0; i < 3; ++i) {
            const glm::vec3 normal = smooth ? geometry.normals[geometry.normalIndices[t][i]] : flat;
            const auto [entry, isNew] =
                known.try_emplace({v[i], normal}, static_cast<std::uint32_t>(mesh.vertices.size()));
            if (isNew) mesh.vertices.push_back({geometry.positions[v[i]], normal});
            mesh.indices.push_back(entry->second);
        }
        mesh.ranges.back().count += 3;
    }
    return mesh;
}

}  // namespace duolux

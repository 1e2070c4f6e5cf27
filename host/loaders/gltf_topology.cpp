#include "host/loaders/gltf_topology.h"

#include <algorithm>
#include <cstddef>
#include <unordered_map>

namespace duolux {

namespace {

void addProper(std::vector<glm::uvec3>& triangles, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    if (a != b && b != c && c != a) triangles.emplace_back(a, b, c);
}

}  // namespace

std::vector<glm::uvec3> trianglesOf(GltfMode mode, const std::vector<std::uint32_t>& indices) {
    std::vector<glm::uvec3> triangles;
    const std::size_t count = indices.size();
    switch (mode) {
        case GltfMode::kTriangles:
            triangles.reserve(count / 3);
            for (std::size_t i = 0; i + 2 < count; i += 3)
                triangles.emplace_back(indices[i], indices[i + 1], indices[i + 2]);
            break;
        case GltfMode::kStrip:
            for (std::size_t i = 0; i + 2 < count; ++i) {
                const std::size_t odd = i % 2;
                addProper(triangles, indices[i], indices[i + 1 + odd], indices[i + 2 - odd]);
            }
            break;
        case GltfMode::kFan:
            for (std::size_t i = 0; i + 2 < count; ++i)
                addProper(triangles, indices[i + 1], indices[i + 2], indices[0]);
            break;
    }
    return triangles;
}

std::vector<std::uint32_t> compactVertices(std::vector<glm::uvec3>& triangles, std::size_t vertexCount) {
    std::vector<std::uint32_t> old;
    const auto renumber = [&](auto&& newNumber) {
        for (glm::uvec3& triangle : triangles) {
            for (int corner = 0; corner < 3; ++corner)
                triangle[corner] = newNumber(triangle[corner]);
        }
    };
    // Many primitives may share many vertices of which each uses few: a table of all would take too long.
    if (3 * triangles.size() < vertexCount / 8) {
        std::unordered_map<std::uint32_t, std::uint32_t> numbers;
        renumber([&](std::uint32_t vertex) {
            const auto [entry, isNew] = numbers.try_emplace(vertex, static_cast<std::uint32_t>(old.size()));
            if (isNew) old.push_back(vertex);
            return entry->second;
        });
        return old;
    }
    constexpr std::uint32_t kNone = 0xffffffffu;
    std::vector<std::uint32_t> numbers(vertexCount, kNone);
    renumber([&](std::uint32_t vertex) {
        if (numbers[vertex] == kNone) {
            numbers[vertex] = static_cast<std::uint32_t>(old.size());
            old.push_back(vertex);
        }
        return numbers[vertex];
    });
    return old;
}

}  // namespace duolux

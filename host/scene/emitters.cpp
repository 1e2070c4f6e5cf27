#include "host/scene/emitters.h"

#include <algorithm>

namespace duolux {

bool emits(const Scene& scene, std::size_t triangle) {
    return emits(scene.materials[scene.geometry.materials[triangle]]);
}

std::vector<SceneEmitter> listEmitters(const Scene& scene) {
    std::vector<SceneEmitter> emitters;
    const Geometry& geometry = scene.geometry;
    for (std::uint32_t i = 0; i < geometry.triangles.size(); ++i) {
        if (!emits(scene, i)) continue;
        const Emission& emission = scene.materials[geometry.materials[i]].emission;
        emitters.push_back({EmitterKind::kTriangle, i, emission, areaOf(geometry, i)});
    }
    addPointEmitters(scene, emitters);
    return emitters;
}

void addPointEmitters(const Scene& scene, std::vector<SceneEmitter>& emitters) {
    for (std::uint32_t i = 0; i < scene.pointEmitters.size(); ++i) {
        const PointEmitter& point = scene.pointEmitters[i];
        emitters.push_back({EmitterKind::kPoint, i, {point.invisible, point.visible, Sides::kFront}, 0.0});
    }
}

bool anyEmitter(const Scene& scene) {
    const auto isEmitting = [&](std::uint32_t material) { return emits(scene.materials[material]); };
    return !scene.pointEmitters.empty() || std::ranges::any_of(scene.geometry.materials, isEmitting);
}

std::vector<std::uint32_t> emittingTriangles(std::span<const SceneEmitter> emitters) {
    std::vector<std::uint32_t> triangles;
    for (const SceneEmitter& emitter : emitters) {
        if (emitter.kind == EmitterKind::kTriangle) triangles.push_back(emitter.index);
    }
    return triangles;
}

std::vector<std::uint32_t> emittingTriangles(const Scene& scene) {
    return emittingTriangles(listEmitters(scene));
}

double areaOf(const Geometry& geometry, std::size_t triangle) {
    const glm::uvec3& corners = geometry.triangles[triangle];
    const glm::dvec3 a(geometry.positions[corners.x]);
    const glm::dvec3 b(geometry.positions[corners.y]);
    const glm::dvec3 c(geometry.positions[corners.z]);
    return 0.5 * glm::length(glm::cross(b - a, c - a));
}

}  // namespace duolux

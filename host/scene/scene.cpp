#include "host/scene/scene.h"

#include <cassert>

namespace duolux {

const char* nameOf(Sides sides) {
    return sides == Sides::kBoth ? "both" : "front";
}

const char* nameOf(CameraType type) {
    return type == CameraType::kOrthographic ? "orthographic" : "perspective";
}

const char* nameOf(Sampler sampler) {
    return sampler == Sampler::kIndependent ? "independent" : "sobol";
}

const char* nameOf(Integrator integrator) {
    return integrator == Integrator::kLightTracer ? "light" : "path";
}

void noteContent(Scene& scene) {
    scene.content = {scene.geometry.positions.size(), scene.geometry.triangles.size(),
                     scene.materials.size()};
}

void removeLamp(Scene& scene) {
    Geometry& geometry = scene.geometry;
    geometry.positions.resize(scene.content.positions);
    geometry.triangles.resize(scene.content.triangles);
    geometry.materials.resize(scene.content.triangles);
    if (!geometry.colours.empty()) geometry.colours.resize(scene.content.positions);
    if (!geometry.normalIndices.empty()) geometry.normalIndices.resize(scene.content.triangles);
    scene.materials.resize(scene.content.materials);
}

Bounds boundsOf(const Geometry& geometry) {
    assert(!geometry.triangles.empty());
    const glm::vec3 first = geometry.positions[geometry.triangles[0].x];
    Bounds bounds{first, first};
    for (const glm::uvec3& triangle : geometry.triangles) {
        for (int i = 0; i < 3; ++i) {
            const glm::vec3& position = geometry.positions[triangle[i]];
            bounds.lower = glm::min(bounds.lower, position);
            bounds.upper = glm::max(bounds.upper, position);
        }
    }
    return bounds;
}

}  // namespace duolux

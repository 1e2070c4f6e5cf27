#include "host/scene/scene.h"

#include <cassert>

#include "host/scene/fields.h"

namespace duolux {

const char* nameOf(Sides sides) {
    return sides == Sides::kBoth ? "both" : "front";
}

const char* nameOf(CameraType type) {
    switch (type) {
        case CameraType::kPerspective:
            return "perspective";
        case CameraType::kOrthographic:
            return "orthographic";
    }
    return "";
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
    forEachField(scene.geometry, [&](const auto& field, auto& items) {
        switch (field.per) {
            case Per::kPosition:
                if (!items.empty()) items.resize(scene.content.positions);
                break;
            case Per::kTriangle:
                if (!items.empty()) items.resize(scene.content.triangles);
                break;
            case Per::kNormal:  // a lamp has none
                break;
        }
    });
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

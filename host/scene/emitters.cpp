#include "host/scene/emitters.h"

#include <algorithm>

namespace duolux {

bool emits(const Scene& scene, std::size_t triangle) {
    return scene.materials[scene.geometry.materials[triangle]].emission.any();
}

bool anyEmitter(const Scene& scene) {
    if (!scene.pointEmitters.empty()) return true;
    return std::ranges::any_of(scene.geometry.materials, [&](std::uint32_t material) {
        return scene.materials[material].emission.any();
    });
}

std::vector<std::uint32_t> emittingTriangles(const Scene& scene) {
    std::vector<std::uint32_t> emitters;
    for (std::uint32_t i = 0; i < scene.geometry.triangles.size(); ++i) {
        if (emits(scene, i)) emitters.push_back(i);
    }
    return emitters;
}

}  // namespace duolux

#pragma once

#include <array>
#include <cmath>

#include "host/view/frame_camera.h"
#include "tests/support/scene_builder.h"

namespace duolux::test {

/// The camera that is chosen for a scene; it should show the whole scene.
inline Camera framed(const LoadedScene& scene, const CameraChoice& choice = {},
                     glm::uvec2 size = {512, 512}) {
    const Surface surface(scene, scene.geometry.triangles.size());
    const Illumination illumination(surface);
    const ViewSamples samples(surface, illumination);
    return frameCamera(choice, surface, samples, static_cast<float>(size.x) / static_cast<float>(size.y));
}

inline LoadedScene boxScene(const glm::vec3& lower, const glm::vec3& upper,
                            Facing facing = Facing::kOutward) {
    SceneBuilder builder;
    builder.box(lower, upper, facing, builder.add(Material{}));
    return builder.scene;
}

/// Horizontal directions.
inline constexpr std::array<glm::vec3, 4> kOpenings{
    {{1.0f, 0.0f, 0.0f}, {-1.0f, 0.0f, 0.0f}, {0.0f, 0.0f, 1.0f}, {0.0f, 0.0f, -1.0f}}};

/// A box from -1 to 1, without the side in the direction of `opening`.
inline LoadedScene openBox(const glm::vec3& opening, bool inward) {
    LoadedScene scene = boxScene(glm::vec3(-1), glm::vec3(1), inward ? Facing::kInward : Facing::kOutward);
    Geometry& geometry = scene.geometry;
    std::size_t kept = 0;
    for (std::size_t i = 0; i < geometry.triangles.size(); ++i) {
        const glm::uvec3 t = geometry.triangles[i];
        const auto beyond = [&](std::uint32_t v) { return glm::dot(geometry.positions[v], opening) > 0.99f; };
        if (beyond(t.x) && beyond(t.y) && beyond(t.z)) continue;
        geometry.triangles[kept++] = t;
    }
    geometry.triangles.resize(kept);
    geometry.materials.resize(kept);
    return scene;
}

/// A height field of 2 `across`^2 triangles.
inline LoadedScene terrain(std::uint32_t across) {
    LoadedScene scene;
    scene.materials = {Material{}};
    const auto n = static_cast<float>(across);
    for (std::uint32_t i = 0; i <= across; ++i) {
        for (std::uint32_t k = 0; k <= across; ++k) {
            const float x = static_cast<float>(i) / n * 10.0f, z = static_cast<float>(k) / n * 10.0f;
            scene.geometry.positions.emplace_back(x, 0.5f * std::sin(x) * std::cos(1.3f * z), z);
        }
    }
    for (std::uint32_t i = 0; i < across; ++i) {
        for (std::uint32_t k = 0; k < across; ++k) {
            const std::uint32_t a = i * (across + 1) + k, b = a + across + 1;
            scene.geometry.triangles.emplace_back(a, a + 1, b + 1);
            scene.geometry.triangles.emplace_back(a, b + 1, b);
        }
    }
    scene.geometry.materials.assign(scene.geometry.triangles.size(), 0);
    return scene;
}

}  // namespace duolux::test

#include "host/scene/default_light.h"

#include <algorithm>
#include <cstdint>
#include <glm/gtc/constants.hpp>

#include "host/scene/compose.h"

namespace duolux {

bool anyEmitter(const Scene& scene) {
    return std::any_of(scene.geometry.materials.begin(), scene.geometry.materials.end(),
                       [&](std::uint32_t material) { return scene.materials[material].emission.any(); });
}

void addDefaultLight(Scene& scene) {
    const Bounds bounds = boundsOf(scene.geometry);
    const Camera& camera = scene.camera;
    const glm::vec3 forward = glm::normalize(camera.target - camera.position);
    const glm::vec3 right = glm::normalize(glm::cross(forward, camera.up));
    const glm::vec3 up = glm::cross(right, forward);

    // What to light lies ahead of the camera: the middle of the scene, or the target if the camera is in the
    // scene.
    const bool inside = glm::all(glm::greaterThan(camera.position, bounds.lower)) &&
                        glm::all(glm::lessThan(camera.position, bounds.upper));
    const float ahead = glm::dot(0.5f * (bounds.lower + bounds.upper) - camera.position, forward);
    const float distance = inside || ahead <= 0.0f ? glm::distance(camera.target, camera.position) : ahead;
    const glm::vec3 lit = camera.position + distance * forward;

    // Far enough behind the camera that no corner reaches into its view, whatever its angle.
    const glm::vec3 centre = camera.position + distance * (0.3f * right + 0.8f * up - 0.25f * forward);
    const float side = 0.4f * distance;
    const glm::vec3 towards = glm::normalize(lit - centre);
    const glm::vec3 edge1 = side * glm::normalize(glm::cross(up, towards));
    const glm::vec3 edge2 = side * glm::normalize(glm::cross(towards, edge1));

    // A small Lambertian source on the axis gives the irradiance E_inv A / r^2, and white reflects irradiance
    // / pi.
    constexpr float kWhite = 0.8f;
    const float squaredDistance = glm::dot(lit - centre, lit - centre);
    Material material;
    material.name = "default light";
    material.diffuse = glm::vec3(0.0f);
    material.emission.invisible = glm::vec3(kWhite * glm::pi<float>() * squaredDistance / (side * side));
    appendRectangle(scene, {centre - 0.5f * (edge1 + edge2), edge1, edge2}, material);
    scene.warnings.emplace_back(
        "nothing emits light: a default luminaire is added above the camera, out of view");
}

}  // namespace duolux

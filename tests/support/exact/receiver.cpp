#include "tests/support/exact/receiver.h"

#include <numbers>
#include <stdexcept>

namespace duolux::test {

std::vector<Vec3> downwardRectangle(double x0, double x1, double z0, double z1, double y) {
    return {{x0, y, z0}, {x1, y, z0}, {x1, y, z1}, {x0, y, z1}};
}

ReceiverScene::ReceiverScene(const Receiver& receiver, glm::vec3 eye) : receiver_(receiver) {
    Material material;
    material.name = "receiver";
    material.baseColor = receiver.albedo;
    material.sides = receiver.sides;
    material.reflectance = receiver.reflectance;
    const std::uint32_t index = builder_.add(material);
    const glm::vec3 n = glm::normalize(receiver.normal);
    const glm::vec3 u = 0.1f * glm::normalize(glm::cross(n, glm::vec3(0, 0, 1)));
    const glm::vec3 v = 0.1f * glm::normalize(glm::cross(n, u));
    builder_.quad(-u - v, u - v, u + v, v - u, index);
    LoadedScene& scene = builder_.scene;
    scene.reflectance = preset("local");
    // At a grazing angle, the footprint is 0.0001 across, and centred on the origin.
    scene.camera = {4.0f * glm::normalize(eye), glm::vec3(0.0f), {0, 1, 0}, 0.0002f};
    scene.settings.width = scene.settings.height = 16;
}

void ReceiverScene::emitter(const std::vector<Vec3>& polygon, const Emission& emission,
                            const Reflectance& reflectance) {
    if (polygon.size() < 3 || polygon.size() > 4) throw std::invalid_argument("3 or 4 corners");
    Material material;
    material.name = "emitter";
    material.emission = emission;
    material.reflectance = reflectance;
    const std::uint32_t index = builder_.add(material);
    const glm::vec3 a(polygon[0]), b(polygon[1]), c(polygon[2]);
    builder_.triangle(a, b, c, index);
    if (polygon.size() == 4) builder_.triangle(a, c, glm::vec3(polygon[3]), index);
}

ChannelLight ReceiverScene::reflected(const ChannelLight& irradiance) const {
    const ChannelMatrix scatter =
        scaled(receiver_.albedo, reference::channelsOf(receiver_.reflectance.opaque));
    return (1.0 / std::numbers::pi) * (scatter * irradiance);
}

ExactCase ReceiverScene::finish(std::string name, std::uint32_t bounces, const ChannelLight& expected) const {
    ExactCase result{std::move(name), builder_.scene, uniformImage(16, 16, expected)};
    result.scene.settings.bounces = bounces;
    result.search = reference::LightSearch::kArea;
    result.relative = 1e-4;
    result.onePoint = true;
    return result;
}

}  // namespace duolux::test

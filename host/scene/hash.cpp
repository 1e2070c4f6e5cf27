#include "host/scene/hash.h"

#include <fmt/format.h>

#include <cstdint>
#include <span>
#include <type_traits>

namespace duolux {

namespace {

void addTo(Hasher& hasher, const ReflectanceMatrix& matrix) {
    for (const glm::vec3& entry : {matrix.m00, matrix.m01, matrix.m10, matrix.m11})
        duolux::addTo(hasher, entry);
}

template <typename T>
void addArray(Hasher& hasher, const std::vector<T>& items) {
    hasher.addArray(std::span<const T>(items));
}

void addCamera(Hasher& hasher, const Camera& camera) {
    addTo(hasher, camera.position);
    addTo(hasher, camera.target);
    addTo(hasher, camera.up);
    hasher.add(static_cast<std::uint32_t>(camera.type));
    hasher.add(camera.type == CameraType::kOrthographic ? camera.height : camera.vfov);
}

}  // namespace

void addTo(Hasher& hasher, const glm::vec3& value) {
    for (int i = 0; i < 3; ++i)
        hasher.add(value[i]);
}

void addTo(Hasher& hasher, const float& value) {
    hasher.add(value);
}

void addTo(Hasher& hasher, const Sides& value) {
    hasher.add(static_cast<std::uint32_t>(value));
}

void addTo(Hasher& hasher, const Reflectance& value) {
    addTo(hasher, value.opaque);
    addTo(hasher, value.transparent);
}

void addTo(Hasher& hasher, const Emission& value) {
    const auto& [invisible, visible, sides] = value;
    addTo(hasher, invisible);
    addTo(hasher, visible);
    addTo(hasher, sides);
}

std::size_t MaterialHash::operator()(const Material& material) const {
    Hasher hasher;
    hasher.add(material.name);
    forEachField(material, [&]<typename T>(const char*, const T& field) {
        if constexpr (std::is_same_v<T, std::optional<Reflectance>>) {
            hasher.add(field.has_value());
            if (field) addTo(hasher, *field);
        } else {
            addTo(hasher, field);
        }
    });
    return hasher.digest();
}

std::string hashScene(const Scene& scene) {
    Hasher hasher;
    const Geometry& geometry = scene.geometry;
    addArray(hasher, geometry.positions);
    addArray(hasher, geometry.triangles);
    addArray(hasher, geometry.materials);
    addArray(hasher, geometry.normals);
    addArray(hasher, geometry.normalIndices);
    if (!geometry.colours.empty()) addArray(hasher, geometry.colours);
    for (const auto& [position, invisible, visible] : scene.pointEmitters) {
        for (const glm::vec3& field : {position, invisible, visible})
            addTo(hasher, field);
    }
    for (const Material& material : scene.materials) {
        forEachField(material, [&]<typename T>(const char*, const T& field) {
            if constexpr (std::is_same_v<T, std::optional<Reflectance>>) {
                addTo(hasher, field.value_or(scene.reflectance));
            } else {
                addTo(hasher, field);
            }
        });
    }
    for (int i = 0; i < 3; ++i)
        hasher.add(scene.origin[i]);
    addCamera(hasher, scene.camera);
    hasher.add(scene.display.x);
    hasher.add(scene.display.y);
    return fmt::format("{:016x}", hasher.digest());
}

}  // namespace duolux

#include "host/scene/hash.h"

#include <fmt/format.h>

#include <cstdint>
#include <span>
#include <tuple>
#include <type_traits>
#include <vector>

#include "host/scene/fields.h"

namespace duolux {

namespace {

void addTo(Hasher& hasher, const ReflectanceMatrix& matrix) {
    const auto& [m00, m01, m10, m11] = matrix;
    for (const glm::vec3& entry : {m00, m01, m10, m11})
        duolux::addTo(hasher, entry);
}

void addTo(Hasher& hasher, const CameraType& value) {
    hasher.add(static_cast<std::uint32_t>(value));
}

void addTo(Hasher& hasher, const Geometry& geometry) {
    forEachField(geometry, [&]<typename T>(const auto& field, const std::vector<T>& items) {
        if (!field.isLater || !items.empty()) hasher.addArray(std::span<const T>(items));
    });
}

/// Adds nothing if there are none.
void addTo(Hasher& hasher, const std::vector<PointEmitter>& emitters) {
    if (!emitters.empty()) hasher.add(std::uint64_t{emitters.size()});
    for (const PointEmitter& emitter : emitters)
        forEachField(emitter, [&](const char*, const glm::vec3& field) { duolux::addTo(hasher, field); });
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
    const auto& [opaque, transparent] = value;
    addTo(hasher, opaque);
    addTo(hasher, transparent);
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
    // All fields by name: a further one does not compile until it is handled here.
    const auto& [source, camera, display, reflectance, materials, geometry, pointEmitters, origin, content] =
        scene;
    static_cast<void>(std::tie(source, content));  // which do not matter to the image
    addTo(hasher, geometry);
    addTo(hasher, pointEmitters);
    for (const Material& material : materials) {
        forEachField(material, [&]<typename T>(const char*, const T& field) {
            if constexpr (std::is_same_v<T, std::optional<Reflectance>>) {
                addTo(hasher, field.value_or(reflectance));
            } else {
                addTo(hasher, field);
            }
        });
    }
    for (int i = 0; i < 3; ++i)
        hasher.add(origin[i]);
    forEachField(camera, [&](const char*, const auto& field) { addTo(hasher, field); });
    hasher.add(display.x);
    hasher.add(display.y);
    return fmt::format("{:016x}", hasher.digest());
}

}  // namespace duolux

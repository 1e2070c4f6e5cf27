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
    forEachField(geometry, [&]<typename T>(const auto&, const std::vector<T>& items) {
        hasher.addArray(std::span<const T>(items));
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

namespace {

void addTo(Hasher& hasher, bool value) {
    hasher.add(value);
}
void addTo(Hasher& hasher, const Alpha& alpha) {
    const auto& [mode, value, cutoff] = alpha;
    hasher.add(static_cast<std::uint32_t>(mode));
    hasher.add(value);
    hasher.add(cutoff);
}

void addTo(Hasher& hasher, const std::vector<MaterialTexture>& textures) {
    hasher.add(std::uint64_t{textures.size()});
    for (const auto& [input, texture, channel] : textures) {
        const auto& [image, colourSpace, wrapU, wrapV, filter, uvSet, transform] = texture;
        const auto& [scale, offset, rotation] = transform;
        hasher.add(static_cast<std::uint32_t>(input));
        hasher.add(channel);
        hasher.add(image);
        hasher.add(static_cast<std::uint32_t>(colourSpace));
        hasher.add(static_cast<std::uint32_t>(wrapU));
        hasher.add(static_cast<std::uint32_t>(wrapV));
        hasher.add(static_cast<std::uint32_t>(filter));
        hasher.add(uvSet);
        for (const float value : {scale.x, scale.y, offset.x, offset.y, rotation})
            hasher.add(value);
    }
}

void addTo(Hasher& hasher, const Image& image) {
    const auto& [name, width, height, bytes, floats] = image;
    static_cast<void>(name);  // which does not matter to the picture
    hasher.add(width);
    hasher.add(height);
    hasher.addArray(std::span<const std::uint8_t>(bytes));
    hasher.addArray(std::span<const float>(floats));
}

/// Adds all fields; `addReflectance(hasher, field)` adds the reflectance.
template <typename AddReflectance>
void addFields(Hasher& hasher, const Material& material, const AddReflectance& addReflectance) {
    forEachField(material, [&]<typename T>(const char*, const T& field) {
        if constexpr (std::is_same_v<T, std::optional<Reflectance>>) {
            addReflectance(hasher, field);
        } else {
            addTo(hasher, field);
        }
    });
}

}  // namespace

std::size_t MaterialHash::operator()(const Material& material) const {
    Hasher hasher;
    hasher.add(material.name);
    addFields(hasher, material, [](Hasher& to, const std::optional<Reflectance>& reflectance) {
        to.add(reflectance.has_value());
        if (reflectance) addTo(to, *reflectance);
    });
    return hasher.digest();
}

std::string hashScene(const Scene& scene) {
    Hasher hasher;
    // All fields by name: a further one does not compile until it is handled here.
    const auto& [source, camera, display, reflectance, materials, geometry, pointEmitters, images, origin,
                 content] = scene;
    static_cast<void>(std::tie(source, content));  // which do not matter to the image
    addTo(hasher, geometry);
    addTo(hasher, pointEmitters);
    for (const Material& material : materials) {
        addFields(hasher, material, [&](Hasher& to, const std::optional<Reflectance>& field) {
            addTo(to, field.value_or(reflectance));
        });
    }
    for (const std::shared_ptr<const Image>& image : images)
        addTo(hasher, *image);
    for (int i = 0; i < 3; ++i)
        hasher.add(origin[i]);
    forEachField(camera, [&](const char*, const auto& field) { addTo(hasher, field); });
    hasher.add(display.x);
    hasher.add(display.y);
    return fmt::format("{:016x}", hasher.digest());
}

}  // namespace duolux

#pragma once

#include <string>

#include "host/base/hash.h"
#include "host/scene/scene.h"

namespace duolux {

/// 16 hexadecimal digits over everything that the image depends on, except RenderSettings.
std::string hashScene(const Scene& scene);

void addTo(Hasher& hasher, const glm::vec3& value);
void addTo(Hasher& hasher, const float& value);
void addTo(Hasher& hasher, const Sides& value);
void addTo(Hasher& hasher, const Reflectance& value);
void addTo(Hasher& hasher, const Emission& value);

/// Hashes all fields including the name: equal materials have equal hashes.
struct MaterialHash {
    std::size_t operator()(const Material& material) const;
};

}  // namespace duolux

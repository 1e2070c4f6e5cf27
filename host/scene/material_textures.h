#pragma once

#include <algorithm>
#include <vector>

#include "host/scene/material.h"

namespace duolux {

// Material::textures in the order and number that it must have.

inline void removeTexture(Material& material, MaterialInput input) {
    std::erase_if(material.textures, [&](const MaterialTexture& texture) { return texture.input == input; });
}

/// Replaces the texture of the same input, if there is one.
inline void setTexture(Material& material, const MaterialTexture& texture) {
    removeTexture(material, texture.input);
    const auto place =
        std::find_if(material.textures.begin(), material.textures.end(),
                     [&](const MaterialTexture& other) { return other.input > texture.input; });
    material.textures.insert(place, texture);
}

/// Null if no image scales this input.
inline const MaterialTexture* findTexture(const Material& material, MaterialInput input) {
    const auto found = std::find_if(material.textures.begin(), material.textures.end(),
                                    [&](const MaterialTexture& texture) { return texture.input == input; });
    return found == material.textures.end() ? nullptr : &*found;
}

}  // namespace duolux

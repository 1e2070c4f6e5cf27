#pragma once

#include <cstdint>
#include <string>

#include "host/loaders/gltf_document.h"
#include "host/loaders/gltf_textures.h"
#include "host/scene/material.h"

namespace duolux {

/// Reads a material with its ratified extensions. `index`: its place in the file. Throws InputError.
Material readGltfMaterial(const JsonNode& node, std::uint32_t index, GltfTextures& textures,
                          GltfNotes& notes);

/// The name of a material: "material N" if the file gives it none. Throws InputError.
std::string gltfMaterialName(const JsonNode& node, std::uint32_t index);

/// What primitives without a material have (glTF 2.0, section 3.9.6).
Material defaultGltfMaterial();

}  // namespace duolux

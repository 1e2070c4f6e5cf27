#pragma once

#include <filesystem>

#include "host/loaders/material_files.h"
#include "host/scene/mesh.h"

namespace duolux {

/// Loads a glTF 2.0 file, as JSON or binary (Khronos, "glTF 2.0 Specification", 2021), with the default
/// scene's triangles, point lights and first camera. `files` only says how to read. Throws InputError.
Mesh loadGltf(const std::filesystem::path& path, MaterialFiles& files);

}  // namespace duolux

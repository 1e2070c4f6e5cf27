#pragma once

#include <filesystem>

#include "host/loaders/scene_file.h"

namespace duolux {

/// Reads the JSON scene format and the meshes it names. Luminaires that are not part of a mesh may be out of
/// view. Throws InputError.
SceneFile readJsonScene(const std::filesystem::path& path, Reading reading);

}  // namespace duolux

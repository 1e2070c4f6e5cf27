#pragma once

#include <filesystem>

#include "host/loaders/scene_file.h"

namespace duolux {

/// Reads the JSON scene format and the meshes it names. The triangles of "lights" are not among those that an
/// automatic camera frames. Throws InputError.
SceneFile readJsonScene(const std::filesystem::path& path, Reading reading);

}  // namespace duolux

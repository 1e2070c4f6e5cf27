#pragma once

#include <filesystem>

#include "host/scene/scene.h"

namespace duolux {

struct JsonScene {
    Scene scene;     ///< complete but for the hash
    bool hasLights;  ///< it says what "lights" there are, be it none
};

/// Reads the JSON scene format and the meshes it names. Without "camera" one is framed around the meshes.
/// Throws InputError.
JsonScene readJsonScene(const std::filesystem::path& path);

}  // namespace duolux

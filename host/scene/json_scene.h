#pragma once

#include <cstddef>
#include <filesystem>

#include "host/scene/camera_choice.h"
#include "host/scene/scene.h"
#include "host/scene/tally.h"

namespace duolux {

/// What a scene file says.
struct SceneFile {
    Scene scene;                  ///< complete but for camera, hash and what is not said
    CameraChoice camera;          ///< what it says of it
    std::size_t framedTriangles;  ///< the first of them are what a camera should show
    bool hasLights;               ///< it says what "lights" there are, be it none
    bool hasBounces;              ///< it says how many bounces
};

/// Reads the JSON scene format and the meshes it names. Luminaires given apart from meshes may be out of the
/// picture. Throws InputError.
SceneFile readJsonScene(const std::filesystem::path& path, Reading reading);

}  // namespace duolux

#pragma once

#include <cstddef>
#include <filesystem>

#include "host/scene/camera_choice.h"
#include "host/scene/scene.h"
#include "host/scene/tally.h"

namespace duolux {

/// The content of a scene file.
struct SceneFile {
    Scene scene;                  ///< complete except for camera, hash and unspecified values
    CameraChoice camera;          ///< the specified parts of the camera
    std::size_t framedTriangles;  ///< number of leading triangles that a camera should show
    bool hasLights;               ///< whether the file has "lights", even an empty list
    bool hasBounces;              ///< whether the file specifies the number of bounces
};

/// Reads the JSON scene format and the meshes it names. Luminaires that are not part of a mesh may be out of
/// view. Throws InputError.
SceneFile readJsonScene(const std::filesystem::path& path, Reading reading);

}  // namespace duolux

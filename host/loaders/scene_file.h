#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

#include "host/loaders/material_files.h"
#include "host/loaders/tally.h"
#include "host/scene/camera_choice.h"
#include "host/scene/mesh.h"
#include "host/scene/scene.h"

namespace duolux {

/// The content of a scene file.
struct SceneFile {
    LoadedScene scene;            ///< complete except for camera and unspecified values
    CameraChoice camera;          ///< the specified parts of the camera
    std::size_t framedTriangles;  ///< number of leading triangles that a camera should show
    bool hasLights;               ///< whether the file has "lights", even an empty list
    bool hasBounces;              ///< whether the file specifies the number of bounces
};

/// The extensions of mesh files, and of all scene files, for messages: ".obj, .ply ... or .json".
std::string meshExtensions();
std::string sceneExtensions();

/// Throws InputError unless the extension is that of a scene file: of a JSON scene or of a mesh.
void requireScenePath(const std::filesystem::path& path);

/// Loads a scene file by its extension. A mesh becomes a scene with the reflectance `global`. Throws
/// InputError.
SceneFile readSceneFile(const std::filesystem::path& path, Reading reading);

/// Whether the extension is that of a mesh file.
bool isMeshPath(const std::filesystem::path& path);

/// Loads a mesh file by its extension. `isMeshPath(path)` holds. Throws InputError.
Mesh loadMesh(const std::filesystem::path& path, MaterialFiles& files);

}  // namespace duolux

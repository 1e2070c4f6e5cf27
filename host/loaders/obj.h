#pragma once

#include <filesystem>

#include "host/loaders/material_files.h"
#include "host/scene/mesh.h"

namespace duolux {

/// Reads Wavefront OBJ. Polygons are triangulated. Normals come from `vn` or, if a face has none, from its
/// smoothing group. Materials come from the MTL files that the mesh names; a missing file gives a warning.
/// Throws InputError.
Mesh loadObj(const std::filesystem::path& path, MaterialFiles& files);

}  // namespace duolux

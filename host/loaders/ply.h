#pragma once

#include <filesystem>

#include "host/loaders/material_files.h"
#include "host/scene/mesh.h"

namespace duolux {

/// Reads a PLY file: text, or binary of either byte order. Polygons are triangulated; normals, colours
/// and texture coordinates are used. All faces have the default material: white if vertices have colours or
/// the file names a texture, which is searched for by `files`. Throws InputError.
Mesh loadPly(const std::filesystem::path& path, MaterialFiles& files);

}  // namespace duolux

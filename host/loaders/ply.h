#pragma once

#include <filesystem>

#include "host/loaders/material_files.h"
#include "host/scene/mesh.h"

namespace duolux {

/// Reads a PLY file: text, or binary of either byte order. Polygons are triangulated; normals and colours of
/// vertices are used. All faces have the default material, which is white if vertices have colours. `files`
/// only tells whether reading is strict. Throws InputError.
Mesh loadPly(const std::filesystem::path& path, MaterialFiles& files);

}  // namespace duolux

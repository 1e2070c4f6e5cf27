#pragma once

#include <filesystem>

#include "host/loaders/material_files.h"
#include "host/scene/mesh.h"

namespace duolux {

/// Reads an STL file, text or binary: the size decides, because binary files, too, may begin with "solid".
/// Corners at equal positions become one vertex, whose shading normals are smooth across edges of less than
/// kStlCrease. The order of the corners makes the front; the facets' normals are only compared with it.
/// Facets with a colour have a material of their own, the others the default one. z points up. `files` only
/// tells whether reading is strict. Throws InputError.
Mesh loadStl(const std::filesystem::path& path, MaterialFiles& files);

/// In degrees, between the normals of two facets.
inline constexpr double kStlCrease = 30.0;

}  // namespace duolux

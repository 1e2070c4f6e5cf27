#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "host/scene/material_files.h"
#include "host/scene/scene.h"
#include "host/scene/tally.h"

namespace duolux {

/// One mesh file as it was read: triangles in object space, among them possibly some of zero area.
struct Mesh {
    std::filesystem::path source;
    std::vector<std::filesystem::path> files;  ///< that were read: the mesh and its MTL files
    Geometry geometry;                         ///< its positions are those of the file less `origin`
    glm::dvec3 origin{0.0};  ///< not 0 if the file's coordinates are far from the origin for their extent
    std::vector<Material> materials;           ///< that faces have
    std::vector<std::string> unusedMaterials;  ///< names in the mesh that no face has
    std::vector<std::string> warnings;
    std::uint64_t bytes = 0;  ///< of the text
};

/// Name of the material of faces that come before any `usemtl`.
inline const std::string kDefaultMaterialName = "default";

/// Coordinates, before and after a transform, less the scene's origin, must not be larger than this: squared
/// areas then fit a float.
inline constexpr float kLargestCoordinate = 1e9f;

/// Places in scene files and on the command line, before the scene's origin is taken off, must not be farther
/// away than this.
inline constexpr double kFarthestPlace = 1e18;

/// Emitted radiance must not be larger than this. (The nearest float is smaller.)
inline constexpr double kLargestRadiance = 1e12;

/// Reads Wavefront OBJ: polygons become triangles, normals come from `vn` or, where a face has none, from its
/// smoothing group. Materials come from the MTL files it names; a missing one is a warning. Throws
/// InputError.
Mesh loadObj(const std::filesystem::path& path, MaterialFiles& files);
Mesh loadObj(const std::filesystem::path& path, Reading reading = Reading::kLenient);

}  // namespace duolux

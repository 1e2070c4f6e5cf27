#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "host/scene/camera_choice.h"
#include "host/scene/scene.h"

namespace duolux {

/// A PointEmitter whose position is in the coordinates of a file.
struct PlacedPointEmitter {
    glm::dvec3 position{0.0};
    glm::vec3 invisible{0.0f};
    glm::vec3 visible{0.0f};
};

/// The content of a mesh file: triangles in object space, possibly including some with zero area.
struct Mesh {
    std::filesystem::path source;
    std::vector<std::filesystem::path> files;  ///< all files read: the mesh, and those that it names
    Geometry geometry;                         ///< positions are relative to `origin`
    glm::dvec3 origin{0.0};  ///< not 0 if the file's coordinates are far from the origin for their extent
    std::vector<Material> materials;  ///< used by faces; Texture::image is an index into `images`
    std::vector<ImageSource> images;
    std::vector<PlacedPointEmitter> pointEmitters;
    CameraChoice camera;  ///< the camera of the file; nothing is specified if it has none
    std::vector<std::string> unusedMaterials;  ///< names in the mesh that no face uses
    std::vector<std::string> warnings;
    std::uint64_t bytes = 0;  ///< size of the file
};

/// Name of the material of faces for which the file names none.
inline const std::string kDefaultMaterialName = "default";

/// Largest magnitude of coordinates relative to the scene's origin, before and after a transform: squared
/// areas then fit into a float.
inline constexpr float kLargestCoordinate = 1e9f;

/// Largest magnitude of coordinates in scene files and on the command line, before the scene's origin is
/// subtracted.
inline constexpr double kFarthestPlace = 1e18;

/// The largest emitted radiance. (The nearest float is smaller.)
inline constexpr double kLargestRadiance = 1e12;

}  // namespace duolux

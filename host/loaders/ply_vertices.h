#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "host/loaders/ply_body.h"
#include "host/loaders/ply_header.h"
#include "host/loaders/ply_oddities.h"
#include "host/loaders/uv_range.h"

namespace duolux {

/// The vertices of a PLY file. All arrays but the first are empty if the file does not have them.
struct PlyVertices {
    std::vector<glm::dvec3> positions;
    std::vector<glm::vec3> normals;  ///< unit, or 0 if invalid
    std::vector<glm::vec3> colours;  ///< linear, 0 to 1
    std::vector<float> alphas;       ///< 0 to 1
    std::vector<glm::vec2> uvs;      ///< v down the image, or kBadUv
};

/// Reads the element "vertex", which is the next in the file. `strict`: odd values are errors. Throws
/// InputError.
PlyVertices readPlyVertices(const PlyElement& element, PlyBody& body, bool strict, PlyOddities& oddities);

}  // namespace duolux

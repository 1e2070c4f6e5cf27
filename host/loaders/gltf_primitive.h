#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "host/loaders/gltf_buffers.h"
#include "host/loaders/gltf_document.h"

namespace duolux {

/// Triangles of one material in the coordinates of their mesh. Arrays have an item for each vertex, or are
/// empty. Positions are finite.
struct GltfPrimitive {
    /// Joints of a skin that move a vertex; a weight of 0 has no effect.
    struct Influence {
        glm::uvec4 joints;
        glm::vec4 weights;
    };
    /// Differences that a weight scales.
    struct Target {
        std::vector<glm::vec3> positions, normals, tangents;
    };

    std::optional<std::uint32_t> material;  ///< empty: the default one of glTF
    std::vector<glm::uvec3> triangles;
    std::vector<glm::vec3> positions, normals;
    std::vector<glm::vec4> tangents;  ///< see Geometry::tangents
    std::vector<glm::vec2> uvs, secondUvs;
    std::vector<glm::vec3> colours;  ///< see Geometry::colours
    std::vector<float> alphas;
    std::vector<Influence> influences, moreInfluences;
    std::vector<Target> targets;
};

/// Reads the primitives of a mesh, without those that have no triangles. Throws InputError.
std::vector<GltfPrimitive> readGltfMesh(const JsonNode& mesh, const GltfDocument& document,
                                        GltfBuffers& buffers, GltfNotes& notes);

}  // namespace duolux

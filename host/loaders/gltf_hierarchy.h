#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "host/loaders/gltf_document.h"

namespace duolux {

/// Where the nodes of a glTF file are.
struct GltfHierarchy {
    std::vector<glm::dmat4> worlds;    ///< per node: from its coordinates to those of the file
    std::vector<std::uint32_t> scene;  ///< the nodes of the default scene, parents first
};

/// Reads the nodes and the default scene: that of `scene`, otherwise the first, otherwise all nodes. Takes
/// time proportional to their number. Throws InputError, also if nodes do not form trees.
GltfHierarchy readGltfHierarchy(const GltfDocument& document, GltfNotes& notes);

/// The transform of a translation, a rotation (a quaternion x, y, z, w of any length) and a scale.
glm::dmat4 transformOf(const glm::dvec3& translation, const glm::dvec4& rotation, const glm::dvec3& scale);

}  // namespace duolux

#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <utility>
#include <vector>

#include "host/loaders/gltf_primitive.h"
#include "host/scene/mesh.h"

namespace duolux {

/// Where a primitive is, and in which shape.
struct GltfPlacement {
    JsonNode node;                       ///< for messages
    glm::dmat4 world{1.0};               ///< from the primitive's coordinates to those of the file
    std::span<const glm::dmat4> joints;  ///< of the skin: the same, for what follows each joint; may be empty
    std::span<const double> weights;     ///< of the morph targets; missing ones are 0
};

/// Collects the triangles of a file. Members throw InputError.
class GltfGeometry {
  public:
    void add(const GltfPrimitive& primitive, std::uint32_t material, const GltfPlacement& placement);

    /// Moves everything to a mesh whose source is set, relative to an origin that suits it.
    void moveTo(Mesh& mesh);

  private:
    /// The shape of a primitive after its morph targets.
    struct Shape {
        std::vector<glm::dvec3> positions, normals, tangents;
    };

    static Shape shapeOf(const GltfPrimitive& primitive, const GltfPlacement& placement);
    void addVertices(const GltfPrimitive& primitive, const GltfPlacement& placement);
    void addColours(const GltfPrimitive& primitive);
    void addUvs(const GltfPrimitive& primitive);
    void addTriangles(const GltfPrimitive& primitive, std::uint32_t material);
    [[noreturn]] void failRange(const std::vector<glm::vec3>& rounded) const;

    Geometry geometry_;  ///< without positions
    std::vector<glm::dvec3> positions_;
    std::vector<std::pair<std::size_t, JsonNode>>
        starts_;                  ///< first position of each primitive, and its node
    std::vector<bool> mirrored_;  ///< per vertex of the current primitive
};

}  // namespace duolux

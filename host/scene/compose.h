#pragma once

#include <cstddef>
#include <glm/glm.hpp>

#include "host/scene/mesh.h"
#include "host/scene/scene.h"

namespace duolux {

/// Object to world. Normals go by the inverse transpose; a mirroring transform turns the winding so that
/// fronts stay fronts. The upper left 3x3 must be regular. Returns false if a coordinate exceeds
/// kLargestCoordinate.
bool transformGeometry(Geometry& geometry, const glm::dmat4& transform);

/// Determinant far from 0, measured by the lengths of the columns.
bool isRegular(const glm::dmat3& matrix);

/// Adds the triangles and materials of a mesh; a material equal to one that the scene has is shared.
/// Triangles without area are left out, with a warning. Throws InputError if there would be too many
/// triangles.
void appendMesh(Scene& scene, Mesh mesh);

/// A parallelogram whose front is the side that edge1 x edge2 points to.
struct Rectangle {
    glm::vec3 origin, edge1, edge2;
};

/// Adds two triangles (none if they have no area).
void appendRectangle(Scene& scene, const Rectangle& rectangle, const Material& material);

/// Takes out triangles without area: those too thin for single precision to tell which way they face.
/// Returns how many.
std::size_t dropDegenerateTriangles(Geometry& geometry);

}  // namespace duolux

#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "host/scene/scene.h"

namespace duolux {

/// Tangents of the corners of triangles.
struct CornerTangents {
    static constexpr std::uint32_t kNone = 0xffffffffu;

    std::vector<glm::vec4> tangents;  ///< as Geometry::tangents, known
    std::vector<glm::uvec3> indices;  ///< per triangle; kNone: not wanted, or not known
};

/// Tangents of the triangles for which `wanted` is true and that have texture coordinates, as the files of
/// normal maps assume (Mikkelsen, "Simulation of Wrinkled Surfaces Revisited", 2008; his MikkTSpace). The
/// tangent of a corner is the mean over all corners with the same position, normal, texture coordinates and
/// orientation of these of their triangles' gradients of u, projected onto the plane of the normal and
/// weighted by the angle of the corner. Flat triangles have their own normal. Takes no account of which
/// triangles are neighbours. Not known where texture coordinates do not span an area.
CornerTangents computeTangents(const Geometry& geometry, const std::vector<bool>& wanted);

}  // namespace duolux

#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <map>
#include <string>
#include <unordered_map>

#include "host/scene/hash.h"
#include "host/scene/mesh.h"
#include "host/scene/scene.h"

namespace duolux {

/// Object to world. Normals go by the inverse transpose; a mirroring transform turns the winding so that
/// fronts stay fronts. The upper left 3x3 must be regular. Returns false if a coordinate exceeds
/// kLargestCoordinate. `roundingError`: how far rounding moves a position at most.
bool transformGeometry(Geometry& geometry, const glm::dmat4& transform, double* roundingError = nullptr);

/// Places a mesh, in the coordinates of its file, in a scene of the given origin, which becomes the mesh's.
/// Returns false if a coordinate exceeds kLargestCoordinate there.
bool placeMesh(Mesh& mesh, const glm::dmat4& transform, const glm::dvec3& sceneOrigin,
               double* roundingError = nullptr);

/// Determinant far from 0, measured by the lengths of the columns.
bool isRegular(const glm::dmat3& matrix);

/// A parallelogram whose front is the side that edge1 x edge2 points to.
struct Rectangle {
    glm::vec3 origin, edge1, edge2;
};

/// Puts a scene together, in time proportional to what is added.
class Composer {
  public:
    explicit Composer(Scene& scene);

    /// Adds the triangles and materials of a mesh, whose origin must be the scene's; a material equal to one
    /// that the scene has is shared. Triangles without area are left out. Throws InputError if there would be
    /// too many triangles.
    void append(Mesh mesh);

    /// Adds two triangles (none if they have no area).
    void append(const Rectangle& rectangle, const Material& material);

    /// Warns of the triangles that were left out, once a mesh file.
    void finish();

  private:
    std::uint32_t indexOf(const Material& material);

    struct LeftOut {
        std::size_t dropped = 0, all = 0;
    };

    Scene& scene_;
    std::unordered_map<Material, std::uint32_t, MaterialHash> materials_;
    std::map<std::filesystem::path, LeftOut> leftOut_;
};

/// The same for one mesh or rectangle.
void appendMesh(Scene& scene, Mesh mesh);
void appendRectangle(Scene& scene, const Rectangle& rectangle, const Material& material);

/// Sets what is taken off all coordinates of a scene, and warns if it is not 0.
void setOrigin(Scene& scene, const glm::dvec3& origin);

/// Takes out triangles without area: those too thin for single precision to tell which way they face.
/// Returns how many.
std::size_t dropDegenerateTriangles(Geometry& geometry);

}  // namespace duolux

#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <map>
#include <string>
#include <unordered_map>
#include <utility>

#include "host/scene/hash.h"
#include "host/scene/mesh.h"
#include "host/scene/scene.h"

namespace duolux {

/// Transforms from object to world. Normals are transformed by the inverse transpose. A mirroring transform
/// reverses the winding, so that fronts remain fronts, and the sides of bitangents. The upper left 3x3 must
/// be regular. Returns false if a coordinate exceeds kLargestCoordinate. `roundingError`: the largest
/// distance by which rounding moves a position.
bool transformGeometry(Geometry& geometry, const glm::dmat4& transform, double* roundingError = nullptr);

/// Places a mesh, in the coordinates of its file, in a scene of the given origin, which becomes the mesh's.
/// Returns false if a coordinate exceeds kLargestCoordinate there.
bool placeMesh(Mesh& mesh, const glm::dmat4& transform, const glm::dvec3& sceneOrigin,
               double* roundingError = nullptr);

/// Whether the determinant is far from 0 relative to the lengths of the columns.
bool isRegular(const glm::dmat3& matrix);

/// A parallelogram whose front is the side that edge1 x edge2 points to.
struct Rectangle {
    glm::vec3 origin, edge1, edge2;
};

/// Adds meshes to a scene, in time proportional to their size.
class Composer {
  public:
    explicit Composer(LoadedScene& scene);

    /// Adds the triangles, materials, images and point emitters of a mesh, whose origin must be the scene's;
    /// a material or an image equal to one that the scene has is shared. Triangles without area are left out.
    /// Throws InputError if there would be too many triangles.
    void append(Mesh mesh);

    /// Adds two triangles (none if they have no area).
    void append(const Rectangle& rectangle, const Material& material);

    /// Adds a warning for each mesh file of which triangles were left out.
    void finish();

    /// The index of an image in LoadedScene::imageSources, to which it is added if it is new.
    std::uint32_t indexOf(const ImageSource& image);

  private:
    std::uint32_t indexOf(const Material& material);

    struct LeftOut {
        std::size_t dropped = 0, all = 0;
    };

    LoadedScene& scene_;
    std::unordered_map<Material, std::uint32_t, MaterialHash> materials_;
    std::map<decltype(std::declval<ImageSource>().identity()), std::uint32_t> images_;
    std::map<std::filesystem::path, LeftOut> leftOut_;
};

/// The same for one mesh or rectangle.
void appendMesh(LoadedScene& scene, Mesh mesh);
void appendRectangle(LoadedScene& scene, const Rectangle& rectangle, const Material& material);

/// Sets the origin that is subtracted from all coordinates of a scene, and warns if it is not 0.
void setOrigin(LoadedScene& scene, const glm::dvec3& origin);

/// Removes triangles without area: those too thin to have a normal in single precision. Returns their number.
std::size_t dropDegenerateTriangles(Geometry& geometry);

}  // namespace duolux

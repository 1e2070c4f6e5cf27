#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <memory>
#include <string>
#include <vector>

#include "host/scene/material.h"
#include "host/scene/warning.h"

namespace duolux {

/// Triangles in world space. Counter-clockwise winding, seen from the front.
struct Geometry {
    std::vector<glm::vec3> positions;
    std::vector<glm::uvec3> triangles;     ///< indices into positions
    std::vector<std::uint32_t> materials;  ///< per triangle, index into Scene::materials
    std::vector<glm::vec3> normals;        ///< unit shading normals; empty if no triangle has them
    std::vector<glm::uvec3>
        normalIndices;  ///< per triangle; kNoNormal in .x: flat. Empty if normals is empty

    std::vector<glm::vec3>
        colours;                ///< per position: scale the base colour, linear RGB from 0 to 1; may be empty
    std::vector<float> alphas;  ///< per position: scale alpha, 0 to 1; may be empty
    std::vector<glm::vec2>
        uvs;  ///< texture coordinates (host/scene/texture.h); empty if no triangle has them
    std::vector<glm::vec2> secondUvs;  ///< the second set; as many as uvs, or empty
    /// As many as uvs, or empty: unit tangent towards growing u, and the sign of the bitangent towards
    /// smaller v, cross(normal, tangent) * w (as in glTF). 0: not known.
    std::vector<glm::vec4> tangents;
    std::vector<glm::uvec3> uvIndices;  ///< per triangle; kNoUv in .x: none. Empty if uvs is empty

    static constexpr std::uint32_t kNoNormal = 0xffffffffu;
    static constexpr std::uint32_t kNoUv = 0xffffffffu;
};

enum class CameraType : std::uint8_t {
    kPerspective,  ///< a pinhole
    kOrthographic  ///< parallel rays, which begin on the plane through the position
};

/// Image right is (target - position) x up.
struct Camera {
    glm::vec3 position{0.0f, 0.0f, 1.0f};
    glm::vec3 target{0.0f};
    glm::vec3 up{0.0f, 1.0f, 0.0f};
    float vfov = 40.0f;  ///< kPerspective: full vertical angle in degrees, in (0, 180)
    CameraType type = CameraType::kPerspective;
    float height = 1.0f;  ///< kOrthographic: of the image in scene units, > 0
};

enum class Sampler : std::uint8_t { kSobol, kIndependent };

enum class Integrator : std::uint8_t {
    kPathTracer,  ///< paths from the camera
    kLightTracer  ///< paths from the emitters
};

/// As in scene files and on the command line.
const char* nameOf(CameraType type);
const char* nameOf(Sampler sampler);
const char* nameOf(Integrator integrator);
template <>
inline constexpr std::array kValuesOf<CameraType>{CameraType::kPerspective, CameraType::kOrthographic};
template <>
inline constexpr std::array kValuesOf<Sampler>{Sampler::kSobol, Sampler::kIndependent};
template <>
inline constexpr std::array kValuesOf<Integrator>{Integrator::kPathTracer, Integrator::kLightTracer};

struct RenderSettings {
    static constexpr std::uint32_t kLargestSize = 16384, kMostSpp = 1u << 24, kMostBounces = 65535;

    std::uint32_t width = 512, height = 512;  ///< pixels, 1..kLargestSize
    std::uint32_t spp = 64;                   ///< samples, or light paths, per pixel, 1..kMostSpp
    std::uint32_t bounces = 16;  ///< largest number of scattering events on a path, 0..kMostBounces
    std::uint32_t seed = 1;
    Sampler sampler = Sampler::kSobol;
    Integrator integrator = Integrator::kPathTracer;
    std::uint32_t layers = 0;  ///< optional layers of the film, a FilmLayerSet; kPathTracer only

    float aspect() const { return static_cast<float>(width) / static_cast<float>(height); }
};

/// Emits the same radiant intensity in all directions, in W sr^-1 (scene units), components >= 0.
struct PointEmitter {
    glm::vec3 position;
    glm::vec3 invisible{0.0f};
    glm::vec3 visible{0.0f};
};

/// A validated scene: every index in range, every number finite, at least one triangle, no zero-length camera
/// vectors.
struct Scene {
    std::filesystem::path source;  ///< the file that was loaded, for messages
    Camera camera;
    glm::vec2 display{0.0f, 1.0f};  ///< the row d of eq. 8; the displayed radiance is d . L
    Reflectance reflectance;        ///< scene-wide
    std::vector<Material> materials;
    Geometry geometry;
    std::vector<PointEmitter> pointEmitters;
    std::vector<std::shared_ptr<const Image>> images;  ///< not null
    /// Is subtracted from the file's coordinates, so that `camera` and `geometry` keep their precision as
    /// floats; 0 unless the scene is far from the origin for its extent.
    glm::dvec3 origin{0.0};
    /// The numbers of items that come from the files; those of an added lamp follow them.
    struct Content {
        std::size_t positions = 0, triangles = 0, materials = 0;
    } content;

    const Reflectance& reflectanceOf(const Material& material) const {
        return material.reflectance ? *material.reflectance : reflectance;
    }
};

/// A scene as its files describe it, with what else they say and what their readers noticed.
struct LoadedScene : Scene {
    RenderSettings settings;
    std::vector<ImageSource> imageSources;     ///< of `images`
    std::vector<Warning> warnings;             ///< lamp added, missing file, degenerate triangles ...
    std::vector<std::filesystem::path> files;  ///< all that were read
    std::uint64_t meshBytes = 0;               ///< size of those that hold meshes
};

/// True at the indices of materials, `count` of them, that triangles refer to.
std::vector<bool> usedMaterials(const Geometry& geometry, std::size_t count);
inline std::vector<bool> usedMaterials(const Scene& scene) {
    return usedMaterials(scene.geometry, scene.materials.size());
}

/// Sets Scene::content: everything in the scene comes from its files.
void noteContent(Scene& scene);

/// Removes everything that was added after noteContent.
void removeLamp(Scene& scene);

/// Axis-aligned bounds of all referenced vertices.
struct Bounds {
    glm::vec3 lower, upper;
};
Bounds boundsOf(const Geometry& geometry);

}  // namespace duolux

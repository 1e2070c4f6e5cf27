#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "host/scene/scene.h"

namespace duolux {

enum class EmitterKind : std::uint8_t { kTriangle, kPoint };

/// What emits in a scene. A switch on the kind has no default, so that a further kind does not compile until
/// it is handled.
struct SceneEmitter {
    EmitterKind kind;
    std::uint32_t index;  ///< of the triangle, or into Scene::pointEmitters
    Emission emission;    ///< kPoint: radiant intensity in place of radiance
    double area;          ///< of one side, in scene units squared; kPoint: 0
};

/// All emitters: the triangles of emitting materials, ascending, even those without area; then the point
/// emitters in their order, even those without intensity.
std::vector<SceneEmitter> listEmitters(const Scene& scene);

/// Whether a material, or a triangle, emits.
inline bool emits(const Material& material) {
    return material.emission.any();
}
bool emits(const Scene& scene, std::size_t triangle);

/// Appends the point emitters of a scene to a list of its triangles that emit.
void addPointEmitters(const Scene& scene, std::vector<SceneEmitter>& emitters);

/// Whether anything emits: listEmitters is not empty.
bool anyEmitter(const Scene& scene);

/// The indices of the triangles in a list of emitters.
std::vector<std::uint32_t> emittingTriangles(std::span<const SceneEmitter> emitters);

/// The triangles that emit, ascending.
std::vector<std::uint32_t> emittingTriangles(const Scene& scene);

/// The area of one side of a triangle.
double areaOf(const Geometry& geometry, std::size_t triangle);

}  // namespace duolux

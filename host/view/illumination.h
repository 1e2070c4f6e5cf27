#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "host/view/surface.h"

namespace duolux {

/// A point of a surface, on one of its sides.
struct SurfacePoint {
    glm::vec3 position;
    glm::vec3 normal;  ///< unit, on the point's side
    std::uint32_t triangle;
    bool front;
};

/// How far ahead of a surface rays begin, in units of the scene's radius.
inline constexpr float kOffset = 1e-5f;

/// The point of a ray's hit, on the side from which the ray comes.
SurfacePoint pointOf(const Surface& surface, const glm::vec3& origin, const glm::vec3& direction,
                     const Surface::Hit& hit);

/// Estimates how brightly the emitters of a scene light its surfaces, by a few random paths with ordinary
/// global illumination, whatever the scene's reflectance matrices. Values are means over the channels.
class Illumination {
  public:
    /// Uses all emitters, or those of one material; emitting as specified, or all of them on both sides.
    explicit Illumination(const Surface& surface, std::optional<std::uint32_t> material = std::nullopt,
                          bool bothSides = false);

    /// Whether anything emits invisible light, which lights other surfaces.
    bool lights() const { return !emitters_.empty(); }

    /// Radiance that a white surface would reflect here; deterministic for a given seed.
    float onWhite(const SurfacePoint& point, std::uint32_t seed, int paths) const;

    /// Visible radiance that the surface itself emits here.
    float emitted(const SurfacePoint& point) const;

  private:
    struct Emitter {
        EmitterKind kind;
        std::uint32_t index;  // of the triangle
        double powerBefore;   // total power of the preceding emitters
        glm::vec3 normal;     // of a triangle
        bool both;            // sides of a triangle
        glm::vec3 position;   // of a point
    };

    float fromPoint(const Emitter& emitter, const SurfacePoint& point, const glm::vec3& origin) const;
    float fromTriangle(const Emitter& emitter, const SurfacePoint& point, const glm::vec3& origin,
                       const glm::vec3& random) const;
    float direct(const SurfacePoint& point, const glm::vec3& random) const;

    const Surface& surface_;
    std::vector<Emitter> emitters_;
    double power_ = 0.0;
};

/// Whether this side of surfaces with this material reflects light.
bool scatters(const Material& material, bool front);

}  // namespace duolux

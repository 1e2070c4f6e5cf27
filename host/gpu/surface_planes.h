#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "host/scene/scene.h"

namespace duolux {

/// What the device needs to know of a scene's triangles where distances from their corners would not do:
/// where surfaces coincide, or where triangles are many times farther than what is between them, like a
/// ground that reaches to the horizon.
class SurfacePlanes {
  public:
    explicit SurfacePlanes(const Scene& scene);

    /// Kernels find distances by planes (shared::kSpecPlanes). Nothing below has a meaning otherwise.
    bool used() const { return used_; }

    /// The front's unit normal of a triangle, and dot(normal, x) on it: to the bit the same, but for the
    /// sign, for all that coincide.
    glm::vec4 planeOf(std::uint32_t triangle) const;

    /// Other triangles coincide with this one.
    bool coincident(std::uint32_t triangle) const { return !shared_.empty() && shared_[triangle]; }

    /// The place of a triangle among coincident ones that face the same way: an emitter is before what is no
    /// emitter, so that a lamp in the plane of a ceiling shines; else they are in the order of the scene.
    std::uint32_t rankOf(std::uint32_t triangle) const { return used_ ? ranks_[triangle] : triangle; }

  private:
    const Geometry* geometry_;
    std::vector<std::uint32_t> groups_;  ///< as coincidentGroups
    std::vector<bool> shared_;
    std::vector<std::uint32_t> ranks_;
    bool used_ = false;
};

}  // namespace duolux

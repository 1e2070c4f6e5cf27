#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "host/scene/scene.h"

namespace duolux {

/// Planes of a scene's triangles. Kernels need them where distances computed from the corners are
/// too inaccurate: where surfaces coincide, or where triangles are much larger than the rest of the scene,
/// such as a ground plane that extends to the horizon.
class SurfacePlanes {
  public:
    explicit SurfacePlanes(const Geometry& geometry);

    /// Whether kernels compute distances from planes (shared::kSpecPlanes). If not, the functions below do
    /// not apply.
    bool used() const { return used_; }

    /// The unit normal on the triangle's front side, and dot(normal, x). Bitwise identical, except for the
    /// sign, for all coincident triangles.
    glm::vec4 planeOf(std::uint32_t triangle) const;

    /// Whether other triangles coincide with this one.
    bool coincident(std::uint32_t triangle) const { return !shared_.empty() && shared_[triangle]; }

  private:
    const Geometry* geometry_;
    std::vector<std::uint32_t> groups_;  ///< as coincidentGroups
    std::vector<bool> shared_;
    bool used_ = false;
};

}  // namespace duolux

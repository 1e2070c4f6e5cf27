#pragma once

#include <cstdint>
#include <glm/glm.hpp>

#include "host/base/random.h"
#include "host/view/illumination.h"

namespace duolux {

/// The part of random directions in which one side of the surface faces others.
float facedPart(const Surface& surface, const SurfacePoint& point, Random& random);

/// Whether a surface belongs to an open hollow whose inside is made of back sides, such as a box without one
/// of its walls whose normals point outwards. `front`: a point on the front side.
bool isInsideOut(const Surface& surface, const SurfacePoint& front, std::uint32_t seed);

/// Whether all emitting triangles are in spaces that are closed all around, as lamps in rooms are, and wide
/// enough for a camera.
class EnclosedEmitters {
  public:
    explicit EnclosedEmitters(const Surface& surface);

    /// Whether there are such triangles, and none of them is seen from outside.
    bool all() const { return enclosed_; }

    /// Whether a point sees any of the emitters from one of their sides.
    bool areSeenFrom(const glm::vec3& point) const;

  private:
    const Surface& surface_;
    std::vector<SurfacePoint> points_;  // both sides
    bool enclosed_ = false;
};

}  // namespace duolux

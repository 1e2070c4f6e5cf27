#pragma once

#include <array>
#include <vector>

#include "host/view/illumination.h"
#include "host/view/surface.h"

namespace duolux {

/// The view of a camera: its axes (orthonormal), and half its width and height at distance 1 or, if its rays
/// are parallel, at any distance.
struct Frustum {
    glm::vec3 eye, forward, right, up;
    float halfWidth, halfHeight;
    bool parallel = false;

    bool contains(const glm::vec3& point) const;
    /// Where the ray begins that shows a point.
    glm::vec3 eyeFor(const glm::vec3& point) const;
};

/// Points spread evenly over the surface that a camera should show, with the worth of each of their two sides
/// in an image: front sides are worth more than back sides (in hollows that are inside out: less), sides that
/// face other surfaces more than those that face none and, if emitters light the scene, lit sides more than
/// unlit ones.
class ViewSamples {
  public:
    ViewSamples(const Surface& surface, const Illumination& illumination);

    /// The worth of surfaces that face no others, relative to the inside of a hollow: there is more to see.
    static constexpr float kFacesNothing = 0.5f;

    /// The worth of the samples that a camera sees, relative to all samples: those within the frustum that
    /// nothing hides, with less weight at grazing angles. `seen`, if not null, receives them.
    float worthOf(const Frustum& frustum, std::vector<bool>* seen = nullptr) const;

    /// The fraction of the samples whose front side is seen from a point, in all directions.
    float frontsSeenFrom(const glm::vec3& point) const;

    /// How brightly the emitters light the surface: the mean over the samples of the radiance, up to 1, of
    /// white on the brighter side (reflected or emitted).
    float brightness() const { return brightness_; }

    std::size_t size() const { return samples_.size(); }
    const SurfacePoint& front(std::size_t sample) const { return samples_[sample].front; }

  private:
    float worthOf(const SurfacePoint& point, bool insideOut, float white) const;

    struct Sample {
        SurfacePoint front;
        std::array<float, 2> worth{};  // of the front and the back
    };

    const Surface& surface_;
    std::vector<Sample> samples_;
    float brightness_ = 0.0f;
};

/// Emitters matter if white surfaces have, on average, at least this percentage of white's radiance.
inline constexpr int kDarkPercent = 5;
inline constexpr float kDark = 0.01f * kDarkPercent;

}  // namespace duolux

#pragma once

#include <array>
#include <vector>

#include "host/view/illumination.h"
#include "host/view/surface.h"

namespace duolux {

/// What a camera takes in: its axes (unit, orthogonal) and half its width and height at distance 1.
struct Frustum {
    glm::vec3 eye, forward, right, up;
    float tangentX, tangentY;

    bool contains(const glm::vec3& point) const;
};

/// Points spread evenly over the surface that a camera should show, and what each of their two sides is worth
/// in a picture: fronts more than backs and, where emitters light the scene, what they reach more than what
/// they do not.
class ViewSamples {
  public:
    ViewSamples(const Surface& surface, const Illumination& illumination);

    /// What a camera there sees, as a part of what there is: of the samples within the frustum that nothing
    /// hides, with less weight where the view grazes the surface. `seen` notes them, if it is there.
    float worthOf(const Frustum& frustum, std::vector<bool>* seen = nullptr) const;

    /// The part of the samples whose front a point sees, in all directions.
    float frontsSeenFrom(const glm::vec3& point) const;

    /// How brightly the emitters light the surface: what white would show, or emits, up to 1, by the brighter
    /// side of every sample, on average.
    float brightness() const { return brightness_; }

    /// What a side of the surface is worth.
    float worthOf(const SurfacePoint& point, float white) const;

    std::size_t size() const { return samples_.size(); }
    const SurfacePoint& front(std::size_t sample) const { return samples_[sample].front; }

  private:
    struct Sample {
        SurfacePoint front;
        std::array<float, 2> worth{};  // of the front and the back
    };

    const Surface& surface_;
    std::vector<Sample> samples_;
    float brightness_ = 0.0f;
};

/// Emitters matter where they show white surfaces, on average, at this part of white or more.
inline constexpr int kDarkPercent = 5;
inline constexpr float kDark = 0.01f * kDarkPercent;

}  // namespace duolux

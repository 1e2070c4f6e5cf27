#pragma once

#include <cmath>
#include <numbers>

#include "host/scene/scene.h"
#include "tests/reference/matrix2.h"

namespace duolux::reference {

struct Ray {
    Vec3 origin, direction;  ///< unit direction
};

/// Camera rays in double precision. Image right is (target - position) x up, rows count from the top.
class Pinhole {
  public:
    Pinhole(const Camera& camera, std::uint32_t width, std::uint32_t height)
        : parallel_(camera.type == CameraType::kOrthographic),
          position_(camera.position),
          width_(width),
          height_(height) {
        const double tangent = std::tan(static_cast<double>(camera.vfov) * std::numbers::pi / 360.0);
        const double half = parallel_ ? 0.5 * static_cast<double>(camera.height) : tangent;
        forward_ = glm::normalize(Vec3(camera.target) - position_);
        const Vec3 right = glm::normalize(glm::cross(forward_, Vec3(camera.up)));
        right_ = right * (half * width / height);
        up_ = glm::cross(right, forward_) * half;
    }

    /// Through the point (x, y) of the film, in pixels from its top left corner.
    Ray ray(double x, double y) const {
        const double u = 2.0 * x / width_ - 1.0;
        const double v = 1.0 - 2.0 * y / height_;
        const Vec3 across = u * right_ + v * up_;
        if (parallel_) return {position_ + across, forward_};
        return {position_, glm::normalize(forward_ + across)};
    }

  private:
    bool parallel_;  // orthographic
    Vec3 position_, forward_, right_, up_;
    double width_, height_;
};

}  // namespace duolux::reference

#pragma once

#include <vector>

#include "tests/support/closed_form.h"
#include "tests/support/exact_case.h"
#include "tests/support/scene_builder.h"

namespace duolux::test {

/// A horizontal rectangle with the corners (x0, y, z0) and (x1, y, z1) that faces down.
std::vector<Vec3> downwardRectangle(double x0, double x1, double z0, double z1, double y);

/// A small diffuse surface about the origin, seen so closely that every pixel shows the same point; and
/// emitters.
class ReceiverScene {
  public:
    struct Receiver {
        glm::vec3 normal{0, 1, 0};
        glm::vec3 albedo{0.6f, 0.8f, 0.3f};
        Sides sides = Sides::kBoth;
        Reflectance reflectance;
    };

    /// `eye`: direction towards the camera.
    ReceiverScene(const Receiver& receiver, glm::vec3 eye);

    SceneBuilder& builder() { return builder_; }

    /// Adds an emitter of 3 or 4 corners, counter-clockwise seen from the front.
    void emitter(const std::vector<Vec3>& polygon, const Emission& emission, const Reflectance& reflectance);

    /// albedo / pi O times the sum of `irradiance` over the emitters.
    ChannelLight reflected(const ChannelLight& irradiance) const;

    ExactCase finish(std::string name, std::uint32_t bounces, const ChannelLight& expected) const;

  private:
    SceneBuilder builder_;
    Receiver receiver_;
};

}  // namespace duolux::test

#pragma once

#include <glm/glm.hpp>
#include <utility>
#include <vector>

namespace duolux {

/// Up, front and right of a scene: +y, +z and +x or, with z up, +z, -y and +x.
struct ViewAxes {
    glm::vec3 up, front, right;

    explicit ViewAxes(const glm::dvec3& upwards);

    /// Angles in degrees: `azimuth` from the front to the right, `elevation` above the horizon.
    glm::vec3 direction(float azimuth, float elevation) const;

    /// The up vector of a camera: up, or away from the front if the view is vertical.
    glm::vec3 upFor(const glm::vec3& forward) const;

    /// The right and up axes of a camera; orthonormal.
    std::pair<glm::vec3, glm::vec3> across(const glm::vec3& forward) const;
};

/// A direction from which to view a scene, and its preference, up to 1.
struct OutsideDirection {
    glm::vec3 towardsEye;
    float preference;
};
std::vector<OutsideDirection> outsideDirections(const ViewAxes& axes);

/// Roughly horizontal directions all around.
std::vector<glm::vec3> lookAround(const ViewAxes& axes);

/// Point `index` of `count` points spread evenly over the unit sphere.
glm::vec3 onSphere(int index, int count);

}  // namespace duolux

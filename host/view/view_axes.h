#pragma once

#include <glm/glm.hpp>
#include <utility>
#include <vector>

namespace duolux {

/// Up, the front of a scene and its right: y, +z and +x, or for z up z, -y and +x.
struct ViewAxes {
    glm::vec3 up, front, right;

    explicit ViewAxes(const glm::dvec3& upwards);

    /// Angles in degrees, from the front to the right, and above the horizon.
    glm::vec3 direction(float azimuth, float elevation) const;

    /// A camera's up: upwards, or away from the front's side if the view is along that.
    glm::vec3 upFor(const glm::vec3& forward) const;

    /// A camera's right and up, unit and orthogonal.
    std::pair<glm::vec3, glm::vec3> across(const glm::vec3& forward) const;
};

/// A direction to look at a scene from, and how well people like it, up to 1.
struct OutsideDirection {
    glm::vec3 towardsEye;
    float preference;
};
std::vector<OutsideDirection> outsideDirections(const ViewAxes& axes);

/// Directions all around, about horizontal.
std::vector<glm::vec3> lookAround(const ViewAxes& axes);

/// Of `count` points spread evenly over the unit sphere.
glm::vec3 onSphere(int index, int count);

}  // namespace duolux

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "host/base/random.h"
#include "host/scene/image_plane.h"

// Where camera rays start: in front of all that the camera sees, and, for a distant camera, close to it.

namespace duolux::test {
namespace {

glm::dvec3 direction(Random& random) {
    const auto number = [&] { return 2.0 * static_cast<double>(random.uniform()) - 1.0; };
    return glm::normalize(glm::dvec3(number(), number(), number()) + 1e-3);
}

/// The smallest depth of the corners of the bounds, seen by the camera.
double nearestDepth(const Camera& camera, const Bounds& bounds) {
    const glm::dvec3 forward = glm::normalize(glm::dvec3(camera.target) - glm::dvec3(camera.position));
    double nearest = std::numeric_limits<double>::max();
    for (int corner = 0; corner < 8; ++corner) {
        glm::dvec3 p(bounds.lower);
        for (int axis = 0; axis < 3; ++axis)
            if ((corner >> axis & 1) != 0) p[axis] = static_cast<double>(bounds.upper[axis]);
        nearest = std::min(nearest, glm::dot(forward, p - glm::dvec3(camera.position)));
    }
    return nearest;
}

TEST(RayStart, OfADistantCameraIsJustInFrontOfTheScene) {
    const Bounds bounds{{-1.0f, -2.0f, -0.5f}, {3.0f, 1.0f, 2.5f}};
    const double size = glm::length(glm::dvec3(bounds.upper - bounds.lower));
    Random random(1);
    for (int i = 0; i < 1000; ++i) {
        const double distance = size * std::exp2(5.0 + 13.0 * static_cast<double>(random.uniform()));
        Camera camera;
        camera.target = glm::vec3(1.0f, -0.5f, 1.0f);
        camera.position = glm::vec3(glm::dvec3(camera.target) + distance * direction(random));
        const RayStart start = rayStart(camera, bounds);
        const double nearest = nearestDepth(camera, bounds);
        const double rounding = 2e-7 * distance;
        EXPECT_LT(static_cast<double>(start.depth), nearest - 0.5 * size + rounding);
        EXPECT_GT(static_cast<double>(start.depth), nearest - 2.0 * size - rounding);
        const glm::dvec3 forward = glm::normalize(glm::dvec3(camera.target) - glm::dvec3(camera.position));
        const glm::dvec3 expected = glm::dvec3(camera.position) + static_cast<double>(start.depth) * forward;
        EXPECT_LT(glm::length(glm::dvec3(start.position) - expected), rounding);
    }
}

TEST(RayStart, OfANearCameraIsItsPosition) {
    const Bounds bounds{glm::vec3(-1.0f), glm::vec3(1.0f)};
    Camera camera;
    for (const float distance : {0.0f, 0.5f, 3.0f, 20.0f}) {
        camera.position = {0.0f, 0.0f, distance};
        camera.target = camera.position - glm::vec3(0.0f, 0.0f, 1.0f);
        const RayStart start = rayStart(camera, bounds);
        EXPECT_EQ(start.position, camera.position);
        EXPECT_EQ(start.depth, 0.0f);
    }
}

}  // namespace
}  // namespace duolux::test

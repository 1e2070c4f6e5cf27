#pragma once

#include <cstdint>
#include <glm/glm.hpp>

#include "host/scene/scene.h"

namespace duolux {

/// The image plane of a camera: at distance 1, or through the position of an orthographic one. Its points
/// (x, y), both from -1 to 1 with y upwards, lie at x right + y up from its middle.
struct ImagePlane {
    glm::vec3 forward;  ///< unit
    glm::vec3 right;    ///< half the width
    glm::vec3 up;       ///< half the height
    float area;         ///< of all of it
};

/// Of a picture whose width is `aspect` times its height.
ImagePlane imagePlane(const Camera& camera, double aspect);
/// Of a picture of width x height square pixels.
ImagePlane imagePlane(const Camera& camera, std::uint32_t width, std::uint32_t height);

struct CameraRay {
    glm::vec3 origin;
    glm::vec3 direction;  ///< unit
};

/// Through a point of the image plane.
CameraRay cameraRay(const Camera& camera, const ImagePlane& plane, glm::vec2 point);

/// Where camera rays may begin: nothing of the scene is nearer than the plane at this depth.
struct RayStart {
    glm::vec3 position;  ///< on the camera's axis
    float depth;         ///< distance from the camera, along the axis
};

/// The camera itself, unless the scene is many times its size away: single precision, relative to a point
/// that far, would not tell small triangles apart.
RayStart rayStart(const Camera& camera, const Bounds& bounds);

}  // namespace duolux

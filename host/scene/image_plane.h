#pragma once

#include <cstdint>
#include <glm/glm.hpp>

#include "host/scene/scene.h"

namespace duolux {

/// The image plane of a camera: at distance 1, or through the position of an orthographic camera. The point
/// (x, y), both from -1 to 1 with y upwards, has the offset x right + y up from the centre.
struct ImagePlane {
    glm::vec3 forward;  ///< unit
    glm::vec3 right;    ///< half the width
    glm::vec3 up;       ///< half the height
    float area;         ///< of the whole image plane
};

/// The image plane for an image whose width is `aspect` times its height.
ImagePlane imagePlane(const Camera& camera, double aspect);
/// The image plane for an image of width x height square pixels.
ImagePlane imagePlane(const Camera& camera, std::uint32_t width, std::uint32_t height);

struct CameraRay {
    glm::vec3 origin;
    glm::vec3 direction;  ///< unit
};

/// The camera ray through a point of the image plane.
CameraRay cameraRay(const Camera& camera, const ImagePlane& plane, glm::vec2 point);

/// Whether all camera rays have the same direction, so that the image shows as much at every depth as on its
/// plane. Otherwise it shows as much as on its plane times the depth.
bool hasParallelRays(CameraType type);

/// A start for camera rays: no part of the scene is nearer than the plane at this depth.
struct RayStart {
    glm::vec3 position;  ///< on the camera's axis
    float depth;         ///< distance from the camera, along the axis
};

/// The camera's position, unless its distance is many times the size of the scene: single precision, relative
/// to such a distant point, could not separate small triangles.
RayStart rayStart(const Camera& camera, const Bounds& bounds);

}  // namespace duolux

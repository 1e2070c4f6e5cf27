#pragma once

#include <cstdint>
#include <glm/glm.hpp>

#include "host/scene/scene.h"

namespace duolux {

/// The image plane of a camera at distance 1: the point (x, y) of it, both from -1 to 1, y upwards, lies in
/// the direction forward + x right + y up.
struct ImagePlane {
    glm::vec3 forward;  ///< unit
    glm::vec3 right;    ///< half the width
    glm::vec3 up;       ///< half the height
    float area;         ///< of all of it
};

/// Of a picture of width x height square pixels.
ImagePlane imagePlane(const Camera& camera, std::uint32_t width, std::uint32_t height);

}  // namespace duolux

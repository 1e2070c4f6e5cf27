#pragma once

#include <glm/glm.hpp>
#include <optional>

#include "host/scene/scene.h"

namespace duolux {

/// The specified parts of a camera, in the coordinates of the scene's file; the other parts are chosen
/// automatically. Vectors are finite, `up` is not 0, `vfov` is in (0, 180), `height` > 0.
struct CameraChoice {
    std::optional<glm::dvec3> position, target, up;
    std::optional<float> vfov;
    std::optional<CameraType> type;
    std::optional<float> height;        ///< of an orthographic image, in scene units
    glm::dvec3 upwards{0.0, 1.0, 0.0};  ///< up in the scene, where `up` is not specified; not 0

    /// This choice with the specified parts of `other` taking precedence.
    CameraChoice overriddenBy(const CameraChoice& other) const;
    bool complete() const { return position && target; }

    struct Contradiction {
        const char *problem, *remedy;
    };
    /// The first contradiction between the parts; empty if they are consistent.
    std::optional<Contradiction> contradiction() const;
};

}  // namespace duolux

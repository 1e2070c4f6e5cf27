#pragma once

#include <optional>

#include "host/view/view_axes.h"
#include "host/view/view_samples.h"

namespace duolux {

/// A camera inside of what encloses it.
struct InsideView {
    glm::vec3 eye, target;
    float vfov;
    float worth;  ///< as ViewSamples::worthOf
};

/// The best view of a closed room from near one of its walls; none if nothing is enclosed, or the scene is
/// rather a solid body: not lit by its own emitters, and with fronts outside, or neither hollow and round nor
/// holding anything that is not seen from outside. `unseen`: the part of the samples that is not.
std::optional<InsideView> bestInsideView(const Surface& surface, const ViewSamples& samples,
                                         const ViewAxes& axes, float aspect, std::optional<float> vfov,
                                         const std::optional<glm::vec3>& target, float unseen);

/// A wide vertical angle.
float insideVfov(float aspect);

}  // namespace duolux

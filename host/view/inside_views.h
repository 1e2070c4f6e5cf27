#pragma once

#include <optional>

#include "host/view/hollows.h"
#include "host/view/view_axes.h"
#include "host/view/view_samples.h"

namespace duolux {

/// A camera inside a closed room.
struct InsideView {
    glm::vec3 eye, target;
    float vfov;
    float worth;  ///< as ViewSamples::worthOf
};

/// What bestInsideView chooses by.
struct InsideSearch {
    const Surface& surface;
    const ViewSamples& samples;
    const EnclosedEmitters& emitters;
    const ViewAxes& axes;
    float aspect;                     ///< width over height of the image
    std::optional<float> vfov;        ///< if given
    std::optional<glm::vec3> target;  ///< if given, in the local coordinates of the surface
    float unseen;                     ///< the fraction of the samples that are hidden from outside
};

/// The best view of a closed room from near one of its walls. Empty if the scene encloses no space or is a
/// solid body: it does not enclose its emitters, they do not light it, and its front sides face outwards, or
/// it is neither hollow and round nor contains anything that is hidden from outside. If spaces enclose all
/// emitters, the view is of one of these.
std::optional<InsideView> bestInsideView(const InsideSearch& search);

/// The wide vertical angle of view for an inside view.
float insideVfov(float aspect);

}  // namespace duolux

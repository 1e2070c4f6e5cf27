#pragma once

#include "host/scene/camera_choice.h"
#include "host/view/view_samples.h"

namespace duolux {

/// A camera with all that `choice` says; the rest is such that the picture, of width over height `aspect`,
/// shows much of the surface:
/// - a three-quarter view from above, from where most of the surface is seen, lit and from its front, and as
///   near as all of it stays in view;
/// - the open side of a box, straight;
/// - the inside of a closed room, from near a wall with a wide angle, if that shows more.
/// `choice` does not contradict itself. In the coordinates of the scene.
Camera frameCamera(const CameraChoice& choice, const Surface& surface, const ViewSamples& samples,
                   float aspect);

/// Of a choice that has position and target.
Camera completeCamera(const CameraChoice& choice);

}  // namespace duolux

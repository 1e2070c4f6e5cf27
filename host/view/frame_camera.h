#pragma once

#include "host/scene/camera_choice.h"
#include "host/view/view_samples.h"

namespace duolux {

/// Completes `choice` to a camera whose image, with the ratio `aspect` of width to height, shows much of the
/// surface. The view is one of these:
/// - a three-quarter view from above that shows the most lit front sides, as near as possible with all of the
///   surface in view;
/// - a straight view into the open side of a box;
/// - a wide-angle view of a closed room from near a wall, if this shows more.
/// `choice` must be consistent. In the coordinates of the scene.
Camera frameCamera(const CameraChoice& choice, const Surface& surface, const ViewSamples& samples,
                   float aspect);

/// The camera of a choice that has both position and target.
Camera completeCamera(const CameraChoice& choice);

}  // namespace duolux

#pragma once

#include "host/scene/scene.h"

namespace duolux {

/// A camera that looks at the middle of the scene from the front (+z) and a little above, as near as the
/// bounds stay in view, with some margin, in a picture of the size that the render settings say.
Camera frameCamera(const Scene& scene);

}  // namespace duolux

#pragma once

#include <string>

#include "host/scene/scene.h"

namespace duolux {

/// 16 hex digits over everything the image depends on but the render settings: geometry, materials,
/// reflectances, camera and display row. Names, warnings and the file do not count.
std::string hashScene(const Scene& scene);

}  // namespace duolux

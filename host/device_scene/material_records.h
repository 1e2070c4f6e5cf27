#pragma once

#include <vector>

#include "host/scene/scene.h"
#include "shaders/shared/material_layout.h"

namespace duolux {

/// The records of the scene's materials, with the reflectances that apply to them.
std::vector<shared::DeviceMaterial> makeMaterialRecords(const Scene& scene);

}  // namespace duolux

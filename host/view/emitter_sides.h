#pragma once

#include <vector>

#include "host/view/surface.h"

namespace duolux {

/// Warnings about emitters that emit only from their front sides: those whose back sides could light much
/// more than their front sides do, and those whose back sides alone are in view, unless their front sides
/// light more. One for each material.
std::vector<Warning> emitterWarnings(const Surface& surface, const Camera& camera, float aspect);

}  // namespace duolux

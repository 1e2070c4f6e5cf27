#pragma once

#include "host/scene/json_node.h"
#include "host/scene/scene.h"

namespace duolux {

/// {"preset": name}, {"blend": [t, o]} or {"opaque": M, "transparent": M}.
Reflectance readReflectance(const JsonNode& node);

/// {"invisible": c, "visible": c, "sides": s}: what is absent stays as it is in `emission`.
void readEmission(const JsonNode& node, Emission& emission);

/// Each key of the object overrides what the material has.
void readMaterial(const JsonNode& node, Material& material);

}  // namespace duolux

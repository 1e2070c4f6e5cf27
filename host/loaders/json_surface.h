#pragma once

#include "host/loaders/json_node.h"
#include "host/scene/scene.h"

namespace duolux {

/// {"preset": name}, {"blend": [t, o]} or {"opaque": M, "transparent": M}.
Reflectance readReflectance(const JsonNode& node);

/// {"invisible": c, "visible": c, "sides": s}; absent keys leave `emission` unchanged.
void readEmission(const JsonNode& node, Emission& emission);

/// The components of a point emitter's radiant intensity.
void readIntensity(const JsonNode& node, PointEmitter& emitter);

}  // namespace duolux

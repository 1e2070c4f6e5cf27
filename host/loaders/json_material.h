#pragma once

#include "host/loaders/json_image.h"
#include "host/loaders/json_node.h"
#include "host/scene/material.h"

namespace duolux {

/// Each key of the object overrides a property of the material. A number or colour also removes the image
/// that scaled the property.
void readMaterial(const JsonNode& node, Material& material, JsonImages& images);

}  // namespace duolux

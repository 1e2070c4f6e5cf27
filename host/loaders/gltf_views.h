#pragma once

#include <glm/glm.hpp>
#include <optional>

#include "host/loaders/gltf_document.h"
#include "host/scene/camera_choice.h"
#include "host/scene/mesh.h"

namespace duolux {

/// A candela is 1/683 W/sr, as for monochromatic light at 540 THz (SI), and as Blender's importer has it.
inline constexpr double kCandelasPerWatt = 683.0;

/// The light of a node (KHR_lights_punctual). Empty if it has none, or none that is supported. Throws
/// InputError.
std::optional<PlacedPointEmitter> readGltfLight(const JsonNode& node, const glm::dmat4& world,
                                                const GltfDocument& document, GltfNotes& notes);

/// A camera, at the node of this transform. `distance`: from its position to its target, > 0. Throws
/// InputError.
CameraChoice readGltfCamera(const JsonNode& camera, const glm::dmat4& world, double distance,
                            GltfNotes& notes);

}  // namespace duolux

#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

#include "host/scene/camera_choice.h"
#include "host/scene/scene.h"
#include "host/scene/tally.h"

namespace duolux {

/// Whether a lamp is added to a scene.
enum class Lamp : std::uint8_t {
    kIfDark,  ///< where nothing emits, or too little to matter, some surface scatters, and the scene's file
              ///< does not list lights
    kAlways,
    kNever
};

/// What a caller says of a scene, in place of what its file says or what would be chosen.
struct SceneChoices {
    CameraChoice camera{};  ///< each part for itself
    Lamp lamp = Lamp::kIfDark;
    std::optional<glm::uvec2> size = std::nullopt;  ///< of the picture, which an automatic camera fills
    std::optional<Reflectance> reflectance = std::nullopt;
    std::optional<std::uint32_t> bounces = std::nullopt;
    Reading reading = Reading::kLenient;
};

/// Loads a scene by its extension: .obj (with its MTL; reflectance `global`) or .json (the scene format).
/// What neither the file nor the caller says is chosen: what is missing of the camera, a lamp, and of bounces
/// 16, or kBouncesOfGrowth where light may grow with every bounce; the scene's warnings tell of the latter
/// two. Throws InputError.
Scene loadScene(const std::filesystem::path& path, const SceneChoices& choices = {});

/// Bounces where nobody says how many and the series of bounces may have no sum.
inline constexpr std::uint32_t kBouncesOfGrowth = 4;

}  // namespace duolux

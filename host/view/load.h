#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

#include "host/loaders/tally.h"
#include "host/scene/camera_choice.h"
#include "host/scene/scene.h"

namespace duolux {

/// Whether a lamp is added to a scene.
enum class Lamp : std::uint8_t {
    kIfDark,  ///< if there is no emission, or too little to matter, some surface scatters, and the scene's
              ///< file does not list lights
    kAlways,
    kNever
};

/// Choices of the caller. They take precedence over the scene's file and over automatic choices.
struct SceneChoices {
    CameraChoice camera{};  ///< each part is optional
    Lamp lamp = Lamp::kIfDark;
    std::optional<glm::uvec2> size = std::nullopt;  ///< of the image that an automatic camera fills
    std::optional<Reflectance> reflectance = std::nullopt;
    std::optional<std::uint32_t> bounces = std::nullopt;
    Reading reading = Reading::kLenient;
};

/// Loads a scene by its extension: a mesh such as .obj (with its MTL), with the reflectance `global`, or .json
/// (the scene format).
/// Values that neither the file nor the caller specifies are chosen automatically: missing parts of the
/// camera, a lamp, and 16 bounces, or kBouncesOfGrowth if light may grow with every bounce. A lamp and
/// kBouncesOfGrowth are reported in the scene's warnings. Throws InputError.
LoadedScene loadScene(const std::filesystem::path& path, const SceneChoices& choices = {});

/// The default number of bounces if the series of bounces may diverge.
inline constexpr std::uint32_t kBouncesOfGrowth = 4;

}  // namespace duolux

#pragma once

#include <filesystem>

#include "host/scene/scene.h"

namespace duolux {

/// Loads a scene by its extension: .obj (with its MTL; camera framed automatically, default light with a
/// warning if nothing emits, reflectance `global`) or .json (the scene format; camera likewise if it has no
/// "camera", default light if nothing emits and it has no "lights"). Throws InputError.
Scene loadScene(const std::filesystem::path& path);

}  // namespace duolux

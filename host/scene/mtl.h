#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "host/scene/scene.h"

namespace duolux {

struct MaterialLibrary {
    std::vector<Material> materials;  ///< names differ
    std::vector<std::string> warnings;
};

/// Reads an MTL file: `Kd` is the diffuse albedo (0.8 where it is absent), `Ke` the radiance emitted from the
/// front, invisible and visible alike; the other statements do not matter to a diffuse surface. Throws
/// InputError.
MaterialLibrary loadMtl(const std::filesystem::path& path);

}  // namespace duolux

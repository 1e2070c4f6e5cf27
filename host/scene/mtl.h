#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <unordered_map>
#include <vector>

#include "host/base/error.h"
#include "host/scene/scene.h"
#include "host/scene/tally.h"

namespace duolux {

struct MaterialLibrary {
    std::vector<Material> materials;  ///< names differ
    std::unordered_map<std::string, std::uint32_t> byName;
    std::unordered_map<std::string, std::uint32_t> byPlainName;  ///< see plainName; the first of each
    std::map<std::uint32_t, InputError> unusable;                ///< materials that no face may have, and why
    std::vector<std::string> warnings;
};

/// Reads an MTL file: `Kd` is the diffuse albedo (0.8 where it is absent), `Ke` the radiance emitted from the
/// front, invisible and visible alike. Of the other statements those that would change the picture are named
/// in a warning. Throws InputError.
MaterialLibrary loadMtl(const std::filesystem::path& path, Reading reading = Reading::kLenient);

}  // namespace duolux

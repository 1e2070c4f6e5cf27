#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <unordered_map>
#include <vector>

#include "host/base/error.h"
#include "host/loaders/tally.h"
#include "host/scene/material.h"

namespace duolux {

struct MaterialLibrary {
    std::vector<Material> materials;  ///< with unique names
    std::unordered_map<std::string, std::uint32_t> byName;
    std::unordered_map<std::string, std::uint32_t> byPlainName;  ///< see plainName; the first of each
    std::map<std::uint32_t, InputError> unusable;  ///< materials that no face may use, with the reason
    std::vector<std::string> warnings;
};

/// Reads an MTL file. `Kd` is the diffuse albedo (0.8 if absent), `Ke` the radiance emitted from the front,
/// in both components. Other statements that would affect the image are listed in a warning. Throws
/// InputError.
MaterialLibrary loadMtl(const std::filesystem::path& path, Reading reading = Reading::kLenient);

}  // namespace duolux

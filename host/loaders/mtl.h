#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <unordered_map>
#include <vector>

#include "host/base/error.h"
#include "host/loaders/file_finder.h"
#include "host/loaders/tally.h"
#include "host/scene/material.h"

namespace duolux {

struct MaterialLibrary {
    std::vector<Material> materials;  ///< with unique names; Texture::image is an index into `images`
    std::vector<ImageSource> images;  ///< files that exist
    std::unordered_map<std::string, std::uint32_t> byName;
    std::unordered_map<std::string, std::uint32_t> byPlainName;  ///< see plainName; the first of each
    std::map<std::uint32_t, InputError> unusable;  ///< materials that no face may use, with the reason
    std::vector<std::string> warnings;
};

/// Reads an MTL file; README.md has the table of its statements. Images are searched for by `finder`. What
/// would affect the image and has no effect is listed in warnings. Throws InputError.
MaterialLibrary loadMtl(const std::filesystem::path& path, FileFinder& finder,
                        Reading reading = Reading::kLenient);

}  // namespace duolux

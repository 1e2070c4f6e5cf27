#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "host/loaders/file_finder.h"
#include "host/scene/image_conversion.h"
#include "host/scene/texture.h"

namespace duolux {

/// The images that an MTL file names, and those that its materials use, which may be conversions of them.
class MtlImages {
  public:
    /// `folder`: that of the MTL file.
    MtlImages(std::filesystem::path folder, FileFinder& finder)
        : folder_(std::move(folder)), finder_(finder) {}

    /// The index of the file that a name refers to; empty if there is none.
    std::optional<std::uint32_t> fileOf(std::string_view name);

    /// The index in sources() of a converted file, which is added if it is new.
    std::uint32_t indexOf(std::uint32_t file, const ImageConversion& conversion);

    std::vector<ImageSource>& sources() { return sources_; }

  private:
    std::filesystem::path folder_;
    FileFinder& finder_;
    std::vector<std::filesystem::path> files_;
    std::unordered_map<std::string, std::optional<std::uint32_t>> byName_;
    std::map<std::filesystem::path, std::uint32_t> byPath_;
    std::map<std::pair<std::uint32_t, ImageConversion>, std::uint32_t> indices_;
    std::vector<ImageSource> sources_;
};

}  // namespace duolux

#pragma once

#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "host/loaders/json_node.h"
#include "host/scene/texture.h"

namespace duolux {

/// The path that a value names, with slashes in place of backslashes unless a file of exactly this name
/// exists; relative to the scene file. Throws InputError with this remedy if it is no text or holds a zero
/// byte.
std::filesystem::path readPath(const JsonNode& node, std::string_view remedy);

/// The file of such a path. Throws InputError with this remedy if it is no regular file.
std::filesystem::path requireFile(const JsonNode& node, const std::filesystem::path& path,
                                  std::string_view remedy);

/// A unique name for a file, independent of "." and links in its path.
std::filesystem::path identity(const std::filesystem::path& path);

/// The images of a scene, to which its JSON file adds further ones.
class JsonImages {
  public:
    /// New images are appended to `sources`, their paths also to `files`. Both must outlive the object.
    JsonImages(std::vector<ImageSource>& sources, std::vector<std::filesystem::path>& files);

    /// The index of the image that a value names. Throws InputError if there is no such file.
    std::uint32_t add(const JsonNode& node);

  private:
    std::vector<ImageSource>& sources_;
    std::vector<std::filesystem::path>& files_;
    std::map<std::filesystem::path, std::uint32_t> indices_;  ///< by identity
};

/// Reads {"image": FILE} with texture coordinates, "wrap" and "filter". The object may also have the keys
/// `more`, which the caller reads.
Texture readTexture(const JsonNode& node, ColourSpace colourSpace, JsonImages& images,
                    std::initializer_list<std::string_view> more);

}  // namespace duolux

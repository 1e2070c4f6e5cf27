#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "host/loaders/gltf_buffers.h"
#include "host/loaders/gltf_document.h"
#include "host/scene/material.h"
#include "host/scene/texture.h"

namespace duolux {

/// The images of a glTF file that materials use, still encoded.
class GltfTextures {
  public:
    GltfTextures(const GltfDocument& document, GltfBuffers& buffers, GltfNotes& notes)
        : document_(document), buffers_(buffers), notes_(notes) {}

    /// The texture to which a texture info refers, such as the value of "baseColorTexture". Empty, with a
    /// warning, if it cannot be used. Throws InputError. `conversion`: of the image.
    std::optional<Texture> read(const JsonNode& info, ColourSpace colourSpace,
                                const ImageConversion& conversion = {});

    /// Texture::image is an index into these.
    std::vector<ImageSource>& images() { return images_; }
    /// The files among them that exist.
    const std::vector<std::filesystem::path>& files() const { return files_; }

  private:
    void readSampler(const JsonNode& node, Texture& texture);
    Wrap readWrap(const JsonNode& sampler, const char* key);
    std::uint32_t imageOf(const JsonNode& index, const ImageConversion& conversion);
    ImageSource readImage(const JsonNode& node);

    const GltfDocument& document_;
    GltfBuffers& buffers_;
    GltfNotes& notes_;
    std::vector<ImageSource> images_;
    std::map<std::uint32_t, ImageSource> sources_;  ///< of the file's images
    /// In images_, by the index in the file.
    std::map<std::pair<std::uint32_t, ImageConversion>, std::uint32_t> indices_;
    std::vector<std::filesystem::path> files_;
};

}  // namespace duolux

#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "host/scene/scene.h"
#include "host/vk/device_info.h"
#include "shaders/shared/texture_layout.h"

namespace duolux {

/// An image in the atlas.
struct AtlasImage {
    std::shared_ptr<const Image> image;
    bool srgb = false;           ///< shrunk as sRGB-encoded colours
    std::uint32_t halvings = 0;  ///< sides are divided by 2^halvings and rounded up
    std::uint32_t firstTexel = 0;

    glm::uvec2 size() const;       ///< pixels
    std::uint64_t texels() const;  ///< of the atlas
    bool operator==(const AtlasImage&) const = default;
};

/// The images that the materials of a scene use, in the order of the atlas.
struct AtlasPlan {
    std::vector<AtlasImage> images;
    std::uint64_t texels = 0;
    /// Says how many images were shrunk, and which one was shrunk most; empty if none was.
    std::string warning;

    bool operator==(const AtlasPlan&) const = default;
};

/// The largest atlas, in texels, beside `otherBytes` of device memory.
std::uint64_t largestAtlas(const DeviceInfo& device, std::uint64_t otherBytes);

/// Images that do not fit into `mostTexels` are halved, the largest first, until all fit or are single
/// pixels. Throws DeviceError if even these do not fit.
AtlasPlan planAtlas(const Scene& scene, std::uint64_t mostTexels);

/// Writes the texels of the atlas, plan.texels in number. Images are shrunk by the mean over the area of each
/// pixel, in linear light.
void writeAtlas(const AtlasPlan& plan, std::span<glm::uvec4> texels);

/// The lookups of materials.
struct TextureTable {
    struct Range {
        std::uint32_t first = 0, count = 0;
    };

    std::vector<shared::DeviceTexture> records;
    std::vector<Range> ranges;  ///< per material
    std::uint32_t groups = 0;   ///< bits of the shared::kGroup... of all records
};

/// A record for each group of inputs that a material looks up in one image. Materials without triangles have
/// none.
TextureTable makeTextureTable(const Scene& scene, const AtlasPlan& plan);

}  // namespace duolux

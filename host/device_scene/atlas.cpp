#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <queue>
#include <unordered_map>
#include <utility>

#include "host/base/error.h"
#include "host/base/parallel.h"
#include "host/base/srgb.h"
#include "host/device_scene/textures.h"

namespace duolux {

namespace {

constexpr std::uint64_t kTexelSize = 16;

bool isFloat(const Image& image) {
    return !image.floats.empty();
}

/// A pixel as linear values.
glm::dvec4 linearPixel(const Image& image, bool srgb, std::size_t pixel) {
    glm::dvec4 value;
    for (int c = 0; c < 4; ++c) {
        const std::size_t at = 4 * pixel + static_cast<std::size_t>(c);
        if (isFloat(image)) {
            const auto encoded = static_cast<double>(image.floats[at]);
            value[c] = srgb && c < 3 ? srgbDecode(encoded) : encoded;
        } else {
            value[c] = srgb && c < 3 ? static_cast<double>(fromSrgb8(image.bytes[at]))
                                     : static_cast<double>(image.bytes[at]) / 255.0;
        }
    }
    return value;
}

void storePixel(Image& image, bool srgb, std::size_t pixel, const glm::dvec4& value) {
    for (int c = 0; c < 4; ++c) {
        const std::size_t at = 4 * pixel + static_cast<std::size_t>(c);
        const bool encoded = srgb && c < 3;
        if (isFloat(image)) {
            image.floats[at] = static_cast<float>(encoded ? srgbEncode(value[c]) : value[c]);
        } else {
            image.bytes[at] =
                encoded ? toSrgb8(value[c]) : static_cast<std::uint8_t>(std::lround(255.0 * value[c]));
        }
    }
}

/// The part of each source pixel that pixel `index` of `count` covers, if the image has `source` pixels.
struct Coverage {
    std::uint32_t first;
    std::vector<double> weights;  ///< their sum is 1

    Coverage(std::uint32_t index, std::uint32_t count, std::uint32_t source) {
        const double scale = static_cast<double>(source) / static_cast<double>(count);
        const double begin = index * scale, end = (index + 1) * scale;
        first = static_cast<std::uint32_t>(begin);
        for (std::uint32_t i = first; i < source && static_cast<double>(i) < end; ++i)
            weights.push_back((std::min(end, i + 1.0) - std::max(begin, static_cast<double>(i))) / scale);
    }
};

Image shrunk(const Image& image, bool srgb, glm::uvec2 size) {
    Image out;
    out.width = size.x;
    out.height = size.y;
    const std::size_t values = std::size_t{4} * size.x * size.y;
    isFloat(image) ? out.floats.resize(values) : out.bytes.resize(values);
    std::vector<Coverage> columns;
    for (std::uint32_t x = 0; x < size.x; ++x)
        columns.emplace_back(x, size.x, image.width);
    parallelFor(size.y, 16, [&](std::size_t begin, std::size_t end) {
        for (std::size_t y = begin; y < end; ++y) {
            const Coverage rows(static_cast<std::uint32_t>(y), size.y, image.height);
            for (std::size_t x = 0; x < size.x; ++x) {
                glm::dvec4 sum(0.0);
                for (std::size_t j = 0; j < rows.weights.size(); ++j) {
                    for (std::size_t i = 0; i < columns[x].weights.size(); ++i) {
                        const std::size_t pixel = (rows.first + j) * image.width + columns[x].first + i;
                        sum += rows.weights[j] * columns[x].weights[i] * linearPixel(image, srgb, pixel);
                    }
                }
                storePixel(out, srgb, y * size.x + x, sum);
            }
        }
    });
    return out;
}

void storeFloats(const Image& image, glm::uvec4* out) {
    const std::size_t pixels = std::size_t{image.width} * image.height;
    for (std::size_t i = 0; i < pixels; ++i) {
        for (std::size_t c = 0; c < 4; ++c)
            out[i][static_cast<int>(c)] = std::bit_cast<std::uint32_t>(image.floats[4 * i + c]);
    }
}

/// Blocks of 2 x 2 pixels; those beyond the edge repeat it.
void storeBlocks(const Image& image, glm::uvec4* out) {
    const std::size_t columns = (image.width + 1) / 2, rows = (image.height + 1) / 2;
    parallelFor(rows, 64, [&](std::size_t begin, std::size_t end) {
        for (std::size_t row = begin; row < end; ++row) {
            for (std::size_t column = 0; column < columns; ++column) {
                glm::uvec4 texel;
                for (std::size_t k = 0; k < 4; ++k) {
                    const std::size_t x = std::min<std::size_t>(2 * column + k % 2, image.width - 1);
                    const std::size_t y = std::min<std::size_t>(2 * row + k / 2, image.height - 1);
                    const std::uint8_t* const p = &image.bytes[4 * (y * image.width + x)];
                    texel[static_cast<int>(k)] = p[0] | std::uint32_t{p[1]} << 8 | std::uint32_t{p[2]} << 16 |
                                                 std::uint32_t{p[3]} << 24;
                }
                out[row * columns + column] = texel;
            }
        }
    });
}

std::uint64_t totalTexels(const std::vector<AtlasImage>& images) {
    std::uint64_t sum = 0;
    for (const AtlasImage& image : images)
        sum += image.texels();
    return sum;
}

/// Halves the largest until all fit.
void shrinkToFit(std::vector<AtlasImage>& images, std::uint64_t mostTexels) {
    std::priority_queue<std::pair<std::uint64_t, std::size_t>> largest;
    for (std::size_t i = 0; i < images.size(); ++i)
        largest.emplace(images[i].texels(), i);
    std::uint64_t total = totalTexels(images);
    while (total > mostTexels) {
        const auto [texels, index] = largest.top();
        largest.pop();
        AtlasImage& image = images[index];
        if (image.size() == glm::uvec2(1)) {
            throw DeviceError(
                fmt::format("{} images do not fit into the {} texels that the device leaves for them",
                            images.size(), mostTexels));
        }
        ++image.halvings;
        total -= texels - image.texels();
        largest.emplace(image.texels(), index);
    }
}

std::string describeShrinking(const std::vector<AtlasImage>& images, std::uint64_t mostTexels) {
    std::size_t count = 0;
    const AtlasImage* worst = nullptr;
    for (const AtlasImage& image : images) {
        if (image.halvings == 0) continue;
        ++count;
        if (worst == nullptr || image.halvings > worst->halvings) worst = &image;
    }
    if (worst == nullptr) return {};
    return fmt::format(
        "{} of {} images are made smaller to fit into {} MiB of the device, {} from {} x {} to {} x {} "
        "pixels",
        count, images.size(), mostTexels * kTexelSize >> 20, worst->image->name, worst->image->width,
        worst->image->height, worst->size().x, worst->size().y);
}

}  // namespace

glm::uvec2 AtlasImage::size() const {
    const std::uint64_t divisor = std::uint64_t{1} << halvings;
    const auto divided = [&](std::uint32_t side) {
        return static_cast<std::uint32_t>((side + divisor - 1) / divisor);
    };
    return {divided(image->width), divided(image->height)};
}

std::uint64_t AtlasImage::texels() const {
    const glm::u64vec2 pixels(size());
    return isFloat(*image) ? pixels.x * pixels.y : ((pixels.x + 1) / 2) * ((pixels.y + 1) / 2);
}

std::uint64_t largestAtlas(const DeviceInfo& device, std::uint64_t otherBytes) {
    constexpr std::uint64_t kLargestIndex = 0x7fffffffu;  // of a signed number in kernels
    std::uint64_t most = std::min(device.maxTexelBufferElements, kLargestIndex);
    if (device.kind == DeviceKind::kGpu) {
        // The film and the driver need some memory, too.
        const std::uint64_t usable = device.memoryBytes - device.memoryBytes / 8;
        most = std::min(most, (usable - std::min(usable, otherBytes)) / kTexelSize);
    }
    return most;
}

AtlasPlan planAtlas(const Scene& scene, std::uint64_t mostTexels) {
    AtlasPlan plan;
    std::unordered_map<std::uint32_t, std::size_t> places;
    const std::vector<bool> used = usedMaterials(scene);
    for (std::size_t i = 0; i < used.size(); ++i) {
        if (!used[i]) continue;
        for (const MaterialTexture& entry : scene.materials[i].textures) {
            const auto [place, isNew] = places.try_emplace(entry.texture.image, plan.images.size());
            if (isNew) plan.images.push_back({scene.images[entry.texture.image]});
            AtlasImage& image = plan.images[place->second];
            image.srgb = image.srgb || entry.texture.colourSpace == ColourSpace::kSrgb;
        }
    }
    shrinkToFit(plan.images, mostTexels);
    for (AtlasImage& image : plan.images) {
        image.firstTexel = static_cast<std::uint32_t>(plan.texels);
        plan.texels += image.texels();
    }
    plan.warning = describeShrinking(plan.images, mostTexels);
    return plan;
}

void writeAtlas(const AtlasPlan& plan, std::span<glm::uvec4> texels) {
    for (const AtlasImage& placed : plan.images) {
        Image smaller;
        if (placed.halvings > 0) smaller = shrunk(*placed.image, placed.srgb, placed.size());
        const Image& image = placed.halvings > 0 ? smaller : *placed.image;
        glm::uvec4* const out = texels.data() + placed.firstTexel;
        isFloat(image) ? storeFloats(image, out) : storeBlocks(image, out);
    }
}

}  // namespace duolux

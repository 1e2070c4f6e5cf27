#include "host/loaders/gltf_textures.h"

#include <fmt/format.h>

#include <limits>
#include <memory>
#include <string>
#include <utility>

#include "host/loaders/gltf_uri.h"

namespace duolux {

namespace {

constexpr double kLargestTransform = 1e6;
constexpr std::uint32_t kMostSets = 1000;

void readTransform(const JsonNode& node, Texture& texture) {
    const auto pair = [&](const char* key, glm::vec2& field) {
        const auto value = node.find(key);
        if (!value) return;
        const std::vector<double> numbers =
            readNumbers(*value, 2, -kLargestTransform, kLargestTransform, "expected two numbers");
        field = {static_cast<float>(numbers[0]), static_cast<float>(numbers[1])};
    };
    pair("offset", texture.transform.offset);
    pair("scale", texture.transform.scale);
    if (const auto rotation = node.find("rotation")) {
        const double radians =
            rotation->number(-kLargestTransform, kLargestTransform, "expected an angle in radians");
        texture.transform.rotation = static_cast<float>(glm::degrees(radians));
    }
    if (const auto set = node.find("texCoord")) texture.uvSet = set->integer(0, kMostSets);
}

}  // namespace

std::optional<Texture> GltfTextures::read(const JsonNode& info, ColourSpace colourSpace,
                                          const ImageConversion& conversion) {
    const JsonNode& node =
        document_.element(info.require("index", "expected the index of a texture"), "textures");
    Texture texture;
    texture.colourSpace = colourSpace;
    if (const auto set = info.find("texCoord")) texture.uvSet = set->integer(0, kMostSets);
    if (const auto transform = extensionOf(info, "KHR_texture_transform")) readTransform(*transform, texture);
    if (texture.uvSet > 1) {
        notes_.ignore(info, "a texture with a third set of texture coordinates is not supported", "ignored");
        return std::nullopt;
    }
    const auto image = node.find("source");
    if (!image) {
        notes_.ignore(node, "a texture without an image in a known format", "ignored");
        return std::nullopt;
    }
    texture.image = imageOf(*image, conversion);
    if (const auto sampler = node.find("sampler"))
        readSampler(document_.element(*sampler, "samplers"), texture);
    return texture;
}

void GltfTextures::readSampler(const JsonNode& node, Texture& texture) {
    constexpr std::uint32_t kNearest = 9728;
    texture.wrapU = readWrap(node, "wrapS");
    texture.wrapV = readWrap(node, "wrapT");
    const auto filter = node.find("magFilter");
    if (filter && filter->integer(0, std::numeric_limits<std::uint16_t>::max()) == kNearest)
        texture.filter = Filter::kNearest;
}

Wrap GltfTextures::readWrap(const JsonNode& sampler, const char* key) {
    constexpr std::uint32_t kRepeat = 10497, kClamp = 33071, kMirror = 33648;
    const auto value = sampler.find(key);
    if (!value) return Wrap::kRepeat;
    switch (value->integer(0, std::numeric_limits<std::uint16_t>::max())) {
        case kRepeat:
            return Wrap::kRepeat;
        case kClamp:
            return Wrap::kClamp;
        case kMirror:
            return Wrap::kMirror;
        default:
            notes_.tolerate(*value, "an unknown kind of wrapping", "expected 10497, 33071 or 33648",
                            "the texture repeats");
            return Wrap::kRepeat;
    }
}

std::uint32_t GltfTextures::imageOf(const JsonNode& node, const ImageConversion& conversion) {
    const std::uint32_t index = document_.index(node, "images");
    const auto [entry, isNew] =
        indices_.try_emplace({index, conversion}, static_cast<std::uint32_t>(images_.size()));
    if (!isNew) return entry->second;
    auto source = sources_.find(index);
    if (source == sources_.end())
        source = sources_.emplace(index, readImage(document_.list("images")[index])).first;
    images_.push_back(source->second);
    images_.back().conversion = conversion;
    return entry->second;
}

ImageSource GltfTextures::readImage(const JsonNode& node) {
    ImageSource image;
    image.name = fmt::format("{}: {}", document_.path().string(), node.path());
    const auto uri = node.find("uri");
    if (uri && !isDataUri(uri->text("expected a URI"))) {
        image.path = pathOfUri(*uri);
        image.name = image.path.string();
        std::error_code ec;
        if (std::filesystem::exists(image.path, ec)) files_.push_back(image.path);
        return image;
    }
    const auto view = node.find("bufferView");
    if (!uri && !view) node.fail("has no data", "expected \"uri\" or \"bufferView\"");
    image.bytes = std::make_shared<const std::string>(uri ? decodeDataUri(*uri)
                                                          : std::string(buffers_.view(*view).bytes));
    return image;
}

}  // namespace duolux

#include "host/loaders/json_image.h"

#include <fmt/format.h>

#include <array>
#include <glm/glm.hpp>
#include <system_error>

#include "host/base/printable.h"
#include "host/loaders/file_finder.h"
#include "host/loaders/uv_range.h"

namespace duolux {

namespace fs = std::filesystem;

namespace {

constexpr double kLargestRotation = 1e6;  // degrees

glm::vec2 readPair(const JsonNode& node) {
    const std::string remedy = fmt::format("expected [u, v], at most {:g} in magnitude", kLargestUv);
    const std::vector<JsonNode> numbers = node.elements(remedy, 2);
    return {static_cast<float>(numbers[0].number(-kLargestUv, kLargestUv, remedy)),
            static_cast<float>(numbers[1].number(-kLargestUv, kLargestUv, remedy))};
}

void readWrapOfAxes(const JsonNode& node, Texture& texture) {
    if (!node.isArray()) {
        texture.wrapU = texture.wrapV = node.choice<Wrap>();
        return;
    }
    const std::vector<JsonNode> axes = node.elements("expected one name, or [u, v]", 2);
    texture.wrapU = axes[0].choice<Wrap>();
    texture.wrapV = axes[1].choice<Wrap>();
}

}  // namespace

fs::path readPath(const JsonNode& node, std::string_view remedy) {
    fs::path path = node.text(remedy);
    if (path.native().find('\0') != std::string::npos) node.failValue(remedy);
    std::error_code ec;
    // From another system, as MTL files of OBJ files.
    if (!fs::exists(node.file().parent_path() / path, ec)) path = withSlashes(path.string());
    return path;
}

fs::path requireFile(const JsonNode& node, const fs::path& path, std::string_view remedy) {
    constexpr std::size_t kLongest = 200;
    fs::path file = node.file().parent_path() / path;
    std::error_code ec;
    const fs::file_status status = fs::status(file, ec);
    if (fs::is_regular_file(status)) return file;
    const std::string name = shortened(file.string(), kLongest);
    if (!fs::exists(status)) node.fail(fmt::format("there is no file {}", name), remedy);
    node.fail(fmt::format("{} is a {}", name, fs::is_directory(status) ? "folder" : "pipe or a device"),
              remedy);
}

fs::path identity(const fs::path& path) {
    std::error_code ec;
    fs::path canonical = fs::canonical(path, ec);
    return ec ? path : canonical;
}

JsonImages::JsonImages(std::vector<ImageSource>& sources, std::vector<fs::path>& files)
    : sources_(sources), files_(files) {
    for (std::uint32_t i = 0; i < sources.size(); ++i) {
        const ImageSource& source = sources[i];
        if (!source.path.empty() && source.conversion == ImageConversion())
            indices_.try_emplace(identity(source.path), i);
    }
}

std::uint32_t JsonImages::add(const JsonNode& node) {
    constexpr const char* kRemedy = "expected the path of an image, relative to the scene file";
    const fs::path file = requireFile(node, readPath(node, kRemedy), kRemedy);
    const auto [entry, isNew] =
        indices_.try_emplace(identity(file), static_cast<std::uint32_t>(sources_.size()));
    if (isNew) {
        sources_.push_back({file.string(), file, nullptr});
        files_.push_back(file);
    }
    return entry->second;
}

Texture readTexture(const JsonNode& node, ColourSpace colourSpace, JsonImages& images,
                    std::initializer_list<std::string_view> more) {
    std::vector<std::string_view> keys{"image",       "uv_set", "uv_scale", "uv_offset",
                                       "uv_rotation", "wrap",   "filter"};
    keys.insert(keys.end(), more.begin(), more.end());
    node.expectKeys(keys);
    Texture texture;
    texture.colourSpace = colourSpace;
    texture.image = images.add(node.require("image", "expected the path of an image"));
    if (const auto set = node.find("uv_set")) texture.uvSet = set->integer(0, 1);
    if (const auto scale = node.find("uv_scale")) texture.transform.scale = readPair(*scale);
    if (const auto offset = node.find("uv_offset")) texture.transform.offset = readPair(*offset);
    if (const auto rotation = node.find("uv_rotation")) {
        texture.transform.rotation = static_cast<float>(
            rotation->number(-kLargestRotation, kLargestRotation, "expected an angle in degrees"));
    }
    if (const auto wrap = node.find("wrap")) readWrapOfAxes(*wrap, texture);
    if (const auto filter = node.find("filter")) texture.filter = filter->choice<Filter>();
    return texture;
}

}  // namespace duolux

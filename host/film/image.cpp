#include "host/film/image.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>

#include "host/base/error.h"
#include "host/base/file.h"
#include "host/base/memory.h"
#include "host/base/text.h"
#include "host/film/codec.h"

namespace duolux {

namespace {

/// Deflate compresses at most 1032 bytes into one, and the smallest readable pixels have one bit.
constexpr std::int64_t kMaxPixelsPerByte = 1032 * 8;

struct Format {
    std::string_view extension;
    void (*encode)(const ImageRows&, const ImageOptions&, FileWriter&);
    RadianceImage (*decode)(std::string_view, const std::string&);
};

constexpr Format kFormats[] = {
    {".exr", encodeExr, decodeExr},
    {".png", encodePng, decodePng},
    {".pfm", encodePfm, decodePfm},
};

const Format* formatOf(const std::filesystem::path& path) {
    const std::string extension = lowerCase(path.extension().string());
    const auto* format = std::ranges::find(kFormats, extension, &Format::extension);
    return format != std::end(kFormats) ? format : nullptr;
}

}  // namespace

std::vector<glm::vec3> RadianceImage::displayed(glm::vec2 d) const {
    std::vector<glm::vec3> result(visible.size());
    for (std::size_t i = 0; i < result.size(); ++i)
        result[i] = d.x * invisible[i] + d.y * visible[i];
    return result;
}

RowBand::RowBand(const ImageRows& rows, glm::vec2 display) : rows_(rows), display_(display) {
    for (std::vector<glm::vec3>* pixels : {&invisible_, &visible_, &displayed_})
        pixels->reserve(std::size_t{kRows} * rows.width);
}

std::uint32_t RowBand::read(std::uint32_t firstRow) {
    const std::uint32_t count = std::min(kRows, rows_.height - firstRow);
    for (std::vector<glm::vec3>* pixels : {&invisible_, &visible_, &displayed_})
        pixels->resize(std::size_t{count} * rows_.width);
    rows_.read(firstRow, invisible_, visible_);
    for (std::size_t i = 0; i < displayed_.size(); ++i)
        displayed_[i] = display_.x * invisible_[i] + display_.y * visible_[i];
    return count;
}

RadianceImage makeImage(std::uint32_t width, std::uint32_t height) {
    const std::size_t count = std::size_t{width} * height;
    return {width, height, std::vector<glm::vec3>(count, glm::vec3(0.0f)),
            std::vector<glm::vec3>(count, glm::vec3(0.0f))};
}

void checkImageSize(std::int64_t width, std::int64_t height, std::size_t fileBytes, const std::string& file) {
    if (width < 1 || height < 1 || width > kMaxImageSide || height > kMaxImageSide) {
        throw InputError(file, "", fmt::format("has a size of {} x {} pixels", width, height),
                         fmt::format("expected 1 to {} on each side", kMaxImageSide));
    }
    if (width * height / kMaxPixelsPerByte > static_cast<std::int64_t>(fileBytes)) {
        throw InputError(
            file, "",
            fmt::format("claims {} x {} pixels but is only {} bytes long", width, height, fileBytes),
            "expected a complete image");
    }
}

std::string imageExtensions() {
    std::vector<std::string_view> extensions;
    for (const Format& format : kFormats)
        extensions.push_back(format.extension);
    return alternatives(extensions);
}

bool isImagePath(const std::filesystem::path& path) {
    return formatOf(path) != nullptr;
}

bool isPngPath(const std::filesystem::path& path) {
    const Format* const format = formatOf(path);
    return format != nullptr && format->encode == encodePng;
}

bool isExrPath(const std::filesystem::path& path) {
    const Format* const format = formatOf(path);
    return format != nullptr && format->encode == encodeExr;
}

ImageRows rowsOf(const RadianceImage& image) {
    assert(image.visible.size() == std::size_t{image.width} * image.height);
    assert(image.invisible.size() == image.visible.size());
    const auto read = [&image](std::uint32_t firstRow, std::span<glm::vec3> invisible,
                               std::span<glm::vec3> visible) {
        const std::size_t first = std::size_t{firstRow} * image.width;
        std::ranges::copy(std::span(image.invisible).subspan(first, invisible.size()), invisible.begin());
        std::ranges::copy(std::span(image.visible).subspan(first, visible.size()), visible.begin());
    };
    return {image.width, image.height, read, {}};
}

void writeImage(const std::filesystem::path& path, const RadianceImage& image, const ImageOptions& options) {
    writeImage(path, rowsOf(image), options);
}

void writeImage(const std::filesystem::path& path, const ImageRows& rows, const ImageOptions& options) {
    assert(rows.width > 0 && rows.height > 0);
    const Format* format = formatOf(path);
    if (format == nullptr) {
        throw UsageError(
            fmt::format("{}: unknown image format; expected {}", path.string(), imageExtensions()));
    }
    writeFileAtomically(path, [&](FileWriter& file) { format->encode(rows, options, file); });
}

RadianceImage readImage(const std::filesystem::path& path) {
    const Format* format = formatOf(path);
    if (format == nullptr)
        throw InputError(path.string(), "", "unknown image format", "expected " + imageExtensions());
    return withMemoryToRead(path, [&] { return format->decode(readFile(path), path.string()); });
}

RadianceImage readDisplayedImage(const std::filesystem::path& path) {
    const Format* format = formatOf(path);
    if (format == nullptr || format->decode != decodeExr) return readImage(path);
    return withMemoryToRead(path, [&] { return decodeDisplayedExr(readFile(path), path.string()); });
}

void requireSameSize(const RadianceImage& image, const std::filesystem::path& file,
                     const RadianceImage& first, const std::filesystem::path& firstFile) {
    if (image.width == first.width && image.height == first.height) return;
    throw InputError(
        file.string(), "", fmt::format("is {} x {} pixels", image.width, image.height),
        fmt::format("expected {} x {}, the size of {}", first.width, first.height, firstFile.string()));
}

}  // namespace duolux

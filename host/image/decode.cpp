#include "host/image/decode.h"

#include <png.h>

#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

#include "host/base/error.h"
#include "host/base/file.h"
#include "host/film/codec.h"
#include "host/image/convert.h"
#include "host/image/hdr.h"
#include "host/image/jpeg.h"
#include "host/image/stb_image.h"

namespace duolux {

namespace {

using namespace std::string_view_literals;

/// 8 bits per channel or fewer.
Image decodePng8(const std::string& chunks, const std::string& file) {
    png_image png{};
    png.version = PNG_IMAGE_VERSION;
    const auto fail = [&] {
        const std::string reason = png.message;
        png_image_free(&png);
        throw InputError(file, "", "is not a readable PNG image: " + reason, "");
    };
    if (png_image_begin_read_from_memory(&png, chunks.data(), chunks.size()) == 0) fail();
    Image image;
    image.width = png.width;
    image.height = png.height;
    png.format = PNG_FORMAT_RGBA;
    try {
        image.bytes.resize(std::size_t{4} * png.width * png.height);
    } catch (...) {
        png_image_free(&png);
        throw;
    }
    if (png_image_finish_read(&png, nullptr, image.bytes.data(), 0, nullptr) == 0) fail();
    return image;
}

Image decodePngPixels(std::string_view bytes, const std::string& file) {
    // Without the chunks on colours, libpng leaves the values as they are.
    const std::string chunks = essentialPngChunks(bytes, file, false);
    constexpr std::size_t kDepth = 24;  // the place of the bits per channel in the first chunk
    if (chunks.size() <= kDepth || chunks[kDepth] != 16) return decodePng8(chunks, file);
    const StbPixels pixels = decodePng16(chunks, file);
    Image image;
    image.width = pixels.width;
    image.height = pixels.height;
    for (const std::uint16_t value : pixels.values)
        image.floats.push_back(static_cast<float>(value) / 65535.0f);
    return image;
}

Image imageOf(std::uint32_t width, std::uint32_t height, std::vector<float> floats) {
    Image image;
    image.width = width;
    image.height = height;
    image.floats = std::move(floats);
    return image;
}

std::size_t replaceNonFinite(std::vector<float>& values) {
    std::size_t count = 0;
    for (float& value : values) {
        if (std::isfinite(value)) continue;
        value = 0.0f;
        ++count;
    }
    return count;
}

}  // namespace

DecodedImage decodeImage(const ImageSource& source) {
    const std::string read = source.bytes == nullptr ? readFile(source.path) : std::string();
    const std::string_view bytes = source.bytes == nullptr ? std::string_view(read) : *source.bytes;
    const std::string& file = source.name;
    DecodedImage decoded;
    Image image;
    if (bytes.starts_with("\x89PNG"sv)) {
        image = decodePngPixels(bytes, file);
    } else if (bytes.starts_with("\xff\xd8"sv)) {
        image = decodeJpeg(bytes, file);
    } else if (bytes.starts_with("#?"sv)) {
        RgbaImage pixels = decodeHdr(bytes, file);
        image = imageOf(pixels.width, pixels.height, std::move(pixels.values));
        decoded.linear = true;
    } else if (bytes.starts_with("\x76\x2f\x31\x01"sv)) {
        RgbaImage pixels = decodeRgbaExr(bytes, file);
        image = imageOf(pixels.width, pixels.height, std::move(pixels.values));
        decoded.linear = true;
    } else {
        throw InputError(file, "", bytes.empty() ? "is empty" : "is not an image of a known format",
                         "expected PNG, JPEG, Radiance HDR or OpenEXR");
    }
    image.name = source.name;
    decoded.nonFinite = replaceNonFinite(image.floats);
    convert(image, source.conversion);
    decoded.image = std::make_shared<const Image>(std::move(image));
    return decoded;
}

}  // namespace duolux

#include <png.h>

#include <cmath>
#include <csetjmp>
#include <cstring>
#include <stdexcept>

#include "host/base/error.h"
#include "host/base/parallel.h"
#include "host/film/codec.h"
#include "host/film/srgb.h"

namespace duolux {

namespace {

std::vector<png_byte> toBytes(const RadianceImage& image, const ImageOptions& options) {
    const std::vector<glm::vec3> pixels = image.displayed(options.display);
    const double scale = std::exp2(static_cast<double>(options.exposure));
    std::vector<png_byte> bytes(pixels.size() * 3);
    parallelFor(pixels.size(), 4096, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            for (int c = 0; c < 3; ++c)
                bytes[3 * i + c] = toSrgb8(scale * static_cast<double>(pixels[i][c]));
        }
    });
    return bytes;
}

/// What libpng's callbacks share with encodePng. libpng reports errors by longjmp, so nothing with a
/// destructor may live between setjmp and it: all such things are made before.
struct PngOutput {
    std::string bytes;
    std::string problem;
};

void onWrite(png_structp png, png_bytep data, png_size_t size) {
    auto& output = *static_cast<PngOutput*>(png_get_io_ptr(png));
    bool failed = false;
    try {
        output.bytes.append(reinterpret_cast<const char*>(data), size);
    } catch (const std::exception&) {
        failed = true;
    }
    if (failed) png_error(png, "out of memory");
}

void onFlush(png_structp) {}

void onError(png_structp png, png_const_charp message) {
    static_cast<PngOutput*>(png_get_error_ptr(png))->problem = message;
    png_longjmp(png, 1);
}

void onWarning(png_structp, png_const_charp) {}

std::vector<png_text> toText(const ImageOptions& options) {
    std::vector<png_text> texts;
    for (const auto& [key, value] : options.metadata) {
        png_text text{};
        text.compression = PNG_ITXT_COMPRESSION_NONE;  // iTXt: the value is UTF-8
        text.key = const_cast<png_charp>(key.c_str());
        text.text = const_cast<png_charp>(value.c_str());
        text.itxt_length = value.size();
        texts.push_back(text);
    }
    return texts;
}

/// False if libpng failed.
bool writePng(png_structp png, png_infop info, PngOutput& output, std::uint32_t width, std::uint32_t height,
              const png_byte* pixels, const std::vector<png_text>& texts) {
    if (setjmp(png_jmpbuf(png)) != 0) return false;
    png_set_write_fn(png, &output, onWrite, onFlush);
    png_set_IHDR(png, info, width, height, 8, PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    png_set_sRGB_gAMA_and_cHRM(png, info, PNG_sRGB_INTENT_RELATIVE);
    if (!texts.empty()) png_set_text(png, info, texts.data(), static_cast<int>(texts.size()));
    png_write_info(png, info);
    for (std::uint32_t y = 0; y < height; ++y)
        png_write_row(png, pixels + std::size_t{3} * width * y);
    png_write_end(png, info);
    return true;
}

[[noreturn]] void throwUnreadable(const png_image& png, const std::string& file) {
    throw InputError(file, "", std::string("is not a readable PNG image: ") + png.message, "");
}

}  // namespace

std::string encodePng(const RadianceImage& image, const ImageOptions& options) {
    const std::vector<png_byte> pixels = toBytes(image, options);
    const std::vector<png_text> texts = toText(options);
    PngOutput output;
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &output, onError, onWarning);
    png_infop info = png != nullptr ? png_create_info_struct(png) : nullptr;
    const bool written =
        info != nullptr && writePng(png, info, output, image.width, image.height, pixels.data(), texts);
    png_destroy_write_struct(&png, &info);
    if (!written) throw std::runtime_error(output.problem.empty() ? "libpng cannot start" : output.problem);
    return std::move(output.bytes);
}

RadianceImage decodePng(std::string_view bytes, const std::string& file) {
    png_image png{};
    png.version = PNG_IMAGE_VERSION;
    if (png_image_begin_read_from_memory(&png, bytes.data(), bytes.size()) == 0) throwUnreadable(png, file);
    std::vector<png_byte> pixels;
    try {
        checkImageSize(png.width, png.height, bytes.size(), file);
        pixels.resize(std::size_t{png.width} * png.height * 3);
    } catch (...) {
        png_image_free(&png);
        throw;
    }
    png.format = PNG_FORMAT_RGB;
    const png_color black{0, 0, 0};  // what shows through transparent pixels
    if (png_image_finish_read(&png, &black, pixels.data(), 0, nullptr) == 0) throwUnreadable(png, file);
    RadianceImage image = makeImage(png.width, png.height);
    for (std::size_t i = 0; i < image.visible.size(); ++i) {
        for (int c = 0; c < 3; ++c)
            image.visible[i][c] = fromSrgb8(pixels[3 * i + c]);
    }
    return image;
}

}  // namespace duolux

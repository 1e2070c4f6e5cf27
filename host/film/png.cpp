#include <fmt/format.h>
#include <png.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <csetjmp>
#include <cstring>
#include <exception>
#include <new>
#include <stdexcept>

#include "host/base/error.h"
#include "host/base/parallel.h"
#include "host/base/srgb.h"
#include "host/film/codec.h"

namespace duolux {

namespace {

void toBytes(std::span<const glm::vec3> pixels, double scale, std::vector<png_byte>& bytes) {
    bytes.resize(pixels.size() * 3);
    parallelFor(pixels.size(), 4096, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            for (int c = 0; c < 3; ++c)
                bytes[3 * i + static_cast<std::size_t>(c)] =
                    toSrgb8(scale * static_cast<double>(pixels[i][c]));
        }
    });
}

/// State shared by libpng's callbacks and the writer. libpng reports errors by longjmp, so no object with a
/// destructor may exist between setjmp and longjmp, and no exception may pass through libpng.
struct PngOutput {
    FileWriter& out;
    std::exception_ptr failure{};
};

void onWrite(png_structp png, png_bytep data, png_size_t size) {
    auto& output = *static_cast<PngOutput*>(png_get_io_ptr(png));
    try {
        output.out.write({reinterpret_cast<const char*>(data), size});
        return;
    } catch (...) {
        output.failure = std::current_exception();
    }
    png_longjmp(png, 1);
}

void onFlush(png_structp) {}

void onError(png_structp png, png_const_charp message) {
    auto& output = *static_cast<PngOutput*>(png_get_error_ptr(png));
    try {
        output.failure = std::make_exception_ptr(std::runtime_error(message));
    } catch (...) {
        output.failure = std::current_exception();
    }
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

// Each returns false if libpng failed.

bool writeHeader(png_structp png, png_infop info, PngOutput& output, const ImageRows& rows,
                 const std::vector<png_text>& texts) {
    if (setjmp(png_jmpbuf(png)) != 0) return false;
    png_set_write_fn(png, &output, onWrite, onFlush);
    png_set_IHDR(png, info, rows.width, rows.height, 8, PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    png_set_sRGB_gAMA_and_cHRM(png, info, PNG_sRGB_INTENT_RELATIVE);
    if (!texts.empty()) png_set_text(png, info, texts.data(), static_cast<int>(texts.size()));
    png_write_info(png, info);
    return true;
}

bool writeRows(png_structp png, const png_byte* pixels, std::size_t rowBytes, std::uint32_t count) {
    if (setjmp(png_jmpbuf(png)) != 0) return false;
    for (std::uint32_t y = 0; y < count; ++y)
        png_write_row(png, pixels + rowBytes * y);
    return true;
}

bool writeEnd(png_structp png, png_infop info) {
    if (setjmp(png_jmpbuf(png)) != 0) return false;
    png_write_end(png, info);
    return true;
}

/// Owns libpng's structures.
struct PngWriter {
    explicit PngWriter(PngOutput& output)
        : png(png_create_write_struct(PNG_LIBPNG_VER_STRING, &output, onError, onWarning)),
          info(png != nullptr ? png_create_info_struct(png) : nullptr) {}
    ~PngWriter() { png_destroy_write_struct(&png, &info); }
    PngWriter(const PngWriter&) = delete;
    PngWriter& operator=(const PngWriter&) = delete;

    png_structp png;
    png_infop info;
};

[[noreturn]] void throwUnreadable(const png_image& png, const std::string& file) {
    throw InputError(file, "", std::string("is not a readable PNG image: ") + png.message, "");
}

/// Reads a big-endian number.
std::uint32_t number(std::string_view bytes) {
    std::uint32_t value = 0;
    for (const char byte : bytes.substr(0, 4))
        value = value << 8 | static_cast<unsigned char>(byte);
    return value;
}

}  // namespace

std::string essentialPngChunks(std::string_view bytes, const std::string& file, bool colourSpace) {
    constexpr std::size_t kSignature = 8,
                          kAround = 12;  // length and type before the data of a chunk, CRC after
    constexpr std::array<std::string_view, 10> kEssential{"IHDR", "PLTE", "IDAT", "IEND", "tRNS",
                                                          "gAMA", "cHRM", "sRGB", "sBIT", "iCCP"};
    constexpr std::size_t kPixelChunks = 5;  // the first of them
    const auto essential = std::span(kEssential).first(colourSpace ? kEssential.size() : kPixelChunks);
    constexpr std::string_view kPng("\x89PNG\r\n\x1a\n", kSignature);
    if (!bytes.starts_with(kPng)) {
        throw InputError(file, "", "is not a PNG image despite its name", "expected a PNG image");
    }
    std::string out(kPng);
    std::uint64_t imageBytes = 0;  // compressed
    std::string_view header;
    for (std::size_t at = kSignature; at + kAround <= bytes.size();) {
        const std::string_view type = bytes.substr(at + 4, 4);
        const std::uint64_t length = number(bytes.substr(at));
        const std::size_t left = bytes.size() - at - kAround;
        if (length > left) {
            throw InputError(
                file, "",
                fmt::format(
                    "is not a readable PNG image: a chunk at byte {} claims {} bytes where {} are left", at,
                    length, left),
                "expected a complete file");
        }
        const std::string_view chunk = bytes.substr(at, kAround + static_cast<std::size_t>(length));
        if (std::ranges::find(essential, type) != essential.end()) out += chunk;
        if (type == "IDAT") imageBytes += length;
        if (type == "IHDR" && length >= 13) header = chunk.substr(8);
        if (type == "IEND") break;
        at += chunk.size();
    }
    if (header.empty()) return out;  // libpng reports this
    const std::uint32_t width = number(header), height = number(header.substr(4));
    checkImageSize(width, height, bytes.size(), file);
    // Deflate compresses at most 1032 bytes into one, and every row has one byte for its filter.
    const auto depth = static_cast<unsigned char>(header[8]), colour = static_cast<unsigned char>(header[9]);
    const std::uint64_t channels = colour == 2 ? 3 : colour == 6 ? 4 : colour == 4 ? 2 : 1;
    const std::uint64_t unpacked = (width * channels * depth / 8 + 1) * height;
    if (unpacked / 1032 > imageBytes) {
        throw InputError(
            file, "",
            fmt::format("claims {} x {} pixels but has only {} bytes of them", width, height, imageBytes),
            "expected a complete file");
    }
    return out;
}

void encodePng(const ImageRows& rows, const ImageOptions& options, FileWriter& out) {
    const std::vector<png_text> texts = toText(options);
    const double scale = std::exp2(static_cast<double>(options.exposure));
    PngOutput output{out};
    PngWriter writer(output);
    if (writer.info == nullptr) throw std::bad_alloc();
    const auto require = [&](bool written) {
        if (!written) std::rethrow_exception(output.failure);
    };
    require(writeHeader(writer.png, writer.info, output, rows, texts));
    RowBand band(rows, options.display);
    std::vector<png_byte> bytes;
    for (std::uint32_t y = 0; y < rows.height; y += RowBand::kRows) {
        const std::uint32_t count = band.read(y);
        toBytes(band.displayed(), scale, bytes);
        require(writeRows(writer.png, bytes.data(), std::size_t{3} * rows.width, count));
    }
    require(writeEnd(writer.png, writer.info));
}

RadianceImage decodePng(std::string_view bytes, const std::string& file) {
    png_image png{};
    png.version = PNG_IMAGE_VERSION;
    const std::string chunks = essentialPngChunks(bytes, file, true);
    if (png_image_begin_read_from_memory(&png, chunks.data(), chunks.size()) == 0) throwUnreadable(png, file);
    std::vector<png_byte> pixels;
    try {
        pixels.resize(std::size_t{png.width} * png.height * 3);
    } catch (...) {
        png_image_free(&png);
        throw;
    }
    png.format = PNG_FORMAT_RGB;
    const png_color black{0, 0, 0};  // background of transparent pixels
    if (png_image_finish_read(&png, &black, pixels.data(), 0, nullptr) == 0) throwUnreadable(png, file);
    RadianceImage image = makeImage(png.width, png.height);
    for (std::size_t i = 0; i < image.visible.size(); ++i) {
        for (int c = 0; c < 3; ++c)
            image.visible[i][c] = fromSrgb8(pixels[3 * i + c]);
    }
    return image;
}

}  // namespace duolux

#include "tests/unit/image_files.h"

// clang-format off
#include <cstdio>  // which jpeglib.h needs
#include <jpeglib.h>
// clang-format on

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfOutputFile.h>
#include <png.h>

#include <cstdlib>
#include <stdexcept>

#include "host/base/file.h"
#include "host/cli/temporary_folder.h"

#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STB_IMAGE_WRITE_STATIC
#include <stb/stb_image_write.h>

namespace duolux::test {

std::string pngOf(std::uint32_t width, std::uint32_t height, int depth, int colourType,
                  const std::vector<std::uint16_t>& values) {
    std::string out;
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
    png_infop info = png_create_info_struct(png);
    if (setjmp(png_jmpbuf(png)) != 0) throw std::runtime_error("libpng failed");
    png_set_write_fn(
        png, &out,
        [](png_structp to, png_bytep data, png_size_t size) {
            static_cast<std::string*>(png_get_io_ptr(to))->append(reinterpret_cast<const char*>(data), size);
        },
        nullptr);
    png_set_IHDR(png, info, width, height, depth, colourType, PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    // Decoders must not convert the values because of this.
    png_set_gAMA(png, info, 1.0);
    if (colourType == PNG_COLOR_TYPE_PALETTE) {
        const std::vector<png_color> colours{{10, 20, 30}, {40, 50, 60}, {70, 80, 90}};
        const std::vector<png_byte> alphas{255, 128};
        png_set_PLTE(png, info, colours.data(), static_cast<int>(colours.size()));
        png_set_tRNS(png, info, alphas.data(), static_cast<int>(alphas.size()), nullptr);
    }
    png_write_info(png, info);
    const std::size_t rowValues = values.size() / height;
    for (std::uint32_t y = 0; y < height; ++y) {
        std::vector<png_byte> row;
        for (std::size_t i = 0; i < rowValues; ++i) {
            const std::uint16_t value = values[y * rowValues + i];
            if (depth == 16) row.push_back(static_cast<png_byte>(value >> 8));
            row.push_back(static_cast<png_byte>(value));
        }
        png_write_row(png, row.data());
    }
    png_write_end(png, info);
    png_destroy_write_struct(&png, &info);
    return out;
}

std::string jpegOf(std::uint32_t width, std::uint32_t height, const std::vector<std::uint8_t>& values) {
    std::string out;
    stbi_write_jpg_to_func(
        [](void* to, void* data, int size) {
            static_cast<std::string*>(to)->append(static_cast<const char*>(data),
                                                  static_cast<std::size_t>(size));
        },
        &out, static_cast<int>(width), static_cast<int>(height), 3, values.data(), 100);
    return out;
}

std::string cmykJpegOf(std::uint32_t width, std::uint32_t height, const std::array<std::uint8_t, 4>& inks) {
    jpeg_compress_struct state{};
    jpeg_error_mgr errors{};
    state.err = jpeg_std_error(&errors);
    jpeg_create_compress(&state);
    unsigned char* bytes = nullptr;
    unsigned long size = 0;
    jpeg_mem_dest(&state, &bytes, &size);
    state.image_width = width;
    state.image_height = height;
    state.input_components = 4;
    state.in_color_space = JCS_CMYK;
    jpeg_set_defaults(&state);
    jpeg_set_quality(&state, 100, TRUE);
    jpeg_start_compress(&state, TRUE);
    std::vector<unsigned char> row;
    for (std::uint32_t x = 0; x < width; ++x) {
        for (const std::uint8_t ink : inks)
            row.push_back(static_cast<unsigned char>(255 - ink));
    }
    for (std::uint32_t y = 0; y < height; ++y) {
        JSAMPROW pointer = row.data();
        jpeg_write_scanlines(&state, &pointer, 1);
    }
    jpeg_finish_compress(&state);
    jpeg_destroy_compress(&state);
    std::string out(reinterpret_cast<const char*>(bytes), size);
    std::free(bytes);
    return out;
}

std::string hdrOf(std::uint32_t width, std::uint32_t height, const std::vector<std::uint8_t>& values) {
    std::string out = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y " + std::to_string(height) + " +X " +
                      std::to_string(width) + "\n";
    return out.append(values.begin(), values.end());
}

std::string exrOf(std::uint32_t width, std::uint32_t height, const std::string& channels, bool half,
                  const std::vector<float>& values) {
    const TemporaryFolder folder;
    Imf::Header header(static_cast<int>(width), static_cast<int>(height));
    Imf::FrameBuffer frame;
    std::vector<Imath::half> halves(values.begin(), values.end());
    const std::size_t size = half ? 2 : 4, count = channels.size();
    char* const data = half ? reinterpret_cast<char*>(halves.data())
                            : reinterpret_cast<char*>(const_cast<float*>(values.data()));
    for (std::size_t c = 0; c < count; ++c) {
        const std::string name(1, channels[c]);
        const Imf::PixelType type = half ? Imf::HALF : Imf::FLOAT;
        header.channels().insert(name, Imf::Channel(type));
        frame.insert(name, Imf::Slice(type, data + c * size, count * size, width * count * size));
    }
    const std::string path = (folder / "image.exr").string();
    {
        Imf::OutputFile file(path.c_str(), header);
        file.setFrameBuffer(frame);
        file.writePixels(static_cast<int>(height));
    }
    return readFile(path);
}

}  // namespace duolux::test

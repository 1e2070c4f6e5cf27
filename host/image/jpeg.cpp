#include "host/image/jpeg.h"

// clang-format off
#include <cstdio>  // which jpeglib.h needs
#include <jpeglib.h>
#include <jerror.h>
// clang-format on

#include <fmt/format.h>

#include <csetjmp>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <new>
#include <vector>

#include "host/base/error.h"
#include "host/film/codec.h"

namespace duolux {

namespace {

/// How libjpeg reports errors: by a jump out of its functions.
struct Failure {
    jpeg_error_mgr manager{};
    std::jmp_buf jump{};
    char message[JMSG_LENGTH_MAX] = {};
    int code = 0;
};

Failure& failureOf(j_common_ptr state) {
    return *static_cast<Failure*>(state->client_data);
}

[[noreturn]] void leave(j_common_ptr state) {
    Failure& failure = failureOf(state);
    failure.code = state->err->msg_code;
    state->err->format_message(state, failure.message);
    std::longjmp(failure.jump, 1);
}

/// Missing data is an error; other warnings, such as of a missing end or of bytes between segments, are not.
/// Where the pixels come in several scans, an early end means that some are missing.
void noteMessage(j_common_ptr state, int level) {
    const int code = state->err->msg_code;
    const bool hasScans = reinterpret_cast<j_decompress_ptr>(state)->progressive_mode != FALSE;
    if (level < 0 && (code == JWRN_HIT_MARKER || (code == JWRN_JPEG_EOF && hasScans))) leave(state);
}

struct Decoder {
    jpeg_decompress_struct state{};
    Failure failure;

    Decoder() {
        state.err = jpeg_std_error(&failure.manager);
        state.client_data = &failure;
        failure.manager.error_exit = leave;
        failure.manager.emit_message = noteMessage;
    }
    ~Decoder() { jpeg_destroy_decompress(&state); }
    Decoder(const Decoder&) = delete;
    Decoder& operator=(const Decoder&) = delete;
};

/// These call libjpeg and nothing that owns memory, because errors jump out of them. They return false for an
/// error.
bool readHeader(Decoder& decoder, std::string_view bytes) {
    if (setjmp(decoder.failure.jump) != 0) return false;
    jpeg_create_decompress(&decoder.state);
    jpeg_mem_src(&decoder.state, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size());
    jpeg_read_header(&decoder.state, TRUE);
    return true;
}

bool readPixels(Decoder& decoder, std::uint8_t* pixels) {
    if (setjmp(decoder.failure.jump) != 0) return false;
    jpeg_decompress_struct& state = decoder.state;
    const bool isCmyk = state.jpeg_color_space == JCS_CMYK || state.jpeg_color_space == JCS_YCCK;
    state.out_color_space = isCmyk ? JCS_CMYK : JCS_EXT_RGBA;
    jpeg_start_decompress(&state);
    while (state.output_scanline < state.output_height) {
        JSAMPROW row = pixels + std::size_t{4} * state.output_width * state.output_scanline;
        jpeg_read_scanlines(&state, &row, 1);
    }
    jpeg_finish_decompress(&state);
    return true;
}

[[noreturn]] void fail(const Decoder& decoder, const std::string& file) {
    if (decoder.failure.code == JERR_OUT_OF_MEMORY) throw std::bad_alloc();
    throw InputError(file, "", fmt::format("is not a readable JPEG image: {}", decoder.failure.message), "");
}

/// Adobe's programs store the complement of CMYK, which makes the colours products.
void makeRgb(std::vector<std::uint8_t>& pixels, bool isComplement) {
    for (std::size_t i = 0; i < pixels.size(); i += 4) {
        const auto value = [&](std::size_t channel) {
            return static_cast<unsigned>(isComplement ? pixels[i + channel] : 255 - pixels[i + channel]);
        };
        const unsigned key = value(3);
        for (std::size_t channel = 0; channel < 3; ++channel)
            pixels[i + channel] = static_cast<std::uint8_t>((value(channel) * key + 127) / 255);
        pixels[i + 3] = 255;
    }
}

}  // namespace

Image decodeJpeg(std::string_view bytes, const std::string& file) {
    const auto decoder = std::make_unique<Decoder>();
    if (!readHeader(*decoder, bytes)) fail(*decoder, file);
    const jpeg_decompress_struct& state = decoder->state;
    checkImageSize(state.image_width, state.image_height, bytes.size(), file);
    // A block of 64 pixels takes at least a bit in one scan of a progressive file.
    constexpr std::uint64_t kPixelsPerByte = 512;
    if (std::uint64_t{state.image_width} * state.image_height / kPixelsPerByte > bytes.size()) {
        throw InputError(file, "",
                         fmt::format("claims {} x {} pixels but is only {} bytes long", state.image_width,
                                     state.image_height, bytes.size()),
                         "expected a complete image");
    }
    Image image;
    image.width = state.image_width;
    image.height = state.image_height;
    image.bytes.resize(std::size_t{4} * image.width * image.height);
    if (!readPixels(*decoder, image.bytes.data())) fail(*decoder, file);
    if (state.out_color_space == JCS_CMYK) makeRgb(image.bytes, state.saw_Adobe_marker != FALSE);
    return image;
}

}  // namespace duolux

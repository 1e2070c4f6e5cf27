#include "host/image/stb_image.h"

#include <fmt/format.h>

#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_NO_STDIO
#define STBI_NO_HDR
#define STBI_NO_LINEAR
#define STBI_ONLY_JPEG
#define STBI_ONLY_PNG
#define STBI_MAX_DIMENSIONS 65536
#include <stb/stb_image.h>

#include <limits>
#include <memory>
#include <new>
#include <type_traits>

#include "host/base/error.h"
#include "host/film/codec.h"

namespace duolux {

namespace {

[[noreturn]] void failStb(const std::string& file, const char* kind) {
    const std::string reason = stbi_failure_reason() == nullptr ? "unknown error" : stbi_failure_reason();
    if (reason == "outofmem") throw std::bad_alloc();
    throw InputError(file, "", fmt::format("is not a readable {} image: {}", kind, reason), "");
}

/// `load` is one of stb_image's functions. `pixelsPerByte`: the most that a file can hold.
template <typename Value, typename Load>
StbPixels<Value> decodeStb(std::string_view bytes, const std::string& file, const char* kind,
                           std::int64_t pixelsPerByte, const Load& load) {
    if (bytes.size() > std::numeric_limits<int>::max())
        throw InputError(file, "", "is too large", "expected less than 2 GiB");
    const auto* const data = reinterpret_cast<const stbi_uc*>(bytes.data());
    const int size = static_cast<int>(bytes.size());
    int width = 0, height = 0, channels = 0;
    if (stbi_info_from_memory(data, size, &width, &height, &channels) == 0) failStb(file, kind);
    checkImageSize(width, height, bytes.size(), file);
    if (std::int64_t{width} * height / pixelsPerByte > static_cast<std::int64_t>(bytes.size())) {
        throw InputError(
            file, "",
            fmt::format("claims {} x {} pixels but is only {} bytes long", width, height, bytes.size()),
            "expected a complete image");
    }
    const std::unique_ptr<Value, decltype([](Value* p) { stbi_image_free(p); })> pixels(
        load(data, size, &width, &height, &channels, 4));
    if (pixels == nullptr) failStb(file, kind);
    const std::size_t count =
        std::size_t{4} * static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    return {static_cast<std::uint32_t>(width),
            static_cast<std::uint32_t>(height),
            {pixels.get(), pixels.get() + count}};
}

}  // namespace

StbPixels<std::uint8_t> decodeJpeg(std::string_view bytes, const std::string& file) {
    // A block of 64 pixels takes at least a bit in one scan of a progressive file.
    return decodeStb<std::uint8_t>(bytes, file, "JPEG", 512, stbi_load_from_memory);
}

StbPixels<std::uint16_t> decodePng16(std::string_view bytes, const std::string& file) {
    // Deflate compresses at most 1032 bytes into one.
    return decodeStb<std::uint16_t>(bytes, file, "PNG", 516, stbi_load_16_from_memory);
}

}  // namespace duolux

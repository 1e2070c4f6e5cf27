#include "host/image/stb_image.h"

#include <fmt/format.h>

#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_NO_STDIO
#define STBI_NO_HDR
#define STBI_NO_LINEAR
#define STBI_ONLY_PNG
#define STBI_MAX_DIMENSIONS 65536
#include <stb/stb_image.h>

#include <limits>
#include <memory>
#include <new>

#include "host/base/error.h"
#include "host/film/codec.h"

namespace duolux {

namespace {

[[noreturn]] void fail(const std::string& file) {
    const std::string reason = stbi_failure_reason() == nullptr ? "unknown error" : stbi_failure_reason();
    if (reason == "outofmem") throw std::bad_alloc();
    throw InputError(file, "", fmt::format("is not a readable PNG image: {}", reason), "");
}

}  // namespace

StbPixels decodePng16(std::string_view bytes, const std::string& file) {
    if (bytes.size() > std::numeric_limits<int>::max())
        throw InputError(file, "", "is too large", "expected less than 2 GiB");
    const auto* const data = reinterpret_cast<const stbi_uc*>(bytes.data());
    const int size = static_cast<int>(bytes.size());
    int width = 0, height = 0, channels = 0;
    if (stbi_info_from_memory(data, size, &width, &height, &channels) == 0) fail(file);
    checkImageSize(width, height, bytes.size(), file);
    // Deflate compresses at most 1032 bytes into one.
    constexpr std::int64_t kPixelsPerByte = 516;
    if (std::int64_t{width} * height / kPixelsPerByte > static_cast<std::int64_t>(bytes.size())) {
        throw InputError(
            file, "",
            fmt::format("claims {} x {} pixels but is only {} bytes long", width, height, bytes.size()),
            "expected a complete image");
    }
    const std::unique_ptr<stbi_us, decltype([](stbi_us* p) { stbi_image_free(p); })> pixels(
        stbi_load_16_from_memory(data, size, &width, &height, &channels, 4));
    if (pixels == nullptr) fail(file);
    const std::size_t count =
        std::size_t{4} * static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    return {static_cast<std::uint32_t>(width),
            static_cast<std::uint32_t>(height),
            {pixels.get(), pixels.get() + count}};
}

}  // namespace duolux

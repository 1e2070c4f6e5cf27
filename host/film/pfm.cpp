// PFM, "portable float map" (Paul Debevec): a text header "PF\nWIDTH HEIGHT\nSCALE\n", then floats, the
// bottom row first. A negative scale means little-endian. "Pf" has one channel.
#include <fmt/format.h>

#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <optional>

#include "host/base/error.h"
#include "host/film/codec.h"

namespace duolux {

namespace {

static_assert(std::endian::native == std::endian::little);
static_assert(sizeof(glm::vec3) == 3 * sizeof(float));

struct PfmHeader {
    int channels = 0;
    std::int64_t width = 0, height = 0;
    bool bigEndian = false;
    std::size_t dataOffset = 0;
};

/// The next word of the header. Exactly one white-space byte after it is consumed, as the format requires
/// after the last word.
std::string_view nextWord(std::string_view bytes, std::size_t& offset) {
    constexpr std::string_view kSpace = " \t\r\n";
    const std::size_t begin = bytes.find_first_not_of(kSpace, offset);
    if (begin == std::string_view::npos) return {};
    const std::size_t end = bytes.find_first_of(kSpace, begin);
    if (end == std::string_view::npos) return {};
    offset = end + 1;
    return bytes.substr(begin, end - begin);
}

template <typename T>
std::optional<T> parse(std::string_view word) {
    T value{};
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc{} || end != word.data() + word.size()) return std::nullopt;
    return value;
}

PfmHeader parseHeader(std::string_view bytes, const std::string& file) {
    PfmHeader header;
    const std::string_view magic = nextWord(bytes, header.dataOffset);
    if (magic != "PF" && magic != "Pf")
        throw InputError(file, "", "is not a PFM image", "expected it to begin with PF");
    header.channels = magic == "PF" ? 3 : 1;
    const auto width = parse<std::int64_t>(nextWord(bytes, header.dataOffset));
    const auto height = parse<std::int64_t>(nextWord(bytes, header.dataOffset));
    const auto scale = parse<double>(nextWord(bytes, header.dataOffset));
    if (!width || !height || !scale || !std::isfinite(*scale) || *scale == 0.0) {
        throw InputError(file, "", "has a malformed PFM header",
                         "expected width, height and a scale other than 0");
    }
    header.width = *width;
    header.height = *height;
    header.bigEndian = *scale > 0.0;
    return header;
}

float swapBytes(float value) {
    auto bytes = std::bit_cast<std::array<char, 4>>(value);
    return std::bit_cast<float>(std::array<char, 4>{bytes[3], bytes[2], bytes[1], bytes[0]});
}

}  // namespace

void encodePfm(const ImageRows& rows, const ImageOptions& options, FileWriter& out) {
    out.write(fmt::format("PF\n{} {}\n-1.0\n", rows.width, rows.height));
    RowBand band(rows, options.display);
    const std::uint32_t bands = (rows.height + RowBand::kRows - 1) / RowBand::kRows;
    for (std::uint32_t i = bands; i-- > 0;) {
        for (std::uint32_t y = band.read(i * RowBand::kRows); y-- > 0;) {
            const auto row = band.displayed().subspan(std::size_t{y} * rows.width, rows.width);
            out.write({reinterpret_cast<const char*>(row.data()), row.size_bytes()});
        }
    }
}

RadianceImage decodePfm(std::string_view bytes, const std::string& file) {
    const PfmHeader header = parseHeader(bytes, file);
    checkImageSize(header.width, header.height, bytes.size(), file);
    const auto pixelBytes = static_cast<std::size_t>(header.channels) * sizeof(float);
    const std::size_t needed = static_cast<std::size_t>(header.width * header.height) * pixelBytes;
    if (bytes.size() - header.dataOffset < needed) {
        throw InputError(
            file, "",
            fmt::format("is truncated: {} of {} bytes of pixels", bytes.size() - header.dataOffset, needed),
            "expected a complete image");
    }
    RadianceImage image =
        makeImage(static_cast<std::uint32_t>(header.width), static_cast<std::uint32_t>(header.height));
    const char* source = bytes.data() + header.dataOffset;
    for (std::uint32_t y = image.height; y-- > 0;) {
        for (std::uint32_t x = 0; x < image.width; ++x, source += pixelBytes) {
            float values[3];
            std::memcpy(values, source, pixelBytes);
            if (header.channels == 1) values[1] = values[2] = values[0];
            for (int c = 0; c < 3; ++c) {
                image.visible[std::size_t{y} * image.width + x][c] =
                    header.bigEndian ? swapBytes(values[c]) : values[c];
            }
        }
    }
    return image;
}

}  // namespace duolux

// The layout of OpenEXR files: "OpenEXR File Layout", openexr.com. Numbers are little-endian.
#include "host/film/exr_header.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <limits>

#include "host/base/error.h"
#include "host/film/codec.h"

namespace duolux {

namespace {

constexpr std::uint32_t kMagic = 20000630;
constexpr std::uint32_t kMultiPart = 0x1000;  // of the version field

/// The largest compression ratio: that of deflate, which no other method exceeds except DWA, which first
/// reduces 64 equal pixels to two coefficients.
constexpr std::uint64_t kMaxExpansion = 1032;
constexpr std::uint64_t kMaxDwaExpansion = 32 * kMaxExpansion;

/// OpenEXR allocates whole blocks of lines, even for images with fewer lines. Blocks up to this size are
/// harmless.
constexpr std::uint64_t kFineBlockBytes = std::uint64_t{64} << 20;

/// Lines per block for each compression method: none, RLE, ZIPS, ZIP, PIZ, PXR24, B44, B44A, DWAA, DWAB.
constexpr std::uint32_t kBlockLines[] = {1, 1, 1, 16, 32, 16, 32, 32, 32, 256};
constexpr std::uint8_t kDwaa = 8;

std::uint64_t times(std::uint64_t a, std::uint64_t b) {
    std::uint64_t product = 0;
    return __builtin_mul_overflow(a, b, &product) ? std::numeric_limits<std::uint64_t>::max() : product;
}

/// The header of one part.
struct Part {
    std::int64_t width = 0, height = 0;
    std::uint64_t pixelBytes = 0;
    std::uint8_t compression = 0;
    std::uint32_t tileWidth = 0, tileHeight = 0;  // 0: scan lines instead of tiles
};

/// The size of values of a type; 0 if it is unknown or varies. OpenEXR reads as much, whatever the file
/// claims, and takes what follows for the next attribute.
std::int32_t sizeOf(std::string_view type) {
    struct Size {
        std::string_view type;
        std::int32_t bytes;
    };
    constexpr Size kSizes[] = {{"box2i", 16},
                               {"box2f", 16},
                               {"chromaticities", 32},
                               {"compression", 1},
                               {"deepImageState", 1},
                               {"double", 8},
                               {"envmap", 1},
                               {"float", 4},
                               {"int", 4},
                               {"keycode", 28},
                               {"lineOrder", 1},
                               {"m33f", 36},
                               {"m33d", 72},
                               {"m44f", 64},
                               {"m44d", 128},
                               {"rational", 8},
                               {"tiledesc", 9},
                               {"timecode", 8},
                               {"v2i", 8},
                               {"v2f", 8},
                               {"v2d", 16},
                               {"v3i", 12},
                               {"v3f", 12},
                               {"v3d", 24}};
    for (const Size& size : kSizes) {
        if (size.type == type) return size.bytes;
    }
    return 0;
}

class HeaderReader {
  public:
    HeaderReader(std::string_view bytes, const std::string& file)
        : rest_(bytes), size_(bytes.size()), file_(file) {}

    template <typename T>
    T number() {
        T value{};
        if (rest_.size() < sizeof value) fail("ends within its header");
        std::memcpy(&value, rest_.data(), sizeof value);
        rest_.remove_prefix(sizeof value);
        return value;
    }

    /// Reads text up to a zero byte.
    std::string_view text() {
        const std::size_t length = rest_.find('\0');
        if (length == std::string_view::npos) fail("ends within its header");
        const std::string_view out = rest_.substr(0, length);
        rest_.remove_prefix(length + 1);
        return out;
    }

    /// Reads the attributes of a part; returns false if there is no further part.
    bool part(Part& part) {
        bool any = false;
        for (std::string_view name = text(); !name.empty(); name = text()) {
            any = true;
            const std::string_view type = text();
            const auto bytes = number<std::int32_t>();
            if (bytes < 0 || static_cast<std::size_t>(bytes) > rest_.size()) {
                fail(fmt::format("claims {} bytes for the attribute '{}' where {} are left", bytes, name,
                                 rest_.size()));
            }
            const std::int32_t expected = sizeOf(type);
            if (expected != 0 && bytes != expected) {
                fail(fmt::format("claims {} bytes for the attribute '{}', whose type has {}", bytes, name,
                                 expected));
            }
            HeaderReader value(rest_.substr(0, static_cast<std::size_t>(bytes)), file_);
            rest_.remove_prefix(static_cast<std::size_t>(bytes));
            value.attribute(name, type, part);
        }
        return any;
    }

    void check(const Part& part) const {
        checkImageSize(part.width, part.height, size_, file_);
        const auto width = static_cast<std::uint64_t>(part.width);
        const auto height = static_cast<std::uint64_t>(part.height);
        const bool known = part.compression < std::size(kBlockLines);
        const std::uint64_t lines = known ? kBlockLines[part.compression] : 1;
        const std::uint64_t most = times(size_, part.compression < kDwaa ? kMaxExpansion : kMaxDwaExpansion);
        const std::uint64_t rowBytes = times(width, part.pixelBytes);
        const std::uint64_t tile = times(times(part.tileWidth, part.tileHeight), part.pixelBytes);
        const std::uint64_t block = std::max(tile, times(rowBytes, lines));
        const std::uint64_t blocks = part.tileWidth > 0 && part.tileHeight > 0
                                         ? times((width + part.tileWidth - 1) / part.tileWidth,
                                                 (height + part.tileHeight - 1) / part.tileHeight)
                                         : (height + lines - 1) / lines;
        if (times(rowBytes, height) > most || block > std::max(most, kFineBlockBytes) ||
            times(blocks, sizeof(std::uint64_t)) > size_) {
            fail(fmt::format("claims {} x {} pixels of {} bytes but is only {} bytes long", width, height,
                             part.pixelBytes, size_));
        }
    }

  private:
    [[noreturn]] void fail(const std::string& problem) const {
        throw InputError(file_, "", "is not a readable OpenEXR image: it " + problem,
                         "expected a complete file");
    }

    void attribute(std::string_view name, std::string_view type, Part& part) {
        if (type == "chlist") return channels(name, part);
        if (name == "dataWindow") {
            const auto left = number<std::int32_t>(), top = number<std::int32_t>();
            const auto right = number<std::int32_t>(), bottom = number<std::int32_t>();
            part.width = std::int64_t{right} - left + 1;
            part.height = std::int64_t{bottom} - top + 1;
        } else if (name == "compression") {
            part.compression = number<std::uint8_t>();
        } else if (name == "tiles") {
            part.tileWidth = number<std::uint32_t>();
            part.tileHeight = number<std::uint32_t>();
        }
    }

    void channels(std::string_view name, Part& part) {
        std::uint64_t pixelBytes = 0;
        while (!text().empty()) {
            constexpr std::int32_t kHalf = 1;
            pixelBytes += number<std::int32_t>() == kHalf ? 2 : 4;
            for (int i = 0; i < 3; ++i)  // pLinear, xSampling, ySampling
                number<std::int32_t>();
        }
        if (!rest_.empty())
            fail(fmt::format("has {} bytes after the list of the attribute '{}'", rest_.size(), name));
        if (name == "channels") part.pixelBytes = pixelBytes;
    }

    std::string_view rest_;
    std::size_t size_;
    const std::string& file_;
};

}  // namespace

void checkExrHeader(std::string_view bytes, const std::string& file) {
    HeaderReader reader(bytes, file);
    if (bytes.size() < 8 || reader.number<std::uint32_t>() != kMagic) return;
    const bool several = (reader.number<std::uint32_t>() & kMultiPart) != 0;
    Part part;
    do {
        part = {};
        if (!reader.part(part)) break;
        reader.check(part);
    } while (several);
}

}  // namespace duolux

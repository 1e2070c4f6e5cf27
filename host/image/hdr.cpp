#include "host/image/hdr.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <vector>

#include "host/base/error.h"

namespace duolux {

namespace {

using Rgbe = std::array<std::uint8_t, 4>;

class HdrReader {
  public:
    HdrReader(std::string_view bytes, const std::string& file)
        : rest_(bytes), size_(bytes.size()), file_(file) {}

    RgbaImage read() {
        std::string_view text = line();
        while (!text.empty()) {
            if (text.starts_with("FORMAT=") && text != "FORMAT=32-bit_rle_rgbe")
                fail("is not in RGBE", "expected FORMAT=32-bit_rle_rgbe");
            text = line();
        }
        const auto [width, height] = resolution(line());
        checkImageSize(width, height, size_, file_);
        // Two bytes stand for at most 127 values of one of four channels.
        constexpr std::int64_t kPixelsPerByte = 16;
        if (width * height / kPixelsPerByte > static_cast<std::int64_t>(size_)) {
            fail(fmt::format("claims {} x {} pixels but is only {} bytes long", width, height, size_),
                 "expected a complete image");
        }
        RgbaImage image{static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height), {}};
        image.values.reserve(static_cast<std::size_t>(4 * width * height));
        std::vector<Rgbe> row(static_cast<std::size_t>(width));
        for (std::int64_t y = 0; y < height; ++y) {
            readRow(row);
            for (const Rgbe& pixel : row) {
                // The mantissas are of 8 bits, and the exponent is biased by 128; 0 is black.
                const float unit = pixel[3] == 0 ? 0.0f : std::ldexp(1.0f, int{pixel[3]} - 136);
                for (std::size_t c = 0; c < 3; ++c)
                    image.values.push_back(static_cast<float>(pixel[c]) * unit);
                image.values.push_back(1.0f);
            }
        }
        return image;
    }

  private:
    struct Resolution {
        std::int64_t width, height;
    };

    [[noreturn]] void fail(const std::string& problem, const std::string& remedy) const {
        throw InputError(file_, "", problem, remedy);
    }

    std::string_view line() {
        const std::size_t end = rest_.find('\n');
        if (end == std::string_view::npos)
            fail("ends within its header", "expected a complete Radiance HDR image");
        const std::string_view text = rest_.substr(0, end);
        rest_.remove_prefix(end + 1);
        return text;
    }

    /// "-Y 512 +X 1024": rows from the top, pixels from the left.
    Resolution resolution(std::string_view text) const {
        Resolution size{};
        const auto number = [&](std::string_view before, std::int64_t& value) {
            if (!text.starts_with(before)) return false;
            text.remove_prefix(before.size());
            const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
            text.remove_prefix(static_cast<std::size_t>(end - text.data()));
            return error == std::errc();
        };
        if (!number("-Y ", size.height) || !number(" +X ", size.width))
            fail("has an unknown order of its pixels", "expected a line such as -Y 512 +X 1024");
        return size;
    }

    std::uint8_t byte() {
        if (rest_.empty()) fail("ends within its pixels", "expected a complete Radiance HDR image");
        const auto value = static_cast<std::uint8_t>(rest_.front());
        rest_.remove_prefix(1);
        return value;
    }

    Rgbe pixel() {
        Rgbe value{};
        for (std::uint8_t& component : value)
            component = byte();
        return value;
    }

    void readRow(std::vector<Rgbe>& row) {
        constexpr std::size_t kNarrowest = 8, kWidest = 32767;  // of rows compressed by channel
        const bool fits = row.size() >= kNarrowest && row.size() <= kWidest;
        if (fits && rest_.size() >= 4 && rest_[0] == 2 && rest_[1] == 2 && (rest_[2] & 0x80) == 0) {
            const Rgbe begin = pixel();
            if ((std::size_t{begin[2]} << 8 | begin[3]) != row.size())
                fail("has a row of another width", "expected a valid Radiance HDR image");
            for (std::size_t c = 0; c < 4; ++c)
                readChannel(row, c);
            return;
        }
        readPixels(row);
    }

    /// A channel consists of runs (128 + length, the value) and of literals (their number, the values).
    void readChannel(std::vector<Rgbe>& row, std::size_t channel) {
        for (std::size_t x = 0; x < row.size();) {
            const std::size_t code = byte();
            const bool run = code > 128;
            const std::size_t count = run ? code - 128 : code;
            if (count == 0 || count > row.size() - x)
                fail("has a run beyond the end of a row", "expected a valid Radiance HDR image");
            std::uint8_t value = run ? byte() : std::uint8_t{0};
            for (const std::size_t end = x + count; x < end; ++x) {
                if (!run) value = byte();
                row[x][channel] = value;
            }
        }
    }

    /// A row of pixels. The pixel 1, 1, 1, n repeats the previous one n times; in each such pixel that
    /// follows directly, n counts 256 times as much.
    void readPixels(std::vector<Rgbe>& row) {
        unsigned shift = 0;
        for (std::size_t x = 0; x < row.size();) {
            const Rgbe value = pixel();
            if (value[0] != 1 || value[1] != 1 || value[2] != 1) {
                row[x++] = value;
                shift = 0;
                continue;
            }
            const std::uint64_t count = shift < 32 ? std::uint64_t{value[3]} << shift : row.size() + 1;
            if (x == 0 || count > row.size() - x)
                fail("has a run beyond the end of a row", "expected a valid Radiance HDR image");
            std::fill_n(row.begin() + static_cast<std::ptrdiff_t>(x), count, row[x - 1]);
            x += count;
            shift += 8;
        }
    }

    std::string_view rest_;
    std::size_t size_;
    const std::string& file_;
};

}  // namespace

RgbaImage decodeHdr(std::string_view bytes, const std::string& file) {
    return HdrReader(bytes, file).read();
}

}  // namespace duolux

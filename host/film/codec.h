#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "host/base/file.h"
#include "host/film/image.h"

namespace duolux {

// The image formats as functions between images and the bytes of a file. Encoders hold a few rows at a time
// and throw std::exception on failure; decoders throw InputError naming `file`, whatever the bytes.

void encodeExr(const ImageRows& rows, const ImageOptions& options, FileWriter& out);
void encodePng(const ImageRows& rows, const ImageOptions& options, FileWriter& out);
void encodePfm(const ImageRows& rows, const ImageOptions& options, FileWriter& out);

RadianceImage decodeExr(std::string_view bytes, const std::string& file);
RadianceImage decodeDisplayedExr(std::string_view bytes,
                                 const std::string& file);  ///< R, G, B as the visible component
RadianceImage decodePng(std::string_view bytes, const std::string& file);
RadianceImage decodePfm(std::string_view bytes, const std::string& file);

/// The pixels of an image as four floats each, rows from the top.
struct RgbaImage {
    std::uint32_t width = 0, height = 0;
    std::vector<float> values;
};

/// The channels R, G, B, or Y for all three, and A, or 1. Values may be non-finite.
RgbaImage decodeRgbaExr(std::string_view bytes, const std::string& file);

/// The chunks of a PNG file that its pixels need and, if `colourSpace`, those that describe their colours.
/// libpng allocates as much memory as a chunk's length claims, and inflates text. Therefore lengths are
/// checked against the size of the file, and other chunks are left out. Throws InputError.
std::string essentialPngChunks(std::string_view bytes, const std::string& file, bool colourSpace);

/// Width and height of the largest readable image, in pixels.
inline constexpr int kMaxImageSide = 65536;

/// Throws InputError unless width and height are 1..kMaxImageSide and a compressed file of `fileBytes` can
/// hold so many pixels: a damaged or hostile header must not make the reader allocate more than the file can
/// fill.
void checkImageSize(std::int64_t width, std::int64_t height, std::size_t fileBytes, const std::string& file);

/// A few rows of an image that is being written, with their displayed values.
class RowBand {
  public:
    /// Rows in a band; a block of OpenEXR's ZIP compression has as many.
    static constexpr std::uint32_t kRows = 16;

    RowBand(const ImageRows& rows, glm::vec2 display);

    /// Reads kRows rows (fewer at the end of the image) from `firstRow` on and returns their number.
    std::uint32_t read(std::uint32_t firstRow);

    std::span<const glm::vec3> invisible() const { return invisible_; }
    std::span<const glm::vec3> visible() const { return visible_; }
    std::span<const glm::vec3> displayed() const { return displayed_; }

  private:
    const ImageRows& rows_;
    glm::vec2 display_;
    std::vector<glm::vec3> invisible_, visible_, displayed_;
};

/// A black image.
RadianceImage makeImage(std::uint32_t width, std::uint32_t height);

}  // namespace duolux

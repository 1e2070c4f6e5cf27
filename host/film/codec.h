#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "host/film/image.h"

namespace duolux {

// The image formats as functions between images and the bytes of a file. Encoders throw std::exception on
// failure; decoders throw InputError naming `file`, whatever the bytes.

std::string encodeExr(const RadianceImage& image, const ImageOptions& options);
std::string encodePng(const RadianceImage& image, const ImageOptions& options);
std::string encodePfm(const RadianceImage& image, const ImageOptions& options);

RadianceImage decodeExr(std::string_view bytes, const std::string& file);
RadianceImage decodeDisplayedExr(std::string_view bytes,
                                 const std::string& file);  ///< R, G, B as the visible component
RadianceImage decodePng(std::string_view bytes, const std::string& file);
RadianceImage decodePfm(std::string_view bytes, const std::string& file);

/// Pixels on a side of the largest image that is read.
inline constexpr int kMaxImageSide = 65536;

/// Throws InputError unless 1..kMaxImageSide pixels on each side, and no more in all than a compressed file
/// of `fileBytes` can hold: a damaged or hostile header must not make the reader allocate what the file
/// cannot fill.
void checkImageSize(std::int64_t width, std::int64_t height, std::size_t fileBytes, const std::string& file);

/// A black image.
RadianceImage makeImage(std::uint32_t width, std::uint32_t height);

}  // namespace duolux

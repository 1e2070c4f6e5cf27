#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace duolux::test {

/// The content of a PNG file with this depth and colour type of libpng; `values` are samples in the order of
/// the file.
std::string pngOf(std::uint32_t width, std::uint32_t height, int depth, int colourType,
                  const std::vector<std::uint16_t>& values);

/// That of a JPEG file of the best quality; `values` are RGB.
std::string jpegOf(std::uint32_t width, std::uint32_t height, const std::vector<std::uint8_t>& values);

/// The same whose pixels all are this cyan, magenta, yellow and black, as complements, as Adobe's programs
/// do.
std::string cmykJpegOf(std::uint32_t width, std::uint32_t height, const std::array<std::uint8_t, 4>& inks);

/// That of a Radiance HDR file, not compressed; `values` are RGBE.
std::string hdrOf(std::uint32_t width, std::uint32_t height, const std::vector<std::uint8_t>& values);

/// That of an OpenEXR file with these channels, one letter each; `values` are by pixel. `half`: 16 bits.
std::string exrOf(std::uint32_t width, std::uint32_t height, const std::string& channels, bool half,
                  const std::vector<float>& values);

}  // namespace duolux::test

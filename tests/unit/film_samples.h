#pragma once

#include <filesystem>
#include <string>

#include "host/base/file.h"
#include "host/cli/temporary_folder.h"
#include "host/film/image.h"

namespace duolux::test {

/// An image with values of all magnitudes, signs and exponents in both components; depends only on the size.
RadianceImage variedImage(std::uint32_t width, std::uint32_t height);

/// An image whose visible component is one colour.
RadianceImage plainImage(std::uint32_t width, std::uint32_t height, glm::vec3 colour);

/// True if both hold the same bits (so that NaN equals NaN, and 0 differs from -0).
bool sameBits(const std::vector<glm::vec3>& a, const std::vector<glm::vec3>& b);

/// The bytes of an image in a format (host/film/codec.h).
using Encode = void(const ImageRows&, const ImageOptions&, FileWriter&);
std::string encoded(Encode* encode, const RadianceImage& image, const ImageOptions& options = {});

void writeText(const std::filesystem::path& path, std::string_view bytes);

}  // namespace duolux::test

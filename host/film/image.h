#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <glm/glm.hpp>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace duolux {

/// Vector-valued radiance per pixel, linear, scene-referred; rows from the top.
struct RadianceImage {
    std::uint32_t width = 0, height = 0;
    std::vector<glm::vec3> invisible, visible;  ///< width * height each

    /// d . L (paper, eq. 8).
    std::vector<glm::vec3> displayed(glm::vec2 d) const;
};

/// A further layer of an image: a few floats per pixel, with a letter for each.
struct LayerRows {
    std::string name, channels;
    /// Fills the span with whole rows from `firstRow` on, all channels of one pixel after the other.
    std::function<void(std::uint32_t firstRow, std::span<float> values)> read;
};

/// An image that is computed while it is written, so that it need not be in memory as a whole.
struct ImageRows {
    std::uint32_t width = 0, height = 0;
    /// Fills both spans with whole rows from `firstRow` on; the size of the spans determines their number.
    std::function<void(std::uint32_t firstRow, std::span<glm::vec3> invisible, std::span<glm::vec3> visible)>
        read;
    std::vector<LayerRows> layers = {};  ///< only EXR files hold them
};

/// The rows of an image, which must outlive them.
ImageRows rowsOf(const RadianceImage& image);

struct ImageOptions {
    glm::vec2 display{0.0f, 1.0f};
    float exposure = 0.0f;                                      ///< stops; PNG only
    std::vector<std::pair<std::string, std::string>> metadata;  ///< EXR and PNG text attributes
};

/// The extensions of the formats that can be read and written, for messages: ".exr, .png or .pfm".
std::string imageExtensions();

/// True if writeImage supports the extension (case-insensitive).
bool isImagePath(const std::filesystem::path& path);

/// True if the extension is that of a format that applies the exposure and clamps to [0, 1]: .png.
bool isPngPath(const std::filesystem::path& path);

/// True if the extension is that of the format that holds layers: .exr.
bool isExrPath(const std::filesystem::path& path);

/// Writes by extension, atomically. EXR: float R G B (displayed), invisible.R/G/B, visible.R/G/B, and the
/// layers as NAME.CHANNEL.
/// PNG: 8 bit sRGB after exposure, clamped. PFM: float RGB (displayed). Throws UsageError if the
/// extension is of no format, MachineError if the file cannot be written.
void writeImage(const std::filesystem::path& path, const ImageRows& rows, const ImageOptions& options);
void writeImage(const std::filesystem::path& path, const RadianceImage& image, const ImageOptions& options);

/// Reads an EXR written by writeImage, or a PFM or PNG (then as the visible component; PNG decoded from sRGB
/// to linear). Throws InputError.
RadianceImage readImage(const std::filesystem::path& path);

/// Reads the displayed image of a file as the visible component. For an EXR file these are its channels R G
/// B, whatever row d combined the components.
RadianceImage readDisplayedImage(const std::filesystem::path& path);

/// Throws InputError unless the image that was read from a file has the size of the one from `firstFile`.
void requireSameSize(const RadianceImage& image, const std::filesystem::path& file,
                     const RadianceImage& first, const std::filesystem::path& firstFile);

}  // namespace duolux

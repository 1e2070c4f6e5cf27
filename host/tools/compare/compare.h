#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "host/base/named.h"
#include "host/film/image.h"

namespace duolux {

/// How radiance becomes the displayed image in [0, 1]: always times 2^exposure and clamped.
enum class Transfer : std::uint8_t {
    kSrgb,   ///< sRGB-encoded, as PNG files are
    kLinear  ///< linear, as in the paper's framebuffer
};

const char* nameOf(Transfer transfer);  ///< "srgb", "linear"
template <>
inline constexpr std::array kValuesOf<Transfer>{Transfer::kSrgb, Transfer::kLinear};

struct CompareOptions {
    glm::vec2 display{0.0f, 1.0f};  ///< the row d of eq. 8 for images that hold both components
    float exposure = 0.0f;          ///< stops
    Transfer transfer = Transfer::kSrgb;
    std::vector<bool> mask;  ///< pixels to compare; empty: all
};

/// Differences of an image from a reference. The displayed images are those of CompareOptions; the others are
/// linear and scene-referred, neither clamped nor exposed.
struct Comparison {
    std::uint64_t pixels = 0;  ///< number of compared pixels
    std::uint64_t nonFinite =
        0;  ///< number of these that are not finite in an image; if > 0, all metrics are NaN
    /// eps = sqrt((dr^2 + dg^2 + db^2) / 3) of a pixel of the displayed images (paper, section 3).
    double epsMean = 0.0, epsMax = 0.0;
    double epsAboveOneCode = 0.0;  ///< fraction of pixels with eps > 1/255
    double averageColour = 0.0;    ///< eps of the average colours of the displayed images
    double signedMean = 0.0;       ///< mean over pixels and channels of image - reference
    double rmse = 0.0;             ///< root of the mean of (image - reference)^2
    /// Mean of (image - reference)^2 / (reference^2 + 0.01): Rousselle, Knaus, Zwicker, "Adaptive Sampling
    /// and Reconstruction using Greedy Error Minimization", ACM TOG 30(6), 2011.
    double relativeMse = 0.0;
    double psnr = 0.0;  ///< dB, of the displayed images, peak 1; infinite if they are equal
    double flip = 0.0;  ///< mean LDR-FLIP of the sRGB-encoded displayed images

    /// All metrics with their names in JSON output.
    std::vector<std::pair<std::string_view, double>> metrics() const;
};

/// eps of each pixel, rows from the top.
std::vector<float> epsMap(const RadianceImage& image, const RadianceImage& reference,
                          const CompareOptions& options);

/// Both images must have the same size, and at least one pixel must be compared.
Comparison compare(const RadianceImage& image, const RadianceImage& reference, const CompareOptions& options);

}  // namespace duolux

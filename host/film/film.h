#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "host/film/image.h"

namespace duolux {

/// Accumulates radiance exactly: every sample is rounded once to a multiple of `quantum` (on the device), and
/// sums are 64-bit integers. Integer addition is associative, so the image is the same bits however the work
/// was split.
class Film {
  public:
    /// Sums of one pixel, in quanta.
    struct PixelSum {
        std::int64_t invisible[3];
        std::int64_t visible[3];
    };

    /// `quantum`: radiance of one unit, a power of two > 0.
    Film(std::uint32_t width, std::uint32_t height, float quantum);

    /// From what the accessors of another film returned; `lightSums` may be empty. The sizes must fit.
    Film(std::uint32_t width, std::uint32_t height, float quantum, std::vector<PixelSum> sums,
         std::vector<std::uint32_t> samples, std::vector<PixelSum> lightSums, std::uint64_t lightPaths);

    /// Adds all that a film of the same size and quantum holds.
    void add(const Film& other);

    std::uint32_t width() const { return width_; }
    std::uint32_t height() const { return height_; }
    float quantum() const { return quantum_; }

    /// Adds sums of `samples` samples each to the pixels listed (indices row-major from the top left).
    /// Overflow saturates, and overflowed() tells.
    void add(std::span<const std::uint32_t> pixels, std::span<const PixelSum> sums, std::uint32_t samples);

    /// Adds what light paths brought to the pixels from firstPixel on: sums that are >= 0, or < 0 where they
    /// passed the range of 63 bits. Kept apart from what pixels gather: a pixel's value is the sum over all
    /// light paths, in units of radiance, divided by the number of paths per pixel of the image.
    void addLight(std::uint32_t firstPixel, std::span<const PixelSum> sums);

    /// Counts light paths whose light has been added, or that brought none.
    void countLightPaths(std::uint64_t paths) { lightPaths_ += paths; }

    bool overflowed() const { return overflowed_; }
    std::uint64_t totalSamples() const;
    std::uint32_t samplesOf(std::uint32_t pixel) const { return samples_[pixel]; }
    std::span<const std::uint32_t> samples() const { return samples_; }
    std::span<const PixelSum> sums() const { return sums_; }
    std::uint64_t lightPaths() const { return lightPaths_; }
    std::span<const PixelSum> lightSums() const { return lightSums_; }  ///< empty if there is no light

    /// Mean radiance per pixel: what it gathered and what light paths brought; black where there is neither.
    /// The film must outlive the rows.
    ImageRows rows() const;

    /// All rows as an image.
    RadianceImage resolve() const;

  private:
    void readRows(std::uint32_t firstRow, std::span<glm::vec3> invisible, std::span<glm::vec3> visible) const;

    std::uint32_t width_, height_;
    float quantum_;
    bool overflowed_ = false;
    std::vector<PixelSum> sums_;
    std::vector<std::uint32_t> samples_;
    std::vector<PixelSum> lightSums_;
    std::uint64_t lightPaths_ = 0;
};

}  // namespace duolux

#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <map>
#include <span>
#include <vector>

#include "host/film/image.h"

namespace duolux {

/// Accumulates radiance exactly: every sample is rounded once to a multiple of `quantum` (on the device), and
/// sums are integers. Integer addition is associative, so the image is the same bits however the work was
/// split.
class Film {
  public:
    /// Sums of one pixel, in quanta: the low 64 bits of them, two's complement.
    struct PixelSum {
        std::int64_t invisible[3];
        std::int64_t visible[3];
    };
    /// The multiples of 2^64 of those few sums that need more, by the number of the sum: 6 pixel + channel
    /// (3 more for the visible component), those of light paths after all others.
    using Carries = std::map<std::uint64_t, std::int64_t>;

    /// `quantum`: radiance of one unit, a power of two > 0.
    Film(std::uint32_t width, std::uint32_t height, float quantum);

    /// From what the accessors of another film returned; `lightSums` may be empty. The sizes must fit.
    Film(std::uint32_t width, std::uint32_t height, float quantum, std::vector<PixelSum> sums,
         std::vector<std::uint32_t> samples, std::vector<PixelSum> lightSums, std::uint64_t lightPaths,
         Carries carries);

    /// Before anything is added.
    void setQuantum(float quantum);

    /// Adds all that a film of the same size holds. If the quanta differ, the smaller one is kept.
    void add(const Film& other);

    std::uint32_t width() const { return width_; }
    std::uint32_t height() const { return height_; }
    float quantum() const { return quantum_; }

    /// Adds sums of `samples` samples each to the pixels listed (indices row-major from the top left).
    void add(std::span<const std::uint32_t> pixels, std::span<const PixelSum> sums, std::uint32_t samples);

    /// Adds what light paths brought to the pixels from firstPixel on: sums that are >= 0, or < 0 where they
    /// passed the range of 63 bits; those count as the largest, and overflowed() tells. Kept apart from what
    /// pixels gather: a pixel's value is the sum over all light paths, in units of radiance, divided by the
    /// number of paths per pixel of the image.
    void addLight(std::uint32_t firstPixel, std::span<const PixelSum> sums);

    /// Counts light paths whose light has been added, or that brought none.
    void countLightPaths(std::uint64_t paths) { lightPaths_ += paths; }

    /// The largest mean radiance of a pixel; resolve() clamps what is brighter. The same for gathered samples
    /// and light paths, however many there are.
    double largestRadiance() const;
    /// Some pixel is brighter than that, or may have been.
    bool overflowed() const;
    std::uint64_t totalSamples() const;
    std::uint32_t samplesOf(std::uint32_t pixel) const { return samples_[pixel]; }
    std::span<const std::uint32_t> samples() const { return samples_; }
    std::span<const PixelSum> sums() const { return sums_; }
    std::uint64_t lightPaths() const { return lightPaths_; }
    std::span<const PixelSum> lightSums() const { return lightSums_; }  ///< empty if there is no light
    const Carries& carries() const { return carries_; }

    /// Mean radiance per pixel: what it gathered and what light paths brought; black where there is neither.
    /// The film must outlive the rows.
    ImageRows rows() const;

    /// All rows as an image.
    RadianceImage resolve() const;

  private:
    void readRows(std::uint32_t firstRow, std::span<glm::vec3> invisible, std::span<glm::vec3> visible) const;
    void addTo(PixelSum& total, const PixelSum& term, std::uint64_t firstSum);
    void carry(std::uint64_t sum, std::int64_t count);
    /// Multiplies all sums by 2^shift and divides the quantum by it.
    void refine(int shift);
    std::uint64_t firstLightSum() const { return 6 * std::uint64_t{width_} * height_; }
    /// Of one component of a pixel, before it is clamped; `component`: 0 invisible, 1 visible.
    glm::dvec3 meanOf(std::size_t pixel, int component) const;

    std::uint32_t width_, height_;
    float quantum_;
    bool overflowed_ = false;
    std::vector<PixelSum> sums_;
    std::vector<std::uint32_t> samples_;
    std::vector<PixelSum> lightSums_;
    std::uint64_t lightPaths_ = 0;
    Carries carries_;
};

}  // namespace duolux

#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <map>
#include <span>
#include <vector>

#include "host/base/zeroed_memory.h"
#include "host/film/image.h"
#include "host/film/layers.h"

namespace duolux {

/// Accumulates radiance exactly: every sample is rounded once to a multiple of `quantum` (on the device), and
/// sums are integers. Integer addition is associative, so the image is bitwise identical however the work is
/// split. The optional layers are accumulated in the same way, each in its own quantum.
class Film {
  public:
    /// Sums of one pixel in quanta: their low 64 bits, two's complement.
    struct PixelSum {
        std::int64_t invisible[3];
        std::int64_t visible[3];
    };
    using Sums = ZeroedVector<PixelSum>;
    using Samples = ZeroedVector<std::uint32_t>;
    using LayerSums = ZeroedVector<std::int64_t>;
    /// The multiples of 2^64 of the few sums that exceed 64 bits, by the index of the sum: 6 pixel + channel
    /// (+ 3 for the visible component). The sums of light paths follow all others.
    using Carries = std::map<std::uint64_t, std::int64_t>;

    /// `quantum`: the radiance of one unit, a power of two > 0.
    Film(std::uint32_t width, std::uint32_t height, float quantum, FilmLayerSet layers = 0);

    /// Creates a film from the values of another film's accessors; `lightPathSums` may be empty. The sizes
    /// must match.
    Film(std::uint32_t width, std::uint32_t height, float quantum, Sums sums, Samples samples,
         Sums lightPathSums, std::uint64_t lightPaths, Carries carries, FilmLayerSet layers = 0,
         LayerSums layerSums = {});

    /// Must be called before anything is added.
    void setQuantum(float quantum);

    /// Adds all sums of a film of the same size with the same layers. If the quanta differ, the smaller one
    /// is kept.
    void add(const Film& other);

    std::uint32_t width() const { return width_; }
    std::uint32_t height() const { return height_; }
    float quantum() const { return quantum_; }

    /// Adds sums of `samples` samples each to the pixels listed (indices row-major from the top left).
    /// `layerSums`: as layerSums(), of these pixels.
    void add(std::span<const std::uint32_t> pixels, std::span<const PixelSum> sums, std::uint32_t samples,
             std::span<const std::int64_t> layerSums = {});

    /// Adds the contributions of light paths to the pixels from firstPixel on. The sums are >= 0; a sum < 0
    /// has exceeded 63 bits, counts as the largest value, and sets overflowed(). These sums are kept
    /// separately from those of the path tracer: the value of a pixel is its sum over all light paths, in
    /// units of radiance, divided by the number of light paths per pixel of the image.
    void addLightPathSums(std::uint32_t firstPixel, std::span<const PixelSum> sums);

    /// Counts light paths whose contributions have been added, including those without any.
    void countLightPaths(std::uint64_t paths) { lightPaths_ += paths; }

    /// The largest mean radiance of a pixel; resolve() clamps larger values. It does not depend on the
    /// integrator or on the number of samples.
    double largestRadiance() const;
    /// Whether some pixel exceeds, or may have exceeded, largestRadiance().
    bool overflowed() const;
    std::uint64_t totalSamples() const;
    std::uint32_t samplesOf(std::uint32_t pixel) const { return samples_[pixel]; }
    std::span<const std::uint32_t> samples() const { return samples_; }
    std::span<const PixelSum> sums() const { return sums_; }
    std::uint64_t lightPaths() const { return lightPaths_; }
    std::span<const PixelSum> lightPathSums() const { return lightPathSums_; }  ///< empty without light paths
    const Carries& carries() const { return carries_; }
    FilmLayerSet layers() const { return layers_; }
    /// Sums over the samples of each pixel in the quanta of the layers: all channels of one layer after the
    /// other, channelsOf(layers()) numbers per pixel.
    std::span<const std::int64_t> layerSums() const { return layerSums_; }

    /// Mean radiance per pixel, from samples and from light paths; black where there are neither.
    /// The film must outlive the rows.
    ImageRows rows() const;

    /// rows() as an image.
    RadianceImage resolve() const;

    /// The means of one of the layers, all channels of one pixel after the other; 0 without samples.
    std::vector<float> resolve(FilmLayerSet layer) const;

  private:
    void readRows(std::uint32_t firstRow, std::span<glm::vec3> invisible, std::span<glm::vec3> visible) const;
    void readLayer(const FilmLayer& layer, std::uint32_t firstRow, std::span<float> values) const;
    void addTo(PixelSum& total, const PixelSum& term, std::uint64_t firstSum);
    void carry(std::uint64_t sum, std::int64_t count);
    /// Multiplies all sums by 2^shift and divides the quantum by 2^shift.
    void refine(int shift);
    std::uint64_t firstLightPathSum() const { return 6 * std::uint64_t{width_} * height_; }
    /// The mean of one component of a pixel before clamping; `component`: 0 invisible, 1 visible.
    glm::dvec3 meanOf(std::size_t pixel, int component) const;

    std::uint32_t width_, height_;
    float quantum_;
    bool overflowed_ = false;
    Sums sums_;
    Samples samples_;
    Sums lightPathSums_;
    std::uint64_t lightPaths_ = 0;
    Carries carries_;
    FilmLayerSet layers_;
    LayerSums layerSums_;
};

}  // namespace duolux

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

    /// What a film consists of, as its accessors return it.
    struct Contents {
        std::uint32_t width = 0, height = 0;
        float quantum = 1.0f;
        Sums sums;                ///< of each pixel
        Samples samples;          ///< of each pixel
        Sums lightPathSums = {};  ///< of each pixel, or empty
        std::uint64_t lightPaths = 0;
        Carries carries = {};
        FilmLayerSet layers = 0;
        LayerSums layerSums = {};
    };

    /// A black film. `quantum`: the radiance of one unit, in W sr^-1 m^-2 (scene units), a power of two > 0.
    Film(std::uint32_t width, std::uint32_t height, float quantum, FilmLayerSet layers = 0);

    /// A film with these contents, whose sizes must fit the width, the height and the layers.
    explicit Film(Contents contents);

    /// Must be called before anything is added.
    void setQuantum(float quantum);

    /// Adds all sums of a film of the same size with the same layers. If the quanta differ, the smaller one
    /// is kept.
    void add(const Film& other);

    std::uint32_t width() const { return width_; }
    std::uint32_t height() const { return height_; }
    float quantum() const { return quantum_; }

    /// Adds sums of `samples` samples each to the pixels listed (indices row-major from the top left).
    /// `sums`: one for each; `layerSums`: as layerSums(), of these pixels.
    void add(std::span<const std::uint32_t> pixels, std::span<const PixelSum> sums, std::uint32_t samples,
             std::span<const std::int64_t> layerSums = {});

    /// Adds the contributions of light paths to the pixels from firstPixel on. The sums are >= 0; a sum < 0
    /// has exceeded 63 bits, counts as the largest value, and sets overflowed(). These sums are kept
    /// separately from those of the path tracer: the value of a pixel is its sum over all light paths, in
    /// units of radiance, divided by the number of light paths per pixel of the image.
    void addLightPathSums(std::uint32_t firstPixel, std::span<const PixelSum> sums);

    /// Counts light paths whose contributions have been added, including those without any.
    void countLightPaths(std::uint64_t paths) { lightPaths_ += paths; }

    /// The largest mean radiance of a pixel, in W sr^-1 m^-2; resolve() clamps larger values. It does not
    /// depend on the integrator or on the number of samples.
    double largestRadiance() const;
    /// Whether some pixel exceeds, or may have exceeded, largestRadiance().
    bool overflowed() const;
    /// The number of samples of all pixels together; light paths are not among them.
    std::uint64_t totalSamples() const;
    /// The number of samples of a pixel (row-major index).
    std::uint32_t samplesOf(std::uint32_t pixel) const { return samples_[pixel]; }
    /// One number or sum for each pixel, row-major from the top left. Those of light paths are kept
    /// separately and are empty without light paths.
    std::span<const std::uint32_t> samples() const { return samples_; }
    std::span<const PixelSum> sums() const { return sums_; }
    std::span<const PixelSum> lightPathSums() const { return lightPathSums_; }
    std::uint64_t lightPaths() const { return lightPaths_; }
    const Carries& carries() const { return carries_; }
    FilmLayerSet layers() const { return layers_; }
    /// Sums over the samples of each pixel in the quanta of the layers: all channels of one layer after the
    /// other, channelsOf(layers()) numbers per pixel.
    std::span<const std::int64_t> layerSums() const { return layerSums_; }

    /// Mean radiance per pixel in W sr^-1 m^-2, from samples and from light paths; black where there are
    /// neither. The film must outlive the rows.
    ImageRows rows() const;

    /// rows() as an image.
    RadianceImage resolve() const;

    /// The means of one of the layers: for each pixel, row-major, all channels of the layer one after the
    /// other; 0 without samples. Throws UsageError unless `layer` is exactly one of layers().
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

#include "host/film/film.h"

#include <cassert>
#include <limits>
#include <utility>

#include "host/base/parallel.h"

namespace duolux {

namespace {

std::int64_t saturatingAdd(std::int64_t a, std::int64_t b, bool& overflowed) {
    std::int64_t sum = 0;
    if (!__builtin_add_overflow(a, b, &sum)) return sum;
    overflowed = true;
    return b > 0 ? std::numeric_limits<std::int64_t>::max() : std::numeric_limits<std::int64_t>::min();
}

void addTo(Film::PixelSum& total, const Film::PixelSum& term, bool& overflowed) {
    for (int c = 0; c < 3; ++c) {
        total.invisible[c] = saturatingAdd(total.invisible[c], term.invisible[c], overflowed);
        total.visible[c] = saturatingAdd(total.visible[c], term.visible[c], overflowed);
    }
}

}  // namespace

Film::Film(std::uint32_t width, std::uint32_t height, float quantum)
    : width_(width),
      height_(height),
      quantum_(quantum),
      sums_(std::size_t{width} * height, PixelSum{}),
      samples_(std::size_t{width} * height, 0) {}

Film::Film(std::uint32_t width, std::uint32_t height, float quantum, std::vector<PixelSum> sums,
           std::vector<std::uint32_t> samples, std::vector<PixelSum> lightSums, std::uint64_t lightPaths)
    : width_(width),
      height_(height),
      quantum_(quantum),
      sums_(std::move(sums)),
      samples_(std::move(samples)),
      lightSums_(std::move(lightSums)),
      lightPaths_(lightPaths) {
    assert(sums_.size() == std::size_t{width} * height && samples_.size() == sums_.size());
    assert(lightSums_.empty() || lightSums_.size() == sums_.size());
}

void Film::add(const Film& other) {
    assert(other.sums_.size() == sums_.size() && other.quantum_ == quantum_);
    for (std::size_t i = 0; i < sums_.size(); ++i) {
        addTo(sums_[i], other.sums_[i], overflowed_);
        samples_[i] += other.samples_[i];
    }
    addLight(0, other.lightSums_);
    countLightPaths(other.lightPaths_);
    overflowed_ = overflowed_ || other.overflowed_;
}

void Film::add(std::span<const std::uint32_t> pixels, std::span<const PixelSum> sums, std::uint32_t samples) {
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        addTo(sums_[pixels[i]], sums[i], overflowed_);
        samples_[pixels[i]] += samples;
    }
}

void Film::addLight(std::uint32_t firstPixel, std::span<const PixelSum> sums) {
    if (sums.empty()) return;
    lightSums_.resize(sums_.size(), PixelSum{});
    for (std::size_t i = 0; i < sums.size(); ++i) {
        PixelSum sum = sums[i];
        for (int c = 0; c < 3; ++c) {
            for (std::int64_t* value : {&sum.invisible[c], &sum.visible[c]}) {
                if (*value >= 0) continue;
                *value = std::numeric_limits<std::int64_t>::max();
                overflowed_ = true;
            }
        }
        addTo(lightSums_[firstPixel + i], sum, overflowed_);
    }
}

std::uint64_t Film::totalSamples() const {
    std::uint64_t total = 0;
    for (std::uint32_t samples : samples_)
        total += samples;
    return total;
}

ImageRows Film::rows() const {
    return {width_, height_,
            [this](std::uint32_t firstRow, std::span<glm::vec3> invisible, std::span<glm::vec3> visible) {
                readRows(firstRow, invisible, visible);
            }};
}

void Film::readRows(std::uint32_t firstRow, std::span<glm::vec3> invisible,
                    std::span<glm::vec3> visible) const {
    const auto quantum = static_cast<double>(quantum_);
    const double pixels = static_cast<double>(sums_.size());
    const double lightScale = lightPaths_ > 0 ? quantum * pixels / static_cast<double>(lightPaths_) : 0.0;
    const std::size_t first = std::size_t{firstRow} * width_;
    parallelFor(visible.size(), 4096, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const PixelSum& sum = sums_[first + i];
            const double scale = samples_[first + i] > 0 ? quantum / samples_[first + i] : 0.0;
            const PixelSum light = lightSums_.empty() ? PixelSum{} : lightSums_[first + i];
            const auto value = [&](std::int64_t gathered, std::int64_t shot) {
                return static_cast<float>(static_cast<double>(gathered) * scale +
                                          static_cast<double>(shot) * lightScale);
            };
            for (int c = 0; c < 3; ++c) {
                invisible[i][c] = value(sum.invisible[c], light.invisible[c]);
                visible[i][c] = value(sum.visible[c], light.visible[c]);
            }
        }
    });
}

RadianceImage Film::resolve() const {
    RadianceImage image{width_, height_, std::vector<glm::vec3>(sums_.size()),
                        std::vector<glm::vec3>(sums_.size())};
    readRows(0, image.invisible, image.visible);
    return image;
}

}  // namespace duolux

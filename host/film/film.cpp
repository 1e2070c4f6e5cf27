#include "host/film/film.h"

#include <limits>

namespace duolux {

namespace {

std::int64_t saturatingAdd(std::int64_t a, std::int64_t b, bool& overflowed) {
    std::int64_t sum = 0;
    if (!__builtin_add_overflow(a, b, &sum)) return sum;
    overflowed = true;
    return b > 0 ? std::numeric_limits<std::int64_t>::max() : std::numeric_limits<std::int64_t>::min();
}

}  // namespace

Film::Film(std::uint32_t width, std::uint32_t height, float quantum)
    : width_(width),
      height_(height),
      quantum_(quantum),
      sums_(std::size_t{width} * height, PixelSum{}),
      samples_(std::size_t{width} * height, 0) {}

void Film::add(std::span<const std::uint32_t> pixels, std::span<const PixelSum> sums, std::uint32_t samples) {
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        PixelSum& total = sums_[pixels[i]];
        for (int c = 0; c < 3; ++c) {
            total.invisible[c] = saturatingAdd(total.invisible[c], sums[i].invisible[c], overflowed_);
            total.visible[c] = saturatingAdd(total.visible[c], sums[i].visible[c], overflowed_);
        }
        samples_[pixels[i]] += samples;
    }
}

std::uint64_t Film::totalSamples() const {
    std::uint64_t total = 0;
    for (std::uint32_t samples : samples_)
        total += samples;
    return total;
}

RadianceImage Film::resolve() const {
    RadianceImage image{width_, height_, {}, {}};
    image.invisible.resize(sums_.size());
    image.visible.resize(sums_.size());
    for (std::size_t i = 0; i < sums_.size(); ++i) {
        const double scale = samples_[i] > 0 ? static_cast<double>(quantum_) / samples_[i] : 0.0;
        for (int c = 0; c < 3; ++c) {
            image.invisible[i][c] = static_cast<float>(static_cast<double>(sums_[i].invisible[c]) * scale);
            image.visible[i][c] = static_cast<float>(static_cast<double>(sums_[i].visible[c]) * scale);
        }
    }
    return image;
}

}  // namespace duolux

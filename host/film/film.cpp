#include "host/film/film.h"

#include <fmt/format.h>

#include <bit>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

#include "host/base/error.h"
#include "host/base/parallel.h"
#include "shaders/shared/path_tracer_layout.h"

namespace duolux {

Film::Film(std::uint32_t width, std::uint32_t height, float quantum, FilmLayerSet layers)
    : width_(width),
      height_(height),
      quantum_(quantum),
      sums_(std::size_t{width} * height),
      samples_(sums_.size()),
      layers_(layers),
      layerSums_(sums_.size() * channelsOf(layers)) {}

Film::Film(Contents contents)
    : width_(contents.width),
      height_(contents.height),
      quantum_(contents.quantum),
      sums_(std::move(contents.sums)),
      samples_(std::move(contents.samples)),
      lightPathSums_(std::move(contents.lightPathSums)),
      lightPaths_(contents.lightPaths),
      carries_(std::move(contents.carries)),
      layers_(contents.layers),
      layerSums_(std::move(contents.layerSums)) {
    assert(sums_.size() == std::size_t{width_} * height_ && samples_.size() == sums_.size());
    assert(lightPathSums_.empty() || lightPathSums_.size() == sums_.size());
    assert(layerSums_.size() == sums_.size() * channelsOf(layers_));
}

void Film::setQuantum(float quantum) {
    assert(totalSamples() == 0 && lightPaths_ == 0);
    quantum_ = quantum;
}

void Film::carry(std::uint64_t sum, std::int64_t count) {
    if (count == 0) return;
    const auto entry = carries_.try_emplace(sum, 0).first;
    entry->second += count;
    if (entry->second == 0) carries_.erase(entry);
}

void Film::addTo(PixelSum& total, const PixelSum& term, std::uint64_t firstSum) {
    const auto addOne = [&](std::int64_t& a, std::int64_t b, std::uint64_t sum) {
        if (__builtin_add_overflow(a, b, &a)) carry(sum, b > 0 ? 1 : -1);
    };
    for (unsigned c = 0; c < 3; ++c) {
        addOne(total.invisible[c], term.invisible[c], firstSum + c);
        addOne(total.visible[c], term.visible[c], firstSum + 3 + c);
    }
}

void Film::refine(int shift) {
    assert(shift >= 0 && shift < 63);
    quantum_ = std::ldexp(quantum_, -shift);
    Carries before;
    before.swap(carries_);
    __extension__ using Int128 = __int128;
    const auto shiftOne = [&](std::int64_t& value, std::uint64_t sum) {
        const auto found = before.find(sum);
        const Int128 high = found == before.end() ? 0 : found->second;
        const Int128 wide = Int128{value} << shift;
        value = static_cast<std::int64_t>(wide);
        carry(sum,
              static_cast<std::int64_t>((wide - value) >> 64) + static_cast<std::int64_t>(high << shift));
    };
    const auto shiftAll = [&](Sums& sums, std::uint64_t firstSum) {
        for (std::size_t i = 0; i < sums.size(); ++i) {
            for (unsigned c = 0; c < 3; ++c) {
                shiftOne(sums[i].invisible[c], firstSum + 6 * i + c);
                shiftOne(sums[i].visible[c], firstSum + 6 * i + 3 + c);
            }
        }
    };
    shiftAll(sums_, 0);
    shiftAll(lightPathSums_, firstLightPathSum());
}

void Film::add(const Film& other) {
    assert(other.sums_.size() == sums_.size() && other.layers_ == layers_);
    const int shift = std::ilogb(quantum_) - std::ilogb(other.quantum_);
    if (shift > 0) refine(shift);
    if (shift < 0) {
        Film finer = other;
        finer.refine(-shift);
        add(finer);
        return;
    }
    for (std::size_t i = 0; i < sums_.size(); ++i) {
        addTo(sums_[i], other.sums_[i], 6 * i);
        samples_[i] += other.samples_[i];
    }
    for (std::size_t i = 0; i < layerSums_.size(); ++i)
        layerSums_[i] += other.layerSums_[i];
    if (!other.lightPathSums_.empty() && lightPathSums_.empty()) lightPathSums_ = Sums(sums_.size());
    for (std::size_t i = 0; i < other.lightPathSums_.size(); ++i)
        addTo(lightPathSums_[i], other.lightPathSums_[i], firstLightPathSum() + 6 * i);
    countLightPaths(other.lightPaths_);
    for (const auto& [sum, count] : other.carries_)
        carry(sum, count);
    overflowed_ = overflowed_ || other.overflowed_;
}

void Film::add(std::span<const std::uint32_t> pixels, std::span<const PixelSum> sums, std::uint32_t samples,
               std::span<const std::int64_t> layerSums) {
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        addTo(sums_[pixels[i]], sums[i], 6 * std::uint64_t{pixels[i]});
        samples_[pixels[i]] += samples;
    }
    const std::size_t channels = channelsOf(layers_);
    assert(layerSums.size() == pixels.size() * channels);
    for (std::size_t i = 0; i < layerSums.size(); ++i)
        layerSums_[pixels[i / channels] * channels + i % channels] += layerSums[i];
}

void Film::addLightPathSums(std::uint32_t firstPixel, std::span<const PixelSum> sums) {
    if (sums.empty()) return;
    if (lightPathSums_.empty()) lightPathSums_ = Sums(sums_.size());
    for (std::size_t i = 0; i < sums.size(); ++i) {
        PixelSum sum = sums[i];
        for (int c = 0; c < 3; ++c) {
            for (std::int64_t* value : {&sum.invisible[c], &sum.visible[c]}) {
                if (*value >= 0) continue;
                *value = std::numeric_limits<std::int64_t>::max();
                overflowed_ = true;
            }
        }
        addTo(lightPathSums_[firstPixel + i], sum, firstLightPathSum() + 6 * (firstPixel + i));
    }
}

std::uint64_t Film::totalSamples() const {
    std::uint64_t total = 0;
    for (std::uint32_t samples : samples_)
        total += samples;
    return total;
}

double Film::largestRadiance() const {
    return static_cast<double>(shared::kFilmLargest) * static_cast<double>(quantum_);
}

glm::dvec3 Film::meanOf(std::size_t pixel, int component) const {
    const auto quantum = static_cast<double>(quantum_);
    const double scale = samples_[pixel] > 0 ? quantum / samples_[pixel] : 0.0;
    const double lightScale =
        lightPaths_ > 0 ? quantum * static_cast<double>(sums_.size()) / static_cast<double>(lightPaths_)
                        : 0.0;
    const auto value = [&](const PixelSum& sums, int channel, std::uint64_t firstSum) {
        const std::int64_t low = (component == 0 ? sums.invisible : sums.visible)[channel];
        if (carries_.empty()) return static_cast<double>(low);
        const auto carried =
            carries_.find(firstSum + 6 * pixel + static_cast<unsigned>(3 * component + channel));
        return static_cast<double>(low) +
               (carried == carries_.end() ? 0.0 : 0x1p64 * static_cast<double>(carried->second));
    };
    glm::dvec3 mean;
    for (int c = 0; c < 3; ++c) {
        mean[c] = value(sums_[pixel], c, 0) * scale;
        if (!lightPathSums_.empty())
            mean[c] += value(lightPathSums_[pixel], c, firstLightPathSum()) * lightScale;
    }
    return mean;
}

bool Film::overflowed() const {
    if (overflowed_) return true;
    const glm::dvec3 largest(largestRadiance());
    for (std::size_t i = 0; i < sums_.size(); ++i) {
        for (const int component : {0, 1}) {
            if (glm::any(glm::greaterThan(meanOf(i, component), largest))) return true;
        }
    }
    return false;
}

ImageRows Film::rows() const {
    ImageRows rows{width_,
                   height_,
                   [this](std::uint32_t firstRow, std::span<glm::vec3> invisible,
                          std::span<glm::vec3> visible) { readRows(firstRow, invisible, visible); },
                   {}};
    for (const FilmLayer* layer : layersOf(layers_)) {
        rows.layers.push_back({std::string(layer->name), std::string(layer->channels),
                               [this, layer](std::uint32_t firstRow, std::span<float> values) {
                                   readLayer(*layer, firstRow, values);
                               }});
    }
    return rows;
}

void Film::readLayer(const FilmLayer& layer, std::uint32_t firstRow, std::span<float> values) const {
    std::size_t first = 0;  // the layer's first channel
    for (const FilmLayer* other : layersOf(layers_)) {
        if (other == &layer) break;
        first += other->channels.size();
    }
    const std::size_t all = channelsOf(layers_), channels = layer.channels.size();
    const std::size_t firstPixel = std::size_t{firstRow} * width_;
    for (std::size_t i = 0; i < values.size(); ++i) {
        const std::size_t pixel = firstPixel + i / channels;
        const auto sum = static_cast<double>(layerSums_[pixel * all + first + i % channels]);
        values[i] = samples_[pixel] > 0 ? static_cast<float>(sum * layer.quantum() / samples_[pixel]) : 0.0f;
    }
}

void Film::readRows(std::uint32_t firstRow, std::span<glm::vec3> invisible,
                    std::span<glm::vec3> visible) const {
    const glm::dvec3 largest(largestRadiance());
    const std::size_t first = std::size_t{firstRow} * width_;
    parallelFor(visible.size(), 4096, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            invisible[i] = glm::vec3(glm::min(meanOf(first + i, 0), largest));
            visible[i] = glm::vec3(glm::min(meanOf(first + i, 1), largest));
        }
    });
}

RadianceImage Film::resolve() const {
    RadianceImage image{width_, height_, std::vector<glm::vec3>(sums_.size()),
                        std::vector<glm::vec3>(sums_.size())};
    readRows(0, image.invisible, image.visible);
    return image;
}

std::vector<float> Film::resolve(FilmLayerSet layer) const {
    if (!std::has_single_bit(layer) || (layers_ & layer) == 0) {
        throw UsageError(fmt::format("'{}' is not one of the film's layers", fmt::join(namesOf(layer), ",")));
    }
    std::vector<float> values(sums_.size() * channelsOf(layer));
    readLayer(*layersOf(layer).front(), 0, values);
    return values;
}

}  // namespace duolux

#include "host/scene/origin.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace duolux {

namespace {

glm::dvec3 inUnits(const glm::dvec3& place, double size) {
    const double unit = std::pow(10.0, std::floor(std::log10(size)));
    return glm::round(place / unit) * unit;
}

double largestOf(const glm::dvec3& v) {
    return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

std::size_t countMoved(std::span<const OriginSample> samples, const glm::dvec3& origin) {
    return static_cast<std::size_t>(std::count_if(samples.begin(), samples.end(), [&](const auto& sample) {
        return roundingError(sample.place - origin) > sample.tolerance;
    }));
}

/// The sample nearest to the median of each axis, rounded to multiples of several hundred edges.
glm::dvec3 originAmid(std::span<const OriginSample> samples) {
    glm::dvec3 median;
    for (int axis = 0; axis < 3; ++axis) {
        std::vector<double> values;
        values.reserve(samples.size());
        for (const OriginSample& sample : samples)
            values.push_back(sample.place[axis]);
        median[axis] = medianOf(std::move(values));
    }
    const OriginSample& amid =
        *std::min_element(samples.begin(), samples.end(), [&](const auto& a, const auto& b) {
            return largestOf(a.place - median) < largestOf(b.place - median);
        });
    return amid.tolerance > 0.0 ? inUnits(amid.place, 1000.0 * amid.tolerance / kUnnoticed) : amid.place;
}

}  // namespace

double WideBounds::extent() const {
    const glm::dvec3 size = upper - lower;
    return std::max({size.x, size.y, size.z});
}

double WideBounds::reach() const {
    return largestOf(glm::max(glm::abs(lower), glm::abs(upper)));
}

double roundingError(const glm::dvec3& place) {
    return largestOf(glm::dvec3(glm::vec3(place)) - place);
}

double largestRoundingError(double reach) {
    constexpr double kHalfUlp = 0x1p-24;
    return reach * kHalfUlp;
}

double medianOf(std::vector<double> values) {
    if (values.empty()) return 0.0;
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

glm::dvec3 originFor(const WideBounds& bounds) {
    if (bounds.empty()) return glm::dvec3(0.0);
    const double extent = bounds.extent();
    if (extent <= 0.0 || bounds.reach() <= kFarAway * extent) return glm::dvec3(0.0);
    return inUnits(0.5 * (bounds.lower + bounds.upper), extent);
}

glm::dvec3 originFor(const WideBounds& bounds, std::span<const OriginSample> samples) {
    const glm::dvec3 middle = originFor(bounds);
    const std::size_t moved = countMoved(samples, middle);
    if (moved == 0) return middle;
    const glm::dvec3 amid = originAmid(samples);
    return 2 * countMoved(samples, amid) <= moved ? amid : middle;
}

}  // namespace duolux

#include "host/scene/origin.h"

#include <algorithm>
#include <cmath>

namespace duolux {

double WideBounds::extent() const {
    const glm::dvec3 size = upper - lower;
    return std::max({size.x, size.y, size.z});
}

double WideBounds::reach() const {
    const glm::dvec3 largest = glm::max(glm::abs(lower), glm::abs(upper));
    return std::max({largest.x, largest.y, largest.z});
}

glm::dvec3 originFor(const WideBounds& bounds) {
    if (bounds.empty()) return glm::dvec3(0.0);
    const double extent = bounds.extent();
    if (extent <= 0.0 || bounds.reach() <= kFarAway * extent) return glm::dvec3(0.0);
    const double unit = std::pow(10.0, std::floor(std::log10(extent)));
    return glm::round((bounds.lower + bounds.upper) / (2.0 * unit)) * unit;
}

}  // namespace duolux

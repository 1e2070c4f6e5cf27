#include "host/device_scene/surface_planes.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "host/device_scene/coincident.h"

namespace duolux {

namespace {

float largestCoordinate(const Geometry& geometry, std::size_t triangle) {
    const glm::uvec3 index = geometry.triangles[triangle];
    float largest = 0.0f;
    for (int k = 0; k < 3; ++k) {
        const glm::vec3 p = glm::abs(geometry.positions[index[k]]);
        largest = std::max({largest, p.x, p.y, p.z});
    }
    return largest;
}

/// Whether some triangle extends many times as far as the nearest tenth of all triangles: single precision,
/// relative to its corners, is then too coarse for surfaces near the origin.
bool anyReachesFar(const Geometry& geometry) {
    constexpr float kFar = 64.0f;
    constexpr std::size_t kSamples = 4096;
    const std::size_t count = geometry.triangles.size();
    float largest = 0.0f;
    for (std::size_t i = 0; i < count; ++i)
        largest = std::max(largest, largestCoordinate(geometry, i));
    std::vector<float> sample;
    const std::size_t step = (count + kSamples - 1) / kSamples;
    for (std::size_t i = 0; i < count; i += step)
        sample.push_back(largestCoordinate(geometry, i));
    const auto tenth = sample.begin() + static_cast<std::ptrdiff_t>(sample.size() / 10);
    std::nth_element(sample.begin(), tenth, sample.end());
    return largest > kFar * *tenth;
}

}  // namespace

SurfacePlanes::SurfacePlanes(const Geometry& geometry)
    : geometry_(&geometry), groups_(coincidentGroups(geometry)) {
    used_ = !groups_.empty() || anyReachesFar(geometry);
    shared_.resize(groups_.size());
    for (std::uint32_t i = 0; i < groups_.size(); ++i) {
        if (groups_[i] == i) continue;
        shared_[i] = true;
        shared_[groups_[i]] = true;
    }
}

glm::vec4 SurfacePlanes::planeOf(std::uint32_t triangle) const {
    const auto corner = [&](std::uint32_t of, int k) {
        return glm::dvec3(geometry_->positions[geometry_->triangles[of][k]]);
    };
    const auto areaVector = [&](std::uint32_t of) {
        return glm::cross(corner(of, 1) - corner(of, 0), corner(of, 2) - corner(of, 0));
    };
    const std::uint32_t source = groups_.empty() ? triangle : groups_[triangle];
    const glm::vec3 normal(glm::normalize(areaVector(source)));
    // The plane with the rounded normal passes through the corner nearest to the origin.
    double offset = 0.0, nearest = INFINITY;
    for (int k = 0; k < 3; ++k) {
        const glm::dvec3 p = corner(source, k);
        if (glm::dot(p, p) >= nearest) continue;
        nearest = glm::dot(p, p);
        offset = glm::dot(glm::dvec3(normal), p);
    }
    const float sign = glm::dot(areaVector(source), areaVector(triangle)) < 0.0 ? -1.0f : 1.0f;
    return {sign * normal, sign * static_cast<float>(offset)};
}

}  // namespace duolux

#include "host/loaders/triangulate.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <numeric>

#include "host/loaders/clip_ears.h"

namespace duolux {

namespace {

using Triangle = std::array<std::uint32_t, 3>;

/// Newell's method: twice the area vector of a closed polygon, even if it is not exactly planar.
glm::dvec3 areaVector(std::span<const glm::vec3> corners) {
    glm::dvec3 sum(0.0);
    const glm::dvec3 origin(corners[0]);
    for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
        sum += glm::cross(glm::dvec3(corners[i]) - origin, glm::dvec3(corners[i + 1]) - origin);
    }
    return sum;
}

/// Projects the polygon along the largest component of its normal, with counter-clockwise order.
std::vector<glm::dvec2> project(std::span<const glm::vec3> corners, const glm::dvec3& area) {
    const glm::dvec3 size = glm::abs(area);
    const int drop = size.x > size.y && size.x > size.z ? 0 : (size.y > size.z ? 1 : 2);
    const int first = (drop + 1) % 3;
    const int second = (drop + 2) % 3;
    const double turn = area[drop] < 0.0 ? -1.0 : 1.0;
    std::vector<glm::dvec2> points;
    points.reserve(corners.size());
    for (const glm::vec3& corner : corners) {
        points.emplace_back(static_cast<double>(corner[first]), turn * static_cast<double>(corner[second]));
    }
    return points;
}

bool isConvex(const std::vector<glm::dvec2>& points) {
    // All turns are to the left, and their sum is one revolution (it is more for a star polygon).
    double round = 0.0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const glm::dvec2& a = points[i];
        const glm::dvec2& b = points[(i + 1) % points.size()];
        const glm::dvec2& c = points[(i + 2) % points.size()];
        const double turn = turnAt(a, b, c);
        if (turn <= 0.0) return false;
        round += std::atan2(turn, glm::dot(b - a, c - b));
    }
    return round < 7.0;  // 2 pi rather than 4 pi
}

void fan(std::uint32_t count, std::vector<Triangle>& triangles) {
    for (std::uint32_t i = 1; i + 1 < count; ++i)
        triangles.push_back({0, i, i + 1});
}

/// Tiles a convex polygon of many corners: cuts off every second corner, then every second one of those left,
/// and so on. A fan's triangles would all be about as long as the polygon, and a ray close to its plane would
/// meet the boxes of most of them.
void cutEverySecondCorner(std::uint32_t count, std::vector<Triangle>& triangles) {
    std::vector<std::uint32_t> ring(count);
    std::iota(ring.begin(), ring.end(), 0u);
    std::vector<std::uint32_t> left;
    while (ring.size() > 3) {
        left.clear();
        for (std::size_t i = 0; i < ring.size(); i += 2) {
            left.push_back(ring[i]);
            if (i + 1 == ring.size()) break;
            const std::uint32_t after = i + 2 < ring.size() ? ring[i + 2] : ring[0];
            triangles.push_back({ring[i], ring[i + 1], after});
        }
        ring.swap(left);
    }
    if (ring.size() == 3) triangles.push_back({ring[0], ring[1], ring[2]});
}

void cutQuadrilateral(std::span<const glm::vec3> corners, const glm::dvec3& area,
                      std::vector<Triangle>& triangles) {
    // The smaller of the signed areas of the two triangles at a diagonal; positive on the front.
    auto smallerHalf = [&](std::uint32_t from) {
        const glm::dvec3 a(corners[from]), b(corners[from + 1]), c(corners[from + 2]),
            d(corners[(from + 3) % 4]);
        return std::min(glm::dot(glm::cross(b - a, c - a), area), glm::dot(glm::cross(c - a, d - a), area));
    };
    const double half02 = smallerHalf(0);
    const double half13 = smallerHalf(1);
    const float diagonal02 = glm::distance(corners[0], corners[2]);
    const float diagonal13 = glm::distance(corners[1], corners[3]);
    const bool bothFit = half02 > 0.0 && half13 > 0.0;
    const bool by02 = bothFit ? diagonal02 <= diagonal13 : half02 >= half13;
    if (by02) {
        triangles.push_back({0, 1, 2});
        triangles.push_back({0, 2, 3});
    } else {
        triangles.push_back({0, 1, 3});
        triangles.push_back({1, 2, 3});
    }
}

}  // namespace

void triangulate(std::span<const glm::vec3> corners, std::vector<Triangle>& triangles) {
    assert(corners.size() >= 3);
    const auto count = static_cast<std::uint32_t>(corners.size());
    if (count == 3) return fan(count, triangles);
    const glm::dvec3 area = areaVector(corners);
    if (count == 4) return cutQuadrilateral(corners, area, triangles);
    const std::vector<glm::dvec2> points = project(corners, area);
    constexpr std::uint32_t kMany = 32;
    if (isConvex(points))
        return count < kMany ? fan(count, triangles) : cutEverySecondCorner(count, triangles);
    clipEars(points, triangles);
}

}  // namespace duolux

#include "tests/support/closed_form.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace duolux::test {

namespace {

/// Sutherland-Hodgman against one plane: the part of the polygon where dot(normal, p) > 0.
std::vector<Vec3> clipToHorizon(const std::vector<Vec3>& polygon, const Vec3& normal) {
    std::vector<Vec3> clipped;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Vec3 &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
        const double hp = glm::dot(normal, p), hq = glm::dot(normal, q);
        if (hp > 0.0) clipped.push_back(p);
        if ((hp > 0.0) != (hq > 0.0)) clipped.push_back(p + (hp / (hp - hq)) * (q - p));
    }
    return clipped;
}

}  // namespace

ChannelLight enclosureRadiance(const ChannelMatrix& scatter, const ChannelLight& emission,
                               std::uint32_t bounces) {
    // Horner's scheme: L <- E + S L.
    ChannelLight light = emission;
    for (std::uint32_t i = 0; i < bounces; ++i)
        light = emission + scatter * light;
    return light;
}

double lambertPolygon(const Vec3& point, const Vec3& normal, std::span<const Vec3> polygon) {
    std::vector<Vec3> corners;
    for (const Vec3& p : polygon)
        corners.push_back(p - point);
    corners = clipToHorizon(corners, normal);
    double sum = 0.0;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const Vec3 &p = corners[i], &q = corners[(i + 1) % corners.size()];
        const Vec3 axis = glm::cross(p, q - p);  // p x q, which would lose the digits of a short edge
        const double sine = glm::length(axis);
        if (sine > 0.0) sum += std::atan2(sine, glm::dot(p, q)) * glm::dot(axis / sine, normal);
    }
    // The sign depends only on the winding as seen from the point.
    return 0.5 * std::abs(sum);
}

reference::Estimate exactly(const ChannelLight& light) {
    reference::Estimate estimate;
    for (std::size_t c = 0; c < 3; ++c) {
        estimate.mean[0][c] = light[c].x;
        estimate.mean[1][c] = light[c].y;
    }
    return estimate;
}

reference::Estimates uniformImage(std::uint32_t width, std::uint32_t height, const ChannelLight& light) {
    return {width, height, 0, std::vector(std::size_t{width} * height, exactly(light))};
}

}  // namespace duolux::test

#include "tests/reference/triangles.h"

#include <algorithm>
#include <limits>

namespace duolux::reference {

Triangles::Triangles(const Geometry& geometry) {
    Vec3 lower(std::numeric_limits<double>::max()), upper(std::numeric_limits<double>::lowest());
    for (const glm::uvec3& t : geometry.triangles) {
        const Corners corners{Vec3(geometry.positions[t.x]), Vec3(geometry.positions[t.y]),
                              Vec3(geometry.positions[t.z])};
        for (const Vec3& p : {corners.a, corners.b, corners.c}) {
            lower = glm::min(lower, p);
            upper = glm::max(upper, p);
        }
        const Vec3 ab = corners.b - corners.a, ac = corners.c - corners.a;
        const Vec3 cross = glm::cross(ab, ac);
        const double twiceArea = glm::length(cross);
        const Vec3 n = twiceArea > 0.0 ? cross / twiceArea : Vec3(0.0);
        // u(p) = ((p - a) x ac) . n / 2A and v(p) = (ab x (p - a)) . n / 2A, written as planes.
        const Vec3 un = twiceArea > 0.0 ? glm::cross(ac, n) / twiceArea : Vec3(0.0);
        const Vec3 vn = twiceArea > 0.0 ? glm::cross(n, ab) / twiceArea : Vec3(0.0);
        corners_.push_back(corners);
        frames_.push_back(
            {{n, -glm::dot(n, corners.a)}, {un, -glm::dot(un, corners.a)}, {vn, -glm::dot(vn, corners.a)}});
        normals_.push_back(n);
        areas_.push_back(0.5 * twiceArea);
    }
    nearest_ = 1e-11 * glm::length(upper - lower);
}

Vec3 Triangles::point(std::uint32_t triangle, double u, double v) const {
    const Corners& c = corners_[triangle];
    return (1.0 - u - v) * c.a + u * c.b + v * c.c;
}

void Triangles::crossings(const Ray& ray, double limit, std::uint32_t from, std::uint32_t to,
                          std::vector<Crossing>& found) const {
    found.clear();
    for (std::uint32_t i = 0; i < frames_.size(); ++i) {
        const Frame& frame = frames_[i];
        const double slope = glm::dot(frame.support.n, ray.direction);
        const double height = frame.support.at(ray.origin);
        // Behind, parallel or degenerate: the ray does not approach the plane.
        if (height * slope >= 0.0) continue;
        const double distance = -height / slope;
        if (!(distance > nearest_ && distance < limit) || i == from || i == to) continue;
        const Vec3 p = ray.origin + distance * ray.direction;
        const double u = frame.u.at(p);
        if (u < 0.0) continue;
        const double v = frame.v.at(p);
        if (v < 0.0 || u + v > 1.0) continue;
        found.push_back({distance, i, slope < 0.0});
    }
    std::sort(found.begin(), found.end(),
              [](const Crossing& a, const Crossing& b) { return a.distance < b.distance; });
}

}  // namespace duolux::reference

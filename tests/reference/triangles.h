#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "host/scene/scene.h"
#include "tests/reference/pinhole.h"

namespace duolux::reference {

/// The intersection of a ray with a surface.
struct Crossing {
    double distance;
    std::uint32_t triangle;
    bool front;  ///< the ray comes from the front, as the winding defines it
};

/// Intersects all triangles of a scene one by one, without an acceleration structure that could have errors.
class Triangles {
  public:
    static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

    explicit Triangles(const Geometry& geometry);

    std::size_t size() const { return corners_.size(); }
    Vec3 normal(std::uint32_t triangle) const { return normals_[triangle]; }  ///< unit, on the front side
    double area(std::uint32_t triangle) const { return areas_[triangle]; }
    /// Point with barycentric coordinates (1 - u - v, u, v).
    Vec3 point(std::uint32_t triangle, double u, double v) const;

    /// All surfaces before `limit`, nearest first. `from` and `to`, on which the ray starts and ends, are
    /// excluded.
    void crossings(const Ray& ray, double limit, std::uint32_t from, std::uint32_t to,
                   std::vector<Crossing>& found) const;

  private:
    struct Corners {
        Vec3 a, b, c;
    };
    /// n . p + d.
    struct Plane {
        Vec3 n;
        double d;
        double at(const Vec3& p) const { return glm::dot(n, p) + d; }
    };
    /// The supporting plane, and two planes whose values in it are the barycentric coordinates of b and c.
    struct Frame {
        Plane support, u, v;
    };

    std::vector<Corners> corners_;
    std::vector<Frame> frames_;
    std::vector<Vec3> normals_;
    std::vector<double> areas_;
    double nearest_ = 0.0;  ///< distances below this are rounding at a shared edge
};

}  // namespace duolux::reference

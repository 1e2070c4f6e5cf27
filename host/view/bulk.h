#pragma once

#include <cstddef>
#include <glm/glm.hpp>

#include "host/scene/scene.h"

namespace duolux {

/// The part of a scene's surface that a camera should show: all of it, except a few parts that are so far
/// from the rest that a picture of everything would show nothing. In the coordinates of the scene.
struct Bulk {
    glm::dvec3 lower{0.0}, upper{0.0};  ///< bounds of what a camera should show
    std::size_t framed = 0;             ///< only the first triangles of the scene may be framed
    std::size_t outliers = 0;           ///< number of these triangles that are too far away
    glm::dvec3 centre{0.0};             ///< the middle of most of the area
    double reach = 0.0;                 ///< triangles whose bounds are at least this far from it are outliers

    bool isOutlier(const Geometry& geometry, std::size_t triangle) const;
};

/// The bulk of the first `framedTriangles` triangles.
Bulk bulkOf(const Geometry& geometry, std::size_t framedTriangles);

}  // namespace duolux

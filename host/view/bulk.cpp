#include "host/view/bulk.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

#include "host/scene/origin.h"

namespace duolux {

namespace {

/// How many times as far away as the bulk the outliers must be: few of them, and many.
constexpr double kNarrowGap = 8.0, kWideGap = 32.0;

struct Corners {
    glm::dvec3 a, b, c;

    Corners(const Geometry& geometry, std::size_t triangle) {
        const glm::uvec3 t = geometry.triangles[triangle];
        a = geometry.positions[t.x];
        b = geometry.positions[t.y];
        c = geometry.positions[t.z];
    }

    double area() const { return 0.5 * glm::length(glm::cross(b - a, c - a)); }
    glm::dvec3 centroid() const { return (a + b + c) / 3.0; }

    /// The distance from a point to the nearest point of the triangle's bounds.
    double nearest(const glm::dvec3& point) const {
        const glm::dvec3 lower = glm::min(a, glm::min(b, c)), upper = glm::max(a, glm::max(b, c));
        return glm::length(glm::max(glm::dvec3(0.0), glm::max(lower - point, point - upper)));
    }

    void addTo(WideBounds& bounds) const {
        bounds.add(a);
        bounds.add(b);
        bounds.add(c);
    }

    double farthest(const glm::dvec3& point) const {
        return std::max({glm::distance(a, point), glm::distance(b, point), glm::distance(c, point)});
    }
};

/// Centroids of triangles, in proportion to their areas.
std::vector<glm::dvec3> pick(const Geometry& geometry, const std::vector<double>& areas) {
    constexpr std::size_t kPicks = 1024;
    const double step = std::accumulate(areas.begin(), areas.end(), 0.0) / kPicks;
    std::vector<glm::dvec3> picks;
    double before = 0.0;
    for (std::size_t i = 0; i < areas.size() && picks.size() < kPicks; ++i) {
        before += areas[i];
        while (picks.size() < kPicks && (static_cast<double>(picks.size()) + 0.5) * step < before)
            picks.push_back(Corners(geometry, i).centroid());
    }
    return picks;
}

/// The median of each axis.
glm::dvec3 middleOf(const std::vector<glm::dvec3>& points) {
    glm::dvec3 middle;
    for (int axis = 0; axis < 3; ++axis) {
        std::vector<double> values;
        for (const glm::dvec3& point : points)
            values.push_back(point[axis]);
        middle[axis] = medianOf(std::move(values));
    }
    return middle;
}

/// The area of a surface by its distance from a point, in bins of a quarter of an octave.
class Distances {
  public:
    void add(double nearest, double farthest, double area) {
        const std::size_t first = binOf(nearest), last = binOf(farthest);
        areas_[last] += area;
        whole_ += area;
        ++begins_[first];
        ++ends_[last];
    }

    /// The distance at which outliers begin: behind a gap that is wide in proportion to what lies before it.
    /// The less area lies behind a gap, the narrower it may be. Infinity without such a gap.
    double gap() const {
        const int narrow = static_cast<int>(std::log2(kNarrowGap) * kBinsPerOctave);
        const int wide = static_cast<int>(std::log2(kWideGap) * kBinsPerOctave);
        constexpr double kFew = 0.1, kMinority = 0.45;  // parts of the area
        std::size_t open = 0;
        double behind = whole_;
        int empty = 0;
        for (std::size_t bin = 0; bin < kBins; ++bin) {
            open += begins_[bin];
            if (open > 0 && behind < whole_ &&
                ((empty >= narrow && behind <= kFew * whole_) ||
                 (empty >= wide && behind <= kMinority * whole_))) {
                return std::exp2(static_cast<double>(bin) / kBinsPerOctave - kOctavesBelow) * (1.0 - 1e-9);
            }
            empty = open > 0 ? 0 : empty + 1;
            behind -= areas_[bin];
            open -= ends_[bin];
        }
        return std::numeric_limits<double>::infinity();
    }

  private:
    static constexpr int kBinsPerOctave = 4, kOctavesBelow = 150;  // of floats
    static constexpr std::size_t kBins = 280 * kBinsPerOctave;

    static std::size_t binOf(double distance) {
        if (!(distance > 0.0)) return 0;
        const double bin = std::floor((std::log2(distance) + kOctavesBelow) * kBinsPerOctave);
        return static_cast<std::size_t>(std::clamp(bin, 0.0, static_cast<double>(kBins - 1)));
    }

    std::vector<double> areas_ = std::vector<double>(kBins, 0.0);
    std::vector<std::size_t> begins_ = std::vector<std::size_t>(kBins, 0),
                             ends_ = std::vector<std::size_t>(kBins, 0);
    double whole_ = 0.0;
};

}  // namespace

bool Bulk::isOutlier(const Geometry& geometry, std::size_t triangle) const {
    return outliers > 0 && Corners(geometry, triangle).nearest(centre) >= reach;
}

Bulk bulkOf(const Geometry& geometry, std::size_t framedTriangles) {
    Bulk bulk;
    bulk.framed = framedTriangles;
    std::vector<double> areas(framedTriangles);
    WideBounds bounds;
    for (std::size_t i = 0; i < framedTriangles; ++i) {
        const Corners corners(geometry, i);
        areas[i] = corners.area();
        corners.addTo(bounds);
    }
    bulk.lower = bounds.lower;
    bulk.upper = bounds.upper;
    const std::vector<glm::dvec3> picks = pick(geometry, areas);
    bulk.centre = middleOf(picks);
    std::vector<double> typical;
    for (const glm::dvec3& place : picks)
        typical.push_back(glm::distance(place, bulk.centre));
    const double most = glm::length(glm::max(bulk.upper - bulk.centre, bulk.centre - bulk.lower));
    if (most <= kNarrowGap * medianOf(std::move(typical))) return bulk;

    Distances distances;
    for (std::size_t i = 0; i < framedTriangles; ++i) {
        const Corners corners(geometry, i);
        distances.add(corners.nearest(bulk.centre), corners.farthest(bulk.centre), areas[i]);
    }
    bulk.reach = distances.gap();
    bounds = {};
    for (std::size_t i = 0; i < framedTriangles; ++i) {
        const Corners corners(geometry, i);
        if (corners.nearest(bulk.centre) >= bulk.reach) {
            ++bulk.outliers;
        } else {
            corners.addTo(bounds);
        }
    }
    bulk.lower = bounds.lower;
    bulk.upper = bounds.upper;
    return bulk;
}

}  // namespace duolux

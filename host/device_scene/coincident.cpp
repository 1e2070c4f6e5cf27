#include "host/device_scene/coincident.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <optional>
#include <span>
#include <utility>

#include "host/base/hash.h"
#include "host/base/parallel.h"
#include "host/device_scene/flat_triangles.h"

namespace duolux {

namespace {

using Corners = std::array<glm::dvec3, 3>;

/// dot(normal, x) = offset. The unit normal is on a fixed side of an arbitrary direction, so that both
/// windings of a triangle have the same plane.
struct Plane {
    glm::dvec3 normal;
    double offset;
};

/// Triangles whose planes are equal within rounding have at least one key in common.
using PlaneKeys = std::array<std::uint64_t, 2>;

class Finder {
  public:
    explicit Finder(const Geometry& geometry)
        : geometry_(geometry), count_(geometry.triangles.size()), sets_(count_) {
        const Bounds bounds = boundsOf(geometry);
        centre_ = 0.5 * (glm::dvec3(bounds.lower) + glm::dvec3(bounds.upper));
        size_ = glm::length(glm::dvec3(bounds.upper) - glm::dvec3(bounds.lower));
        const glm::dvec3 largest =
            glm::max(glm::abs(glm::dvec3(bounds.lower)), glm::abs(glm::dvec3(bounds.upper)));
        rounding_ = std::max({largest.x, largest.y, largest.z}) * 0x1p-24;
    }

    std::vector<std::uint32_t> run() {
        const std::vector<Candidate> candidates = findCandidates();
        for (std::size_t begin = 0; begin < candidates.size();) {
            std::size_t end = begin;
            while (end < candidates.size() && candidates[end].key == candidates[begin].key)
                ++end;
            if (end - begin > 1) comparePlane(std::span(candidates).subspan(begin, end - begin));
            begin = end;
        }
        if (!any_) return {};
        return representatives();
    }

  private:
    static constexpr double kRoundings = 8.0;  ///< rounding errors within which positions are equal

    struct Candidate {
        std::uint64_t key;
        std::uint32_t triangle;
        auto operator<=>(const Candidate&) const = default;
    };

    Corners cornersOf(std::uint32_t triangle) const {
        const glm::uvec3 index = geometry_.triangles[triangle];
        return {glm::dvec3(geometry_.positions[index.x]), glm::dvec3(geometry_.positions[index.y]),
                glm::dvec3(geometry_.positions[index.z])};
    }

    static double doubleArea(const Corners& c) { return glm::length(glm::cross(c[1] - c[0], c[2] - c[0])); }

    Plane planeOf(const Corners& c) const {
        static const glm::dvec3 kAside(0.7320508, 0.5179492, 0.4432813);
        glm::dvec3 normal = glm::normalize(glm::cross(c[1] - c[0], c[2] - c[0]));
        if (glm::dot(normal, kAside) < 0.0) normal = -normal;
        return {normal, glm::dot(normal, (c[0] + c[1] + c[2]) / 3.0 - centre_)};
    }

    /// Keys in two grids that are offset by half a cell: planes that rounding separates in one grid are in
    /// the same cell of the other.
    PlaneKeys keysOf(std::uint32_t triangle) const {
        const Plane plane = planeOf(cornersOf(triangle));
        constexpr double kCells = 4096.0;
        const std::array<double, 4> values{kCells * plane.normal.x, kCells * plane.normal.y,
                                           kCells * plane.normal.z, 4.0 * kCells * plane.offset / size_};
        PlaneKeys out{};
        for (int grid = 0; grid < 2; ++grid) {
            std::array<std::int64_t, 5> cell{};
            for (std::size_t i = 0; i < values.size(); ++i)
                cell[i] = static_cast<std::int64_t>(std::floor(values[i] + 0.25 + 0.5 * grid));
            cell.back() = grid;
            out[static_cast<std::size_t>(grid)] = hashOf(std::as_bytes(std::span(cell)));
        }
        return out;
    }

    /// The triangles that share a key with another one, in the order of the keys. A table of counts excludes
    /// most triangles of curved surfaces before sorting.
    std::vector<Candidate> findCandidates() const {
        const std::size_t slots = std::bit_ceil(std::max<std::size_t>(8 * count_, 1024));
        std::vector<std::uint8_t> used(slots);
        const auto forKeys = [&](const auto& use) {
            parallelFor(count_, 1 << 14, [&](std::size_t begin, std::size_t end) {
                for (std::size_t i = begin; i < end; ++i) {
                    for (const std::uint64_t key : keysOf(static_cast<std::uint32_t>(i)))
                        use(key, static_cast<std::uint32_t>(i));
                }
            });
        };
        forKeys([&](std::uint64_t key, std::uint32_t) {
            std::atomic_ref slot(used[key % slots]);
            if (slot.load(std::memory_order_relaxed) < 2) slot.fetch_add(1, std::memory_order_relaxed);
        });
        std::vector<Candidate> candidates(2 * count_);
        std::atomic<std::size_t> next{0};
        forKeys([&](std::uint64_t key, std::uint32_t triangle) {
            if (used[key % slots] > 1) candidates[next++] = {key, triangle};
        });
        candidates.resize(next);
        std::sort(candidates.begin(), candidates.end());
        return candidates;
    }

    std::vector<FlatTriangle> flatten(std::span<const Candidate> plane) const {
        const glm::dvec3 normal = planeOf(cornersOf(plane[0].triangle)).normal;
        const glm::dvec3 u =
            glm::normalize(std::abs(normal.x) > 0.6 ? glm::cross(normal, glm::dvec3(0, 1, 0))
                                                    : glm::cross(normal, glm::dvec3(1, 0, 0)));
        const glm::dvec3 v = glm::cross(normal, u);
        // Heights need a normal that is accurate for the whole plane, not for one slender triangle.
        glm::dvec3 mean(0.0);
        for (const Candidate& candidate : plane) {
            const Corners c = cornersOf(candidate.triangle);
            const glm::dvec3 areaVector = glm::cross(c[1] - c[0], c[2] - c[0]);
            mean += glm::dot(areaVector, normal) < 0.0 ? -areaVector : areaVector;
        }
        const glm::dvec3 up = glm::normalize(mean);
        std::vector<FlatTriangle> flat;
        for (const Candidate& candidate : plane) {
            FlatTriangle f;
            const Corners c = cornersOf(candidate.triangle);
            for (std::size_t k = 0; k < 3; ++k)
                f.corners[k] = {glm::dot(u, c[k]), glm::dot(v, c[k])};
            f.lower = glm::min(f.corners[0], glm::min(f.corners[1], f.corners[2]));
            f.upper = glm::max(f.corners[0], glm::max(f.corners[1], f.corners[2]));
            const glm::dvec3 heights(glm::dot(up, c[0]), glm::dot(up, c[1]), glm::dot(up, c[2]));
            f.lowest = std::min({heights.x, heights.y, heights.z});
            f.highest = std::max({heights.x, heights.y, heights.z});
            f.triangle = candidate.triangle;
            f.doubleArea = glm::length(glm::cross(c[1] - c[0], c[2] - c[0]));
            flat.push_back(f);
        }
        return flat;
    }

    /// Compares the triangles of one plane with each other.
    void comparePlane(std::span<const Candidate> plane) {
        constexpr std::size_t kFew = 16;
        const std::vector<FlatTriangle> flat = flatten(plane);
        if (flat.size() <= kFew) {
            for (std::size_t i = 0; i < flat.size(); ++i)
                compareWith(flat[i], std::span(flat).subspan(i + 1));
        } else if (const auto grid = gridOver(flat)) {
            compareInGrid(flat, *grid);
        } else {
            // Projected along the plane's normal, triangles in one plane are at most a little further apart.
            compareOverlapping(flat, 0.5 * kRoundings * rounding_, 2.0 * kRoundings * rounding_, sets_,
                               [&](const FlatTriangle& a, const FlatTriangle& b) { compare(a, b); });
        }
    }

    /// The cells that triangles of a plane are in.
    struct Grid {
        struct Entry {
            std::int64_t x, y;
            std::uint32_t index;
            auto operator<=>(const Entry&) const = default;
        };
        std::vector<Entry> entries;        ///< in the order of the cells
        std::vector<std::uint32_t> large;  ///< triangles that are in too many cells
    };

    /// The fastest way to compare triangles of about one size that are spread over the plane. Empty if too
    /// many would be compared.
    static std::optional<Grid> gridOver(std::span<const FlatTriangle> flat) {
        constexpr std::size_t kMostEach = 256;
        double extent = 0.0;
        for (const FlatTriangle& f : flat)
            extent += glm::length(f.upper - f.lower);
        const double cell = extent / static_cast<double>(flat.size());
        Grid grid;
        for (std::uint32_t i = 0; i < flat.size(); ++i) {
            const glm::i64vec2 first(glm::floor(flat[i].lower / cell)),
                last(glm::floor(flat[i].upper / cell));
            const glm::dvec2 sides = (flat[i].upper - flat[i].lower) / cell + 1.0;
            if (sides.x * sides.y > 64.0) {
                if (grid.large.size() == kMostEach) return std::nullopt;
                grid.large.push_back(i);
                continue;
            }
            for (std::int64_t x = first.x; x <= last.x; ++x) {
                for (std::int64_t y = first.y; y <= last.y; ++y)
                    grid.entries.push_back({x, y, i});
            }
        }
        std::sort(grid.entries.begin(), grid.entries.end());
        std::size_t comparisons = 0, before = 0;
        for (std::size_t i = 1; i < grid.entries.size(); ++i) {
            const bool sameCell =
                grid.entries[i].x == grid.entries[i - 1].x && grid.entries[i].y == grid.entries[i - 1].y;
            before = sameCell ? before + 1 : 0;
            comparisons += before;
        }
        if (comparisons > kMostEach * flat.size()) return std::nullopt;
        return grid;
    }

    void compareInGrid(std::span<const FlatTriangle> flat, const Grid& grid) {
        const std::vector<Grid::Entry>& entries = grid.entries;
        for (std::size_t begin = 0; begin < entries.size();) {
            std::size_t end = begin + 1;
            for (; end < entries.size() && entries[end].x == entries[begin].x &&
                   entries[end].y == entries[begin].y;
                 ++end) {
                for (std::size_t other = begin; other < end; ++other)
                    compare(flat[entries[end].index], flat[entries[other].index]);
            }
            begin = end;
        }
        for (const std::uint32_t i : grid.large)
            compareWith(flat[i], flat);
    }

    void compareWith(const FlatTriangle& one, std::span<const FlatTriangle> others) {
        for (const FlatTriangle& other : others) {
            if (other.triangle != one.triangle) compare(one, other);
        }
    }

    void compare(const FlatTriangle& a, const FlatTriangle& b) {
        if (glm::any(glm::lessThanEqual(glm::min(a.upper, b.upper), glm::max(a.lower, b.lower)))) return;
        if (sets_.rootOf(a.triangle) == sets_.rootOf(b.triangle) || !overlap(a, b)) return;
        const bool aLarger = a.doubleArea >= b.doubleArea;
        const Corners large = cornersOf((aLarger ? a : b).triangle),
                      small = cornersOf((aLarger ? b : a).triangle);
        const glm::dvec3 normal = glm::normalize(glm::cross(large[1] - large[0], large[2] - large[0]));
        for (const glm::dvec3& corner : small) {
            if (std::abs(glm::dot(normal, corner - large[0])) > kRoundings * rounding_) return;
        }
        any_ = true;
        sets_.unite(a.triangle, b.triangle);
    }

    /// Separating axis test: whether no line through an edge separates the triangles. The tolerance excludes
    /// neighbours that overlap only through rounding.
    bool overlap(const FlatTriangle& a, const FlatTriangle& b) const {
        constexpr double kLeast = 1e-3;  // of the narrower one
        for (const FlatTriangle* edges : {&a, &b}) {
            for (std::size_t e = 0; e < 3; ++e) {
                const glm::dvec2 edge = edges->corners[(e + 1) % 3] - edges->corners[e];
                const glm::dvec2 across(-edge.y, edge.x);
                const auto range = [&](const FlatTriangle& f) {
                    const double x = glm::dot(across, f.corners[0]), y = glm::dot(across, f.corners[1]),
                                 z = glm::dot(across, f.corners[2]);
                    return glm::dvec2(std::min({x, y, z}), std::max({x, y, z}));
                };
                const glm::dvec2 ra = range(a), rb = range(b);
                const double common = std::min(ra.y, rb.y) - std::max(ra.x, rb.x);
                const double narrower = std::min(ra.y - ra.x, rb.y - rb.x);
                const double roundings = kRoundings * rounding_ * glm::length(edge);
                if (common <= std::max(kLeast * narrower, roundings)) return false;
            }
        }
        return true;
    }

    /// The largest triangle of each group; the first of equally large ones.
    std::vector<std::uint32_t> representatives() {
        std::vector<std::uint32_t> largest(count_);
        std::iota(largest.begin(), largest.end(), 0u);
        std::vector<double> areas(count_, -1.0);
        for (std::uint32_t i = 0; i < count_; ++i) {
            const std::uint32_t root = sets_.rootOf(i);
            const double area = doubleArea(cornersOf(i));
            if (area <= areas[root]) continue;
            areas[root] = area;
            largest[root] = i;
        }
        std::vector<std::uint32_t> out(count_);
        for (std::uint32_t i = 0; i < count_; ++i)
            out[i] = largest[sets_.rootOf(i)];
        return out;
    }

    const Geometry& geometry_;
    std::size_t count_;
    glm::dvec3 centre_{0.0};
    double size_ = 0.0;
    double rounding_ = 0.0;  // rounding error of a coordinate
    DisjointSets sets_;
    bool any_ = false;
};

}  // namespace

std::vector<std::uint32_t> coincidentGroups(const Geometry& geometry) {
    if (geometry.triangles.size() < 2) return {};
    return Finder(geometry).run();
}

}  // namespace duolux

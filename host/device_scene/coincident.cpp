#include "host/device_scene/coincident.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <span>
#include <utility>

#include "host/base/hash.h"
#include "host/base/parallel.h"

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
    explicit Finder(const Geometry& geometry) : geometry_(geometry), count_(geometry.triangles.size()) {
        const Bounds bounds = boundsOf(geometry);
        centre_ = 0.5 * (glm::dvec3(bounds.lower) + glm::dvec3(bounds.upper));
        size_ = glm::length(glm::dvec3(bounds.upper) - glm::dvec3(bounds.lower));
        const glm::dvec3 largest =
            glm::max(glm::abs(glm::dvec3(bounds.lower)), glm::abs(glm::dvec3(bounds.upper)));
        rounding_ = std::max({largest.x, largest.y, largest.z}) * 0x1p-24;
    }

    std::vector<std::uint32_t> run() {
        const std::vector<Candidate> candidates = findCandidates();
        parents_.resize(count_);
        std::iota(parents_.begin(), parents_.end(), 0u);
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

    /// A triangle in the coordinates of its plane.
    struct Flat {
        std::array<glm::dvec2, 3> corners;
        glm::dvec2 lower, upper;
        std::uint32_t triangle;
        double doubleArea;
    };

    std::vector<Flat> flatten(std::span<const Candidate> plane) const {
        const glm::dvec3 normal = planeOf(cornersOf(plane[0].triangle)).normal;
        const glm::dvec3 u =
            glm::normalize(std::abs(normal.x) > 0.6 ? glm::cross(normal, glm::dvec3(0, 1, 0))
                                                    : glm::cross(normal, glm::dvec3(1, 0, 0)));
        const glm::dvec3 v = glm::cross(normal, u);
        std::vector<Flat> flat;
        for (const Candidate& candidate : plane) {
            Flat f;
            const Corners c = cornersOf(candidate.triangle);
            for (std::size_t k = 0; k < 3; ++k)
                f.corners[k] = {glm::dot(u, c[k]), glm::dot(v, c[k])};
            f.lower = glm::min(f.corners[0], glm::min(f.corners[1], f.corners[2]));
            f.upper = glm::max(f.corners[0], glm::max(f.corners[1], f.corners[2]));
            f.triangle = candidate.triangle;
            f.doubleArea = glm::length(glm::cross(c[1] - c[0], c[2] - c[0]));
            flat.push_back(f);
        }
        return flat;
    }

    /// Compares the triangles of one plane with each other; if there are many, only within the cells of a
    /// grid.
    void comparePlane(std::span<const Candidate> plane) {
        constexpr std::size_t kFew = 16;
        const std::vector<Flat> flat = flatten(plane);
        if (flat.size() <= kFew) {
            for (std::size_t i = 0; i < flat.size(); ++i)
                compareWith(flat[i], std::span(flat).subspan(i + 1));
            return;
        }
        double extent = 0.0;
        for (const Flat& f : flat)
            extent += glm::length(f.upper - f.lower);
        const double cell = extent / static_cast<double>(flat.size());
        struct Entry {
            std::int64_t x, y;
            std::uint32_t index;
            auto operator<=>(const Entry&) const = default;
        };
        std::vector<Entry> entries;
        std::vector<std::uint32_t> large;
        for (std::uint32_t i = 0; i < flat.size(); ++i) {
            const glm::i64vec2 first(glm::floor(flat[i].lower / cell)),
                last(glm::floor(flat[i].upper / cell));
            const glm::dvec2 sides = (flat[i].upper - flat[i].lower) / cell + 1.0;
            if (sides.x * sides.y > 64.0) {
                large.push_back(i);
                continue;
            }
            for (std::int64_t x = first.x; x <= last.x; ++x) {
                for (std::int64_t y = first.y; y <= last.y; ++y)
                    entries.push_back({x, y, i});
            }
        }
        std::sort(entries.begin(), entries.end());
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
        for (const std::uint32_t i : large)
            compareWith(flat[i], flat);
    }

    void compareWith(const Flat& one, std::span<const Flat> others) {
        for (const Flat& other : others) {
            if (other.triangle != one.triangle) compare(one, other);
        }
    }

    void compare(const Flat& a, const Flat& b) {
        if (glm::any(glm::lessThanEqual(glm::min(a.upper, b.upper), glm::max(a.lower, b.lower)))) return;
        if (!overlap(a, b) || rootOf(a.triangle) == rootOf(b.triangle)) return;
        const bool aLarger = a.doubleArea >= b.doubleArea;
        const Corners large = cornersOf((aLarger ? a : b).triangle),
                      small = cornersOf((aLarger ? b : a).triangle);
        const glm::dvec3 normal = glm::normalize(glm::cross(large[1] - large[0], large[2] - large[0]));
        constexpr double kRoundings = 8.0;
        for (const glm::dvec3& corner : small) {
            if (std::abs(glm::dot(normal, corner - large[0])) > kRoundings * rounding_) return;
        }
        any_ = true;
        const std::uint32_t rootA = rootOf(a.triangle), rootB = rootOf(b.triangle);
        parents_[std::max(rootA, rootB)] = std::min(rootA, rootB);
    }

    /// Separating axis test: whether no line through an edge separates the triangles. The tolerance excludes
    /// neighbours that overlap only through rounding.
    bool overlap(const Flat& a, const Flat& b) const {
        constexpr double kLeast = 1e-3;  // of the narrower one
        for (const Flat* edges : {&a, &b}) {
            for (std::size_t e = 0; e < 3; ++e) {
                const glm::dvec2 edge = edges->corners[(e + 1) % 3] - edges->corners[e];
                const glm::dvec2 across(-edge.y, edge.x);
                const auto range = [&](const Flat& f) {
                    const double x = glm::dot(across, f.corners[0]), y = glm::dot(across, f.corners[1]),
                                 z = glm::dot(across, f.corners[2]);
                    return glm::dvec2(std::min({x, y, z}), std::max({x, y, z}));
                };
                const glm::dvec2 ra = range(a), rb = range(b);
                const double common = std::min(ra.y, rb.y) - std::max(ra.x, rb.x);
                const double narrower = std::min(ra.y - ra.x, rb.y - rb.x);
                const double roundings = 8.0 * rounding_ * glm::length(edge);
                if (common <= std::max(kLeast * narrower, roundings)) return false;
            }
        }
        return true;
    }

    std::uint32_t rootOf(std::uint32_t triangle) {
        while (parents_[triangle] != triangle) {
            parents_[triangle] = parents_[parents_[triangle]];
            triangle = parents_[triangle];
        }
        return triangle;
    }

    /// The largest triangle of each group; the first of equally large ones.
    std::vector<std::uint32_t> representatives() {
        std::vector<std::uint32_t> largest(count_);
        std::iota(largest.begin(), largest.end(), 0u);
        std::vector<double> areas(count_, -1.0);
        for (std::uint32_t i = 0; i < count_; ++i) {
            const std::uint32_t root = rootOf(i);
            const double area = doubleArea(cornersOf(i));
            if (area <= areas[root]) continue;
            areas[root] = area;
            largest[root] = i;
        }
        std::vector<std::uint32_t> out(count_);
        for (std::uint32_t i = 0; i < count_; ++i)
            out[i] = largest[rootOf(i)];
        return out;
    }

    const Geometry& geometry_;
    std::size_t count_;
    glm::dvec3 centre_{0.0};
    double size_ = 0.0;
    double rounding_ = 0.0;  // rounding error of a coordinate
    std::vector<std::uint32_t> parents_;
    bool any_ = false;
};

}  // namespace

std::vector<std::uint32_t> coincidentGroups(const Geometry& geometry) {
    if (geometry.triangles.size() < 2) return {};
    return Finder(geometry).run();
}

}  // namespace duolux

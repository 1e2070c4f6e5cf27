#include "host/view/simplify.h"

#include <algorithm>
#include <optional>
#include <span>
#include <unordered_set>

#include "host/base/hash.h"
#include "host/base/parallel.h"
#include "host/scene/emitters.h"

namespace duolux {

namespace {

constexpr std::size_t kMostExact = 20'000;  // triangles
constexpr std::size_t kMostClustered = 150'000;
constexpr std::size_t kMostEmitters = 50'000;  // emitting triangles that are kept unchanged
constexpr std::uint32_t kNoCell = 0xffffffffu;

/// The bounds of some triangles without outliers, in the surface's coordinates.
struct Cube {
    glm::vec3 centre{0.0f};
    float halfSide = 1.0f;
};

Cube cubeAround(const Surface& surface, std::size_t firstTriangle, std::size_t endTriangle) {
    const Geometry& geometry = surface.scene().geometry;
    glm::vec3 lower(1e30f), upper(-1e30f);
    for (std::size_t i = firstTriangle; i < endTriangle; ++i) {
        if (i < surface.bulk().framed && !surface.isFramed(i)) continue;
        for (int k = 0; k < 3; ++k) {
            const glm::vec3 corner =
                surface.toLocal(glm::dvec3(geometry.positions[geometry.triangles[i][k]]));
            lower = glm::min(lower, corner);
            upper = glm::max(upper, corner);
        }
    }
    const glm::vec3 side = upper - lower;
    const float longest = std::max({side.x, side.y, side.z});
    return longest > 0.0f ? Cube{0.5f * (lower + upper), 0.5f * longest} : Cube{};
}

/// Groups vertices by the cells of a grid.
class Clusters {
  public:
    Clusters(const Surface& surface, const Cube& cube, std::uint32_t cellsAcross)
        : cube_(cube), across_(cellsAcross), cellOf_(surface.scene().geometry.positions.size()) {
        const std::vector<glm::vec3>& positions = surface.scene().geometry.positions;
        parallelFor(positions.size(), 1u << 14, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i)
                cellOf_[i] = cellAt(surface.toLocal(glm::dvec3(positions[i])));
        });
        std::vector<std::uint32_t> numbers(std::size_t{across_} * across_ * across_, kNoCell);
        std::vector<glm::vec3> sums;
        std::vector<std::uint32_t> counts;
        for (std::size_t i = 0; i < positions.size(); ++i) {
            if (cellOf_[i] == kNoCell) continue;
            std::uint32_t& number = numbers[cellOf_[i]];
            if (number == kNoCell) {
                number = static_cast<std::uint32_t>(sums.size());
                sums.emplace_back(0.0f);
                counts.push_back(0);
            }
            cellOf_[i] = number;
            sums[number] += surface.toLocal(glm::dvec3(positions[i]));
            ++counts[number];
        }
        for (std::size_t i = 0; i < sums.size(); ++i)
            sums[i] /= static_cast<float>(counts[i]);
        centres_ = std::move(sums);
    }

    std::uint32_t of(std::uint32_t position) const { return cellOf_[position]; }
    const glm::vec3& centre(std::uint32_t cluster) const { return centres_[cluster]; }

  private:
    std::uint32_t cellAt(const glm::vec3& local) const {
        const auto across = static_cast<float>(across_);
        const glm::vec3 cell = glm::floor(((local - cube_.centre) / cube_.halfSide * 0.5f + 0.5f) * across);
        // Unused vertices, and those of triangles in another grid, may be outside.
        if (!glm::all(glm::greaterThanEqual(cell, glm::vec3(-1.0f))) ||
            !glm::all(glm::lessThanEqual(cell, glm::vec3(across)))) {
            return kNoCell;
        }
        const glm::uvec3 c(glm::clamp(cell, 0.0f, across - 1.0f));
        return (c.x * across_ + c.y) * across_ + c.z;
    }

    Cube cube_;
    std::uint32_t across_;
    std::vector<std::uint32_t> cellOf_;  // of positions
    std::vector<glm::vec3> centres_;
};

struct HashTriple {
    std::size_t operator()(const glm::uvec3& t) const {
        return static_cast<std::size_t>(hashOf(std::as_bytes(std::span(&t, 1))));
    }
};

/// The same triangle, rotated so that its smallest index comes first.
glm::uvec3 inOrder(const glm::uvec3& t) {
    if (t.x < t.y && t.x < t.z) return t;
    return t.y < t.z ? glm::uvec3(t.y, t.z, t.x) : glm::uvec3(t.z, t.x, t.y);
}

class Simplifier {
  public:
    explicit Simplifier(const Surface& surface) : surface_(surface), framedTriangles_(surface.bulk().framed) {
        const Geometry& geometry = surface.scene().geometry;
        if (geometry.triangles.size() > kMostExact) {
            framed_ = cubeAround(surface, 0, framedTriangles_);
            others_ = cubeAround(surface, framedTriangles_, geometry.triangles.size());
            keepEmitters_ = emittingTriangles(surface.scene()).size() <= kMostEmitters;
        }
    }

    std::vector<Surface::Triangle> all() const {
        const std::size_t count = surface_.scene().geometry.triangles.size();
        std::vector<Surface::Triangle> triangles;
        triangles.reserve(count);
        for (std::size_t i = 0; i < count; ++i)
            addExact(triangles, i);
        return triangles;
    }

    /// Framed triangles and others have separate grids: distant lamps must not make the cells larger than the
    /// model.
    std::vector<Surface::Triangle> clustered(std::uint32_t cellsAcross) const {
        std::vector<Surface::Triangle> triangles;
        addClustered(triangles, framed_, cellsAcross, 0, framedTriangles_);
        // If all triangles are smaller than a cell and far apart, none remains: a few represent all of them.
        if (triangles.empty()) {
            for (std::size_t i = 0; i < framedTriangles_; i += framedTriangles_ / kMostExact + 1)
                addExact(triangles, i);
        }
        const std::size_t count = surface_.scene().geometry.triangles.size();
        if (framedTriangles_ < count) addClustered(triangles, others_, cellsAcross, framedTriangles_, count);
        return triangles;
    }

  private:
    void addClustered(std::vector<Surface::Triangle>& triangles, const Cube& cube, std::uint32_t cellsAcross,
                      std::size_t first, std::size_t end) const {
        const Scene& scene = surface_.scene();
        const Geometry& geometry = scene.geometry;
        std::optional<Clusters> clusters;
        std::unordered_set<glm::uvec3, HashTriple> seen;
        for (std::size_t i = first; i < end; ++i) {
            const glm::uvec3 t = geometry.triangles[i];
            if (keepEmitters_ && emits(scene, i)) {
                addExact(triangles, i);
                continue;
            }
            if (!clusters) clusters.emplace(surface_, cube, cellsAcross);
            const glm::uvec3 c(clusters->of(t.x), clusters->of(t.y), clusters->of(t.z));
            // Outliers have no cells.
            if (c.x == c.y || c.y == c.z || c.z == c.x || !seen.insert(inOrder(c)).second) continue;
            add(triangles, i, clusters->centre(c.x), clusters->centre(c.y), clusters->centre(c.z));
        }
    }

    void addExact(std::vector<Surface::Triangle>& triangles, std::size_t i) const {
        const Geometry& geometry = surface_.scene().geometry;
        const auto corner = [&](int k) {
            return surface_.toLocal(glm::dvec3(geometry.positions[geometry.triangles[i][k]]));
        };
        add(triangles, i, corner(0), corner(1), corner(2));
    }

    void add(std::vector<Surface::Triangle>& triangles, std::size_t i, const glm::vec3& a, const glm::vec3& b,
             const glm::vec3& c) const {
        triangles.push_back({a, b - a, c - a, surface_.scene().geometry.materials[i], surface_.isFramed(i)});
    }

    const Surface& surface_;
    std::size_t framedTriangles_;
    Cube framed_, others_;
    bool keepEmitters_ = true;
};

}  // namespace

std::vector<Surface::Triangle> simplifiedTriangles(const Surface& surface) {
    const Simplifier simplifier(surface);
    if (surface.scene().geometry.triangles.size() <= kMostExact) return simplifier.all();
    std::vector<Surface::Triangle> triangles;
    for (const std::uint32_t cellsAcross : {128u, 64u, 32u}) {
        triangles = simplifier.clustered(cellsAcross);
        if (triangles.size() <= kMostClustered) break;
    }
    return triangles;
}

}  // namespace duolux

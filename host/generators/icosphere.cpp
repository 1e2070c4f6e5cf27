#include "host/generators/icosphere.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <utility>

namespace duolux {

namespace {

const std::array<glm::dvec3, 12>& corners() {
    static const double kGolden = 0.5 * (1.0 + std::sqrt(5.0));
    static const std::array<glm::dvec3, 12> kCorners{{{-1, kGolden, 0},
                                                      {1, kGolden, 0},
                                                      {-1, -kGolden, 0},
                                                      {1, -kGolden, 0},
                                                      {0, -1, kGolden},
                                                      {0, 1, kGolden},
                                                      {0, -1, -kGolden},
                                                      {0, 1, -kGolden},
                                                      {kGolden, 0, -1},
                                                      {kGolden, 0, 1},
                                                      {-kGolden, 0, -1},
                                                      {-kGolden, 0, 1}}};
    return kCorners;
}

using Face = std::array<std::uint32_t, 3>;
constexpr std::array<Face, 20> kFaces{{{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
                                       {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                                       {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
                                       {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}}};

/// Numbers the vertices: first the corners, then the inner points of edges, then the inner points of faces.
class Subdivision {
  public:
    explicit Subdivision(std::uint32_t frequency) : n_(frequency) {
        for (auto& row : edgeStart_)
            row.fill(0);
        sphere_.positions.reserve(10 * std::size_t{n_} * n_ + 2);
        sphere_.triangles.reserve(20 * std::size_t{n_} * n_);
        for (const glm::dvec3& corner : corners())
            addPoint(corner);
        for (const Face& face : kFaces) {
            for (std::size_t i = 0; i < 3; ++i)
                addEdge(face[i], face[(i + 1) % 3]);
        }
        for (const Face& face : kFaces)
            addFace(face);
    }

    Icosphere result() { return std::move(sphere_); }

  private:
    std::uint32_t addPoint(const glm::dvec3& point) {
        sphere_.positions.push_back(glm::normalize(point));
        return static_cast<std::uint32_t>(sphere_.positions.size() - 1);
    }

    /// Created once for the two faces that share the edge, from the lower to the higher corner.
    void addEdge(std::uint32_t a, std::uint32_t b) {
        if (a > b) return;
        edgeStart_[a][b] = static_cast<std::uint32_t>(sphere_.positions.size());
        for (std::uint32_t i = 1; i < n_; ++i)
            addPoint(glm::mix(corners()[a], corners()[b], part(i)));
    }

    double part(std::uint32_t i) const { return static_cast<double>(i) / n_; }

    std::uint32_t onEdge(std::uint32_t a, std::uint32_t b, std::uint32_t i) const {
        if (i == 0) return a;
        if (i == n_) return b;
        return a < b ? edgeStart_[a][b] + i - 1 : edgeStart_[b][a] + n_ - i - 1;
    }

    /// Row by row, from the side ab towards c.
    void addFace(const Face& face) {
        const auto& [a, b, c] = face;
        std::vector<std::uint32_t> below(n_ + 1), row;
        for (std::uint32_t i = 0; i <= n_; ++i)
            below[i] = onEdge(a, b, i);
        for (std::uint32_t j = 1; j <= n_; ++j) {
            row.assign(n_ - j + 1, onEdge(a, c, j));
            row.back() = onEdge(b, c, j);
            for (std::uint32_t i = 1; i + j < n_; ++i) {
                row[i] = addPoint(corners()[a] + part(i) * (corners()[b] - corners()[a]) +
                                  part(j) * (corners()[c] - corners()[a]));
            }
            for (std::uint32_t i = 0; i < row.size(); ++i) {
                sphere_.triangles.emplace_back(below[i], below[i + 1], row[i]);
                if (i > 0) sphere_.triangles.emplace_back(row[i - 1], below[i], row[i]);
            }
            std::swap(below, row);
        }
    }

    std::uint32_t n_;
    std::array<std::array<std::uint32_t, 12>, 12> edgeStart_;
    Icosphere sphere_;
};

}  // namespace

Icosphere makeIcosphere(std::uint32_t frequency) {
    assert(frequency >= 1);
    return Subdivision(frequency).result();
}

}  // namespace duolux

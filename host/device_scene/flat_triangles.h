#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace duolux {

/// A triangle in the coordinates of a plane that it nearly lies in.
struct FlatTriangle {
    std::array<glm::dvec2, 3> corners;
    glm::dvec2 lower, upper;
    double lowest, highest;  ///< above the plane
    std::uint32_t triangle;
    double doubleArea;
};

/// Disjoint sets of the numbers below a count.
class DisjointSets {
  public:
    explicit DisjointSets(std::size_t count);

    /// The smallest number of the set.
    std::uint32_t rootOf(std::uint32_t number);
    void unite(std::uint32_t a, std::uint32_t b);

  private:
    std::vector<std::uint32_t> parents_;
};

/// Calls `compare` for pairs of triangles in different sets, among them all that overlap: one would have to
/// move by more than `tolerance` in the plane to be beside the other, and their heights differ by less than
/// `most`. `compare` may unite sets. Of n triangles, about n log n pairs are compared if few overlap, or if
/// those that overlap are united.
void compareOverlapping(std::span<const FlatTriangle> triangles, double tolerance, double most,
                        DisjointSets& sets,
                        const std::function<void(const FlatTriangle&, const FlatTriangle&)>& compare);

}  // namespace duolux

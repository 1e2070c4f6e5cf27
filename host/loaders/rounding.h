#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <span>
#include <string>
#include <vector>

namespace duolux {

/// Polygons with at least three corners each: the vertices of their corners, one polygon after the other.
struct PolygonView {
    std::span<const std::uint32_t> ends;      ///< per polygon: index past its last corner
    std::span<const std::uint32_t> vertices;  ///< per corner
};

/// The effect of rounding to floats on the vertices that polygons use.
struct RoundingLoss {
    std::size_t vertices = 0;  ///< number of vertices moved by more than kUnnoticed of a typical edge
    double largest = 0.0;      ///< the largest distance
    double typicalEdge = 0.0;
};

struct RoundedPositions {
    std::vector<glm::vec3> positions;  ///< relative to `origin`
    glm::dvec3 origin{0.0};            ///< see originFor
    RoundingLoss loss;
    bool inRange = true;  ///< whether no coordinate exceeds kLargestCoordinate
};

/// Converts positions to floats relative to an origin that suits the polygons. All values are finite.
RoundedPositions roundPositions(const std::vector<glm::dvec3>& values, std::span<const PolygonView> polygons);

/// For each vertex, whether a polygon uses it.
std::vector<bool> usedVertices(std::size_t vertexCount, std::span<const PolygonView> polygons);

/// Adds a warning if rounding moves vertices noticeably.
void warnOfLoss(const std::filesystem::path& path, const RoundingLoss& loss,
                std::vector<std::string>& warnings);

}  // namespace duolux

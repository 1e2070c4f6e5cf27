#include "host/loaders/rounding.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "host/scene/mesh.h"
#include "host/scene/origin.h"

namespace duolux {

namespace {

/// Bounds of the vertices that polygons use, or of some of them if these are already so far apart that no
/// origin is needed.
WideBounds usedBounds(const std::vector<glm::dvec3>& values, std::span<const PolygonView> polygons,
                      const WideBounds& all) {
    WideBounds bounds;
    for (const PolygonView& part : polygons) {
        for (const std::uint32_t vertex : part.vertices) {
            bounds.add(values[vertex]);
            if (kFarAway * bounds.extent() >= all.reach()) return bounds;
        }
    }
    return bounds;
}

/// The median length over two edges of each of many polygons.
double typicalEdge(const std::vector<glm::dvec3>& values, std::span<const PolygonView> polygons) {
    constexpr std::size_t kMost = 4096;
    std::size_t count = 0;
    for (const PolygonView& part : polygons)
        count += part.ends.size();
    std::vector<double> lengths;
    for (const PolygonView& part : polygons) {
        for (std::size_t polygon = 0; polygon < part.ends.size(); polygon += count / kMost + 1) {
            const std::uint32_t* corner = &part.vertices[part.ends[polygon] - 3];
            for (int i = 0; i < 2; ++i)
                lengths.push_back(glm::distance(values[corner[i]], values[corner[i + 1]]));
        }
    }
    return medianOf(std::move(lengths));
}

std::vector<OriginSample> samplesOf(const std::vector<glm::dvec3>& values,
                                    std::span<const PolygonView> polygons, double tolerance) {
    constexpr std::size_t kMost = 1u << 16;
    std::size_t corners = 0;
    for (const PolygonView& part : polygons)
        corners += part.vertices.size();
    std::vector<OriginSample> samples;
    for (const PolygonView& part : polygons) {
        for (std::size_t i = 0; i < part.vertices.size(); i += corners / kMost + 1)
            samples.push_back({values[part.vertices[i]], tolerance});
    }
    return samples;
}

RoundingLoss lossOf(const std::vector<glm::dvec3>& values, std::span<const PolygonView> polygons,
                    const glm::dvec3& origin, double tolerance) {
    const std::vector<bool> used = usedVertices(values.size(), polygons);
    RoundingLoss loss;
    loss.typicalEdge = tolerance / kUnnoticed;
    for (std::size_t i = 0; i < values.size(); ++i) {
        const double error = used[i] ? roundingError(values[i] - origin) : 0.0;
        loss.vertices += error > tolerance ? 1 : 0;
        loss.largest = std::max(loss.largest, error);
    }
    return loss;
}

}  // namespace

std::vector<bool> usedVertices(std::size_t vertexCount, std::span<const PolygonView> polygons) {
    std::vector<bool> used(vertexCount, false);
    for (const PolygonView& part : polygons) {
        for (const std::uint32_t vertex : part.vertices)
            used[vertex] = true;
    }
    return used;
}

RoundedPositions roundPositions(const std::vector<glm::dvec3>& values,
                                std::span<const PolygonView> polygons) {
    const double tolerance = kUnnoticed * typicalEdge(values, polygons);
    WideBounds all;
    for (const glm::dvec3& value : values)
        all.add(value);
    const WideBounds bounds = usedBounds(values, polygons, all);
    const bool mayLose = !all.empty() && largestRoundingError(all.reach()) > tolerance;
    RoundedPositions result;
    result.origin = mayLose ? originFor(bounds, samplesOf(values, polygons, tolerance)) : originFor(bounds);
    result.positions.resize(values.size());
    const auto largest = static_cast<double>(kLargestCoordinate);
    for (std::size_t i = 0; i < values.size(); ++i) {
        const glm::dvec3 position = values[i] - result.origin;
        result.inRange =
            result.inRange && glm::all(glm::lessThanEqual(glm::abs(position), glm::dvec3(largest)));
        result.positions[i] = glm::vec3(position);
    }
    if (mayLose) result.loss = lossOf(values, polygons, result.origin, tolerance);
    return result;
}

void warnOfLoss(const std::filesystem::path& path, const RoundingLoss& loss,
                std::vector<std::string>& warnings) {
    if (loss.vertices == 0) return;
    warnings.push_back(fmt::format(
        "{}: single precision moves {} vert{} by up to {:.2g}; typical edges are {:.2g} long", path.string(),
        loss.vertices, loss.vertices == 1 ? "ex" : "ices", loss.largest, loss.typicalEdge));
}

}  // namespace duolux

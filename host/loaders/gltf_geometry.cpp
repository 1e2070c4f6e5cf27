#include "host/loaders/gltf_geometry.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>

#include "host/loaders/rounding.h"

namespace duolux {

namespace {

/// The matrix that transforms normals, up to a positive factor. It need not be regular.
glm::dmat3 normalMatrixOf(const glm::dmat3& m) {
    const glm::dmat3 cofactors(glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1]));
    return glm::dot(m[0], cofactors[0]) < 0.0 ? -cofactors : cofactors;
}

/// The unit vector; 0 if there is none.
glm::vec3 unitOf(const glm::dvec3& v) {
    // Lengths that overflow or vanish become finite first.
    const double largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
    if (!(largest > 0.0) || !std::isfinite(largest)) return glm::vec3(0.0f);
    return glm::vec3(glm::normalize(v / largest));
}

/// The mean of the matrices of the joints that move a vertex; empty if none does.
std::optional<glm::dmat4> blendJoints(const GltfPrimitive& primitive, std::size_t vertex,
                                      const GltfPlacement& placement) {
    glm::dmat4 sum(0.0);
    double weights = 0.0;
    for (const auto* influences : {&primitive.influences, &primitive.moreInfluences}) {
        if (influences->empty()) continue;
        const auto& [joints, jointWeights] = (*influences)[vertex];
        for (int i = 0; i < 4; ++i) {
            if (jointWeights[i] <= 0.0f) continue;
            if (joints[i] >= placement.joints.size()) {
                placement.node.fail(
                    fmt::format("a vertex follows joint {}", joints[i]),
                    fmt::format("expected joints below {}, the number in the skin", placement.joints.size()));
            }
            sum += static_cast<double>(jointWeights[i]) * placement.joints[joints[i]];
            weights += static_cast<double>(jointWeights[i]);
        }
    }
    if (weights <= 0.0) return std::nullopt;
    return sum / weights;
}

/// Pads an array with a value for items that were added without one.
template <typename Item>
void pad(std::vector<Item>& items, std::size_t count, const Item& value) {
    items.resize(std::max(items.size(), count), value);
}

}  // namespace

GltfGeometry::Shape GltfGeometry::shapeOf(const GltfPrimitive& primitive, const GltfPlacement& placement) {
    Shape shape{{primitive.positions.begin(), primitive.positions.end()},
                {primitive.normals.begin(), primitive.normals.end()},
                {primitive.tangents.begin(), primitive.tangents.end()}};
    const auto bend = [](std::vector<glm::dvec3>& items, const std::vector<glm::vec3>& differences,
                         double weight) {
        for (std::size_t i = 0; i < std::min(items.size(), differences.size()); ++i)
            items[i] += weight * glm::dvec3(differences[i]);
    };
    for (std::size_t i = 0; i < std::min(primitive.targets.size(), placement.weights.size()); ++i) {
        const double weight = placement.weights[i];
        if (weight == 0.0) continue;
        bend(shape.positions, primitive.targets[i].positions, weight);
        bend(shape.normals, primitive.targets[i].normals, weight);
        bend(shape.tangents, primitive.targets[i].tangents, weight);
    }
    return shape;
}

void GltfGeometry::add(const GltfPrimitive& primitive, std::uint32_t material,
                       const GltfPlacement& placement) {
    constexpr std::size_t kMost = std::numeric_limits<std::int32_t>::max();
    if (positions_.size() + primitive.positions.size() > kMost ||
        geometry_.triangles.size() + primitive.triangles.size() > kMost) {
        placement.node.fail("the scene becomes too large here",
                            "expected fewer than 2^31 triangles and vertices");
    }
    starts_.emplace_back(positions_.size(), placement.node);
    addUvs(primitive);
    addColours(primitive);
    addVertices(primitive, placement);
    addTriangles(primitive, material);
}

void GltfGeometry::addVertices(const GltfPrimitive& primitive, const GltfPlacement& placement) {
    const Shape shape = shapeOf(primitive, placement);
    const bool isSkinned = !placement.joints.empty() && !primitive.influences.empty();
    const std::size_t count = shape.positions.size();
    mirrored_.assign(count, glm::determinant(glm::dmat3(placement.world)) < 0.0);
    glm::dmat4 matrix = placement.world;
    glm::dmat3 normalMatrix = normalMatrixOf(glm::dmat3(matrix));
    for (std::size_t i = 0; i < count; ++i) {
        if (isSkinned) {
            matrix = blendJoints(primitive, i, placement).value_or(placement.world);
            normalMatrix = normalMatrixOf(glm::dmat3(matrix));
            mirrored_[i] = glm::determinant(glm::dmat3(matrix)) < 0.0;
        }
        const glm::dvec3 position(matrix * glm::dvec4(shape.positions[i], 1.0));
        // Also false for what is not a number.
        if (!glm::all(glm::lessThanEqual(glm::abs(position), glm::dvec3(kFarthestPlace)))) {
            placement.node.fail(
                "a vertex is too far away",
                fmt::format("expected coordinates of at most {:g} in magnitude", kFarthestPlace));
        }
        positions_.push_back(position);
        if (!shape.normals.empty()) geometry_.normals.push_back(unitOf(normalMatrix * shape.normals[i]));
        if (!shape.tangents.empty()) {
            const float sign = primitive.tangents[i].w * (mirrored_[i] ? -1.0f : 1.0f);
            const glm::vec3 tangent = unitOf(glm::dmat3(matrix) * shape.tangents[i]);
            geometry_.tangents.emplace_back(tangent, tangent == glm::vec3(0.0f) ? 0.0f : sign);
        }
    }
}

/// To be called before the positions are added.
void GltfGeometry::addColours(const GltfPrimitive& primitive) {
    const auto append = [&](auto& items, const auto& added, const auto& value) {
        if (added.empty()) return;
        pad(items, positions_.size(), value);
        items.insert(items.end(), added.begin(), added.end());
    };
    append(geometry_.colours, primitive.colours, glm::vec3(1.0f));
    append(geometry_.alphas, primitive.alphas, 1.0f);
}

/// To be called before the tangents are added.
void GltfGeometry::addUvs(const GltfPrimitive& primitive) {
    if (primitive.uvs.empty() && primitive.secondUvs.empty() && primitive.tangents.empty()) return;
    const std::size_t present = geometry_.uvs.size(), count = present + primitive.positions.size();
    const auto append = [&](std::vector<glm::vec2>& uvs, const std::vector<glm::vec2>& added) {
        pad(uvs, present, glm::vec2(0.0f));
        uvs.insert(uvs.end(), added.begin(), added.end());
        pad(uvs, count, glm::vec2(0.0f));
    };
    append(geometry_.uvs, primitive.uvs);
    if (!primitive.secondUvs.empty()) append(geometry_.secondUvs, primitive.secondUvs);
    if (!primitive.tangents.empty()) pad(geometry_.tangents, present, glm::vec4(0.0f));
}

/// To be called last.
void GltfGeometry::addTriangles(const GltfPrimitive& primitive, std::uint32_t material) {
    const std::size_t vertices = primitive.positions.size();
    const auto first = [&](std::size_t end) { return static_cast<std::uint32_t>(end - vertices); };
    const bool hasUvs = !primitive.uvs.empty() || !primitive.secondUvs.empty() || !primitive.tangents.empty();
    const bool hasNormals = !primitive.normals.empty();
    const std::uint32_t firstPosition = first(positions_.size());
    const std::uint32_t firstNormal = hasNormals ? first(geometry_.normals.size()) : 0;
    const std::uint32_t firstUv = hasUvs ? first(geometry_.uvs.size()) : 0;
    const auto isFlat = [&](const glm::uvec3& corners) {
        const auto isZero = [&](std::uint32_t corner) {
            return geometry_.normals[firstNormal + corner] == glm::vec3(0.0f);
        };
        return !hasNormals || isZero(corners.x) || isZero(corners.y) || isZero(corners.z);
    };
    if (hasUvs) pad(geometry_.uvIndices, geometry_.triangles.size(), glm::uvec3(Geometry::kNoUv));
    if (hasNormals) pad(geometry_.normalIndices, geometry_.triangles.size(), glm::uvec3(Geometry::kNoNormal));
    for (glm::uvec3 corners : primitive.triangles) {
        if (mirrored_[corners.x]) std::swap(corners.y, corners.z);
        geometry_.triangles.push_back(corners + firstPosition);
        if (hasUvs) geometry_.uvIndices.push_back(corners + firstUv);
        if (hasNormals) {
            geometry_.normalIndices.push_back(isFlat(corners) ? glm::uvec3(Geometry::kNoNormal)
                                                              : corners + firstNormal);
        }
    }
    geometry_.materials.resize(geometry_.triangles.size(), material);
}

void GltfGeometry::moveTo(Mesh& mesh) {
    const std::size_t triangles = geometry_.triangles.size();
    const auto padUsed = [](auto& items, std::size_t count, const auto& value) {
        if (!items.empty()) pad(items, count, value);
    };
    padUsed(geometry_.colours, positions_.size(), glm::vec3(1.0f));
    padUsed(geometry_.alphas, positions_.size(), 1.0f);
    padUsed(geometry_.secondUvs, geometry_.uvs.size(), glm::vec2(0.0f));
    padUsed(geometry_.tangents, geometry_.uvs.size(), glm::vec4(0.0f));
    padUsed(geometry_.uvIndices, triangles, glm::uvec3(Geometry::kNoUv));
    padUsed(geometry_.normalIndices, triangles, glm::uvec3(Geometry::kNoNormal));
    std::vector<std::uint32_t> ends(triangles), corners;
    corners.reserve(3 * triangles);
    for (std::size_t i = 0; i < triangles; ++i) {
        ends[i] = static_cast<std::uint32_t>(3 * (i + 1));
        for (int corner = 0; corner < 3; ++corner)
            corners.push_back(geometry_.triangles[i][corner]);
    }
    const std::array<PolygonView, 1> polygons{{{ends, corners}}};
    RoundedPositions rounded = roundPositions(positions_, polygons);
    if (!rounded.inRange) failRange(rounded.positions);
    warnOfLoss(mesh.source, rounded.loss, mesh.warnings);
    mesh.geometry = std::move(geometry_);
    mesh.geometry.positions = std::move(rounded.positions);
    mesh.origin = rounded.origin;
}

void GltfGeometry::failRange(const std::vector<glm::vec3>& rounded) const {
    const auto bad = std::find_if(rounded.begin(), rounded.end(), [](const glm::vec3& position) {
        return !glm::all(glm::lessThanEqual(glm::abs(position), glm::vec3(kLargestCoordinate)));
    });
    const auto vertex = static_cast<std::size_t>(bad - rounded.begin());
    const auto next = std::upper_bound(starts_.begin(), starts_.end(), vertex,
                                       [](std::size_t at, const auto& start) { return at < start.first; });
    std::prev(next)->second.fail(
        "a vertex is too far away",
        fmt::format("expected coordinates of at most {:g} in magnitude", kLargestCoordinate));
}

}  // namespace duolux

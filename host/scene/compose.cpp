#include "host/scene/compose.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "host/base/error.h"

namespace duolux {

namespace {

bool sameEmission(const Emission& a, const Emission& b) {
    return a.invisible == b.invisible && a.visible == b.visible && a.sides == b.sides;
}

bool sameMaterial(const Material& a, const Material& b) {
    return a.name == b.name && a.diffuse == b.diffuse && a.sides == b.sides &&
           sameEmission(a.emission, b.emission) && a.reflectance == b.reflectance;
}

std::uint32_t addMaterial(Scene& scene, const Material& material) {
    const auto same = std::find_if(scene.materials.begin(), scene.materials.end(),
                                   [&](const Material& other) { return sameMaterial(material, other); });
    const auto index = static_cast<std::uint32_t>(same - scene.materials.begin());
    if (same == scene.materials.end()) scene.materials.push_back(material);
    return index;
}

void appendGeometry(Geometry& to, Geometry from) {
    if (to.triangles.empty()) {
        to = std::move(from);
        return;
    }
    const auto firstPosition = static_cast<std::uint32_t>(to.positions.size());
    const auto firstNormal = static_cast<std::uint32_t>(to.normals.size());
    if (!to.normals.empty() || !from.normals.empty()) {
        to.normalIndices.resize(to.triangles.size(), glm::uvec3(Geometry::kNoNormal));
        from.normalIndices.resize(from.triangles.size(), glm::uvec3(Geometry::kNoNormal));
    }
    to.positions.insert(to.positions.end(), from.positions.begin(), from.positions.end());
    to.normals.insert(to.normals.end(), from.normals.begin(), from.normals.end());
    to.materials.insert(to.materials.end(), from.materials.begin(), from.materials.end());
    to.triangles.reserve(to.triangles.size() + from.triangles.size());
    for (const glm::uvec3& triangle : from.triangles)
        to.triangles.push_back(triangle + firstPosition);
    for (const glm::uvec3& indices : from.normalIndices) {
        to.normalIndices.push_back(indices.x == Geometry::kNoNormal ? indices : indices + firstNormal);
    }
}

}  // namespace

bool isRegular(const glm::dmat3& matrix) {
    const double lengths = glm::length(matrix[0]) * glm::length(matrix[1]) * glm::length(matrix[2]);
    // Also false where the product overflows or is 0.
    return std::isfinite(lengths) && std::abs(glm::determinant(matrix)) > 1e-9 * lengths;
}

bool transformGeometry(Geometry& geometry, const glm::dmat4& transform) {
    const glm::dmat3 linear(transform);
    const glm::dmat3 normalMatrix = glm::transpose(glm::inverse(linear));
    bool inRange = true;
    for (glm::vec3& position : geometry.positions) {
        const glm::dvec3 world(transform * glm::dvec4(glm::dvec3(position), 1.0));
        inRange = inRange && glm::all(glm::lessThanEqual(
                                 glm::abs(world), glm::dvec3(static_cast<double>(kLargestCoordinate))));
        position = glm::vec3(world);
    }
    for (glm::vec3& normal : geometry.normals) {
        const glm::dvec3 world = normalMatrix * glm::dvec3(normal);
        const double length = glm::length(world);
        normal = length > 0.0 ? glm::vec3(world / length) : glm::vec3(0.0f);
    }
    if (glm::determinant(linear) < 0.0) {
        for (glm::uvec3& triangle : geometry.triangles)
            std::swap(triangle.y, triangle.z);
        for (glm::uvec3& indices : geometry.normalIndices) {
            if (indices.x != Geometry::kNoNormal) std::swap(indices.y, indices.z);
        }
    }
    return inRange;
}

void appendMesh(Scene& scene, Mesh mesh) {
    constexpr std::size_t kMost = std::numeric_limits<std::int32_t>::max();
    if (scene.geometry.triangles.size() + mesh.geometry.triangles.size() > kMost ||
        scene.geometry.positions.size() + mesh.geometry.positions.size() > kMost) {
        throw InputError(scene.source.string(), "", "is too large",
                         "expected fewer than 2^31 triangles and vertices");
    }
    const std::size_t all = mesh.geometry.triangles.size();
    if (const std::size_t dropped = dropDegenerateTriangles(mesh.geometry); dropped > 0) {
        mesh.warnings.push_back(
            fmt::format("{}: {} of {} triangles left out: zero area", mesh.source.string(), dropped, all));
    }
    std::vector<std::uint32_t> indices;
    for (const Material& material : mesh.materials)
        indices.push_back(addMaterial(scene, material));
    for (std::uint32_t& material : mesh.geometry.materials)
        material = indices[material];
    appendGeometry(scene.geometry, std::move(mesh.geometry));
    scene.meshBytes += mesh.bytes;
    scene.files.insert(scene.files.end(), mesh.files.begin(), mesh.files.end());
    for (std::string& warning : mesh.warnings)
        scene.warnings.push_back(std::move(warning));
}

void appendRectangle(Scene& scene, const Rectangle& rectangle, const Material& material) {
    Mesh mesh;
    mesh.source = scene.source;
    const auto& [origin, edge1, edge2] = rectangle;
    mesh.geometry.positions = {origin, origin + edge1, origin + edge1 + edge2, origin + edge2};
    mesh.geometry.triangles = {glm::uvec3(0, 1, 2), glm::uvec3(0, 2, 3)};
    mesh.geometry.materials = {0, 0};
    mesh.materials = {material};
    appendMesh(scene, std::move(mesh));
}

std::size_t dropDegenerateTriangles(Geometry& geometry) {
    constexpr double kThinnest = 1e-7;       // height over length: the precision of a float
    constexpr double kSmallestArea = 1e-18;  // whose square is still a normal float
    const auto& positions = geometry.positions;
    std::size_t kept = 0;
    for (std::size_t i = 0; i < geometry.triangles.size(); ++i) {
        const glm::uvec3 triangle = geometry.triangles[i];
        const glm::dvec3 edge1 = glm::dvec3(positions[triangle.y]) - glm::dvec3(positions[triangle.x]);
        const glm::dvec3 edge2 = glm::dvec3(positions[triangle.z]) - glm::dvec3(positions[triangle.x]);
        const glm::dvec3 edge3 = edge2 - edge1;
        const double longest =
            std::max({glm::dot(edge1, edge1), glm::dot(edge2, edge2), glm::dot(edge3, edge3)});
        const double area = glm::length(glm::cross(edge1, edge2));
        if (area <= std::max(kThinnest * longest, kSmallestArea)) continue;
        geometry.triangles[kept] = triangle;
        geometry.materials[kept] = geometry.materials[i];
        if (!geometry.normalIndices.empty()) geometry.normalIndices[kept] = geometry.normalIndices[i];
        ++kept;
    }
    const std::size_t dropped = geometry.triangles.size() - kept;
    geometry.triangles.resize(kept);
    geometry.materials.resize(kept);
    if (!geometry.normalIndices.empty()) geometry.normalIndices.resize(kept);
    return dropped;
}

}  // namespace duolux

#include "host/scene/compose.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <limits>
#include <type_traits>
#include <utility>
#include <vector>

#include "host/base/error.h"
#include "host/scene/fields.h"

namespace duolux {

namespace {

/// The items of an array that is appended to others; its indices are of items that `first` others precede.
template <typename Item>
void shift(std::vector<Item>& items, const GeometryField<Item>& field, std::uint32_t first) {
    if constexpr (std::is_same_v<Item, glm::uvec3>) {
        for (glm::uvec3& item : items) {
            if (!field.absent || item.x != field.absent->x) item += first;
        }
    }
}

void appendGeometry(Geometry& to, Geometry from) {
    if (to.triangles.empty()) {
        to = std::move(from);
        return;
    }
    const GeometryCounts present(to), added(from);
    forEachGeometryField([&](const auto& field) {
        auto& items = to.*field.array;
        auto& others = from.*field.array;
        if (field.absent) {
            if (items.empty() && others.empty()) return;
            items.resize(present.of(field.per), *field.absent);
            others.resize(added.of(field.per), *field.absent);
        }
        if (field.indexes) shift(others, field, static_cast<std::uint32_t>(present.of(*field.indexes)));
        items.insert(items.end(), others.begin(), others.end());
    });
}

}  // namespace

bool isRegular(const glm::dmat3& matrix) {
    const double lengths = glm::length(matrix[0]) * glm::length(matrix[1]) * glm::length(matrix[2]);
    // Also false where the product overflows or is 0.
    return std::isfinite(lengths) && std::abs(glm::determinant(matrix)) > 1e-9 * lengths;
}

bool transformGeometry(Geometry& geometry, const glm::dmat4& transform, double* roundingError) {
    const glm::dmat3 linear(transform);
    const glm::dmat3 normalMatrix = glm::transpose(glm::inverse(linear));
    bool inRange = true;
    glm::dvec3 error(0.0);
    for (glm::vec3& position : geometry.positions) {
        const glm::dvec3 world(transform * glm::dvec4(glm::dvec3(position), 1.0));
        inRange = inRange && glm::all(glm::lessThanEqual(
                                 glm::abs(world), glm::dvec3(static_cast<double>(kLargestCoordinate))));
        position = glm::vec3(world);
        error = glm::max(error, glm::abs(world - glm::dvec3(position)));
    }
    if (roundingError != nullptr) *roundingError = std::max({error.x, error.y, error.z});
    for (glm::vec3& normal : geometry.normals) {
        const glm::dvec3 world = normalMatrix * glm::dvec3(normal);
        const double length = glm::length(world);
        normal = length > 0.0 ? glm::vec3(world / length) : glm::vec3(0.0f);
    }
    const bool mirrors = glm::determinant(linear) < 0.0;
    for (glm::vec4& tangent : geometry.tangents) {
        const glm::dvec3 world = linear * glm::dvec3(tangent);
        const double length = glm::length(world);
        tangent =
            length > 0.0 ? glm::vec4(world / length, mirrors ? -tangent.w : tangent.w) : glm::vec4(0.0f);
    }
    if (mirrors) {
        forEachField(geometry, []<typename Item>(const GeometryField<Item>& field, std::vector<Item>& items) {
            if constexpr (std::is_same_v<Item, glm::uvec3>) {
                if (!field.indexes) return;
                for (glm::uvec3& indices : items)
                    std::swap(indices.y, indices.z);
            }
        });
    }
    return inRange;
}

bool placeMesh(Mesh& mesh, const glm::dmat4& transform, const glm::dvec3& sceneOrigin,
               double* roundingError) {
    bool inRange = true;
    for (PlacedPointEmitter& emitter : mesh.pointEmitters) {
        emitter.position = glm::dvec3(transform * glm::dvec4(emitter.position, 1.0));
        inRange =
            inRange && glm::all(glm::lessThanEqual(glm::abs(emitter.position - sceneOrigin),
                                                   glm::dvec3(static_cast<double>(kLargestCoordinate))));
    }
    glm::dmat4 local = transform;
    local[3] = transform * glm::dvec4(mesh.origin, 1.0) - glm::dvec4(sceneOrigin, 0.0);
    mesh.origin = sceneOrigin;
    return (local == glm::dmat4(1.0) || transformGeometry(mesh.geometry, local, roundingError)) && inRange;
}

Composer::Composer(LoadedScene& scene) : scene_(scene) {
    for (std::size_t i = 0; i < scene.materials.size(); ++i)
        materials_.try_emplace(scene.materials[i], static_cast<std::uint32_t>(i));
    for (std::size_t i = 0; i < scene.imageSources.size(); ++i)
        images_.try_emplace(scene.imageSources[i].identity(), static_cast<std::uint32_t>(i));
}

std::uint32_t Composer::indexOf(const ImageSource& image) {
    const auto next = static_cast<std::uint32_t>(scene_.imageSources.size());
    const auto [entry, isNew] = images_.try_emplace(image.identity(), next);
    if (isNew) scene_.imageSources.push_back(image);
    return entry->second;
}

std::uint32_t Composer::indexOf(const Material& material) {
    const auto next = static_cast<std::uint32_t>(scene_.materials.size());
    const auto [entry, isNew] = materials_.try_emplace(material, next);
    if (isNew) scene_.materials.push_back(material);
    return entry->second;
}

void Composer::append(Mesh mesh) {
    assert(mesh.origin == scene_.origin);
    constexpr std::size_t kMost = std::numeric_limits<std::int32_t>::max();
    if (scene_.geometry.triangles.size() + mesh.geometry.triangles.size() > kMost ||
        scene_.geometry.positions.size() + mesh.geometry.positions.size() > kMost) {
        throw InputError(scene_.source.string(), "", "is too large",
                         "expected fewer than 2^31 triangles and vertices");
    }
    const std::size_t all = mesh.geometry.triangles.size();
    if (const std::size_t dropped = dropDegenerateTriangles(mesh.geometry); dropped > 0) {
        LeftOut& leftOut = leftOut_[mesh.source];
        leftOut.dropped += dropped;
        leftOut.all += all;
    }
    std::vector<std::uint32_t> images, indices;
    for (const ImageSource& image : mesh.images)
        images.push_back(indexOf(image));
    for (Material& material : mesh.materials) {
        for (MaterialTexture& entry : material.textures)
            entry.texture.image = images[entry.texture.image];
        indices.push_back(indexOf(material));
    }
    for (std::uint32_t& material : mesh.geometry.materials)
        material = indices[material];
    appendGeometry(scene_.geometry, std::move(mesh.geometry));
    for (const auto& [position, invisible, visible] : mesh.pointEmitters)
        scene_.pointEmitters.push_back({glm::vec3(position - scene_.origin), invisible, visible});
    scene_.meshBytes += mesh.bytes;
    scene_.files.insert(scene_.files.end(), mesh.files.begin(), mesh.files.end());
    for (std::string& warning : mesh.warnings)
        scene_.warnings.emplace_back(std::move(warning));
}

void Composer::append(const Rectangle& rectangle, const Material& material) {
    Mesh mesh;
    mesh.source = scene_.source;
    mesh.origin = scene_.origin;
    const auto& [origin, edge1, edge2] = rectangle;
    mesh.geometry.positions = {origin, origin + edge1, origin + edge1 + edge2, origin + edge2};
    mesh.geometry.triangles = {glm::uvec3(0, 1, 2), glm::uvec3(0, 2, 3)};
    mesh.geometry.materials = {0, 0};
    mesh.materials = {material};
    append(std::move(mesh));
}

void Composer::finish() {
    for (const auto& [source, leftOut] : leftOut_) {
        scene_.warnings.push_back(fmt::format("{}: {} of {} triangles left out: zero area", source.string(),
                                              leftOut.dropped, leftOut.all));
    }
    leftOut_.clear();
}

void appendMesh(LoadedScene& scene, Mesh mesh) {
    Composer composer(scene);
    composer.append(std::move(mesh));
    composer.finish();
}

void appendRectangle(LoadedScene& scene, const Rectangle& rectangle, const Material& material) {
    Composer composer(scene);
    composer.append(rectangle, material);
    composer.finish();
}

void setOrigin(LoadedScene& scene, const glm::dvec3& origin) {
    scene.origin = origin;
    if (origin == glm::dvec3(0.0)) return;
    scene.warnings.push_back(
        fmt::format("{}: coordinates are far from the origin for their extent: they are used less {}, {}, {}",
                    scene.source.string(), origin.x, origin.y, origin.z));
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
        forEachField(geometry, [&](const auto& field, auto& items) {
            if (field.per == Per::kTriangle && !items.empty()) items[kept] = items[i];
        });
        ++kept;
    }
    const std::size_t dropped = geometry.triangles.size() - kept;
    forEachField(geometry, [&](const auto& field, auto& items) {
        if (field.per == Per::kTriangle && !items.empty()) items.resize(kept);
    });
    return dropped;
}

}  // namespace duolux

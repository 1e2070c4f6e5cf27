#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <tuple>
#include <type_traits>
#include <vector>

#include "host/scene/scene.h"

namespace duolux {

// Lists of the fields of a scene's parts; that of Material is in host/scene/material.h. What hashes, copies,
// checks or shows a part goes by its list. A field that is missing here does not compile.

/// `T` with or without const.
template <typename Object, typename T>
concept Either = std::same_as<std::remove_const_t<Object>, T>;

/// Calls visit(name, field) for every field that a camera of this type uses, in the order that people read.
template <Either<Camera> Object, typename Visit>
void forEachField(Object& camera, Visit&& visit) {
    auto& [position, target, up, vfov, type, height] = camera;
    visit("position", position);
    visit("target", target);
    visit("up", up);
    visit("type", type);
    switch (camera.type) {
        case CameraType::kPerspective:
            visit("vfov", vfov);
            break;
        case CameraType::kOrthographic:
            visit("height", height);
            break;
    }
}

/// Calls visit(name, field) for every field of a point emitter.
template <Either<PointEmitter> Object, typename Visit>
void forEachField(Object& emitter, Visit&& visit) {
    auto& [position, invisible, visible] = emitter;
    visit("position", position);
    visit("invisible", invisible);
    visit("visible", visible);
}

/// What the arrays of a Geometry hold an item for.
enum class Per : std::uint8_t { kPosition, kTriangle, kNormal, kUv };

/// An array of a Geometry.
template <typename Item>
struct GeometryField {
    const char* name;
    std::vector<Item> Geometry::*array;
    Per per;
    /// The array may be empty, which means this value for all items.
    std::optional<Item> absent = std::nullopt;
    /// Items are three indices of these, or `absent`. A mirrored triangle exchanges two of them.
    std::optional<Per> indexes = std::nullopt;
};

inline constexpr std::tuple kGeometryFields{
    GeometryField<glm::vec3>{"positions", &Geometry::positions, Per::kPosition},
    GeometryField<glm::uvec3>{"triangles", &Geometry::triangles, Per::kTriangle, std::nullopt,
                              Per::kPosition},
    GeometryField<std::uint32_t>{"materials", &Geometry::materials, Per::kTriangle},
    GeometryField<glm::vec3>{"normals", &Geometry::normals, Per::kNormal},
    GeometryField<glm::uvec3>{"normalIndices", &Geometry::normalIndices, Per::kTriangle,
                              glm::uvec3(Geometry::kNoNormal), Per::kNormal},
    GeometryField<glm::vec3>{"colours", &Geometry::colours, Per::kPosition, glm::vec3(1.0f)},
    GeometryField<float>{"alphas", &Geometry::alphas, Per::kPosition, 1.0f},
    GeometryField<glm::vec2>{"uvs", &Geometry::uvs, Per::kUv},
    GeometryField<glm::vec2>{"secondUvs", &Geometry::secondUvs, Per::kUv, glm::vec2(0.0f)},
    GeometryField<glm::vec4>{"tangents", &Geometry::tangents, Per::kUv, glm::vec4(0.0f)},
    GeometryField<glm::uvec3>{"uvIndices", &Geometry::uvIndices, Per::kTriangle, glm::uvec3(Geometry::kNoUv),
                              Per::kUv},
};
static_assert(sizeof(Geometry) == std::tuple_size_v<decltype(kGeometryFields)> * sizeof(std::vector<float>),
              "a field of Geometry is missing in the list");

/// Calls visit(field) for every GeometryField.
template <typename Visit>
void forEachGeometryField(Visit&& visit) {
    std::apply([&](const auto&... field) { (visit(field), ...); }, kGeometryFields);
}

/// Calls visit(field, array) for every array of a geometry.
template <Either<Geometry> Object, typename Visit>
void forEachField(Object& geometry, Visit&& visit) {
    forEachGeometryField([&](const auto& field) { visit(field, geometry.*field.array); });
}

struct GeometryCounts {
    std::size_t positions, triangles, normals, uvs;

    explicit GeometryCounts(const Geometry& geometry)
        : positions(geometry.positions.size()),
          triangles(geometry.triangles.size()),
          normals(geometry.normals.size()),
          uvs(geometry.uvs.size()) {}

    std::size_t of(Per per) const {
        switch (per) {
            case Per::kPosition:
                return positions;
            case Per::kTriangle:
                return triangles;
            case Per::kNormal:
                return normals;
            case Per::kUv:
                return uvs;
        }
        return 0;
    }
};

}  // namespace duolux

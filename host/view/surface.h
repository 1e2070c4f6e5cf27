#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <limits>
#include <optional>
#include <vector>

#include "host/bvh/binary_bvh.h"
#include "host/scene/emitters.h"
#include "host/scene/scene.h"
#include "host/view/bulk.h"

namespace duolux {

/// The triangles of a scene for visibility queries on the host, in local coordinates: the bounds of what a
/// camera should show are centred at the origin and scaled to fit the unit ball. Scenes with many triangles
/// are simplified, so that a query takes microseconds and all queries together take fractions of a second.
/// Deterministic.
class Surface {
  public:
    static constexpr std::uint32_t kNone = 0xffffffffu;

    struct Triangle {
        glm::vec3 corner, edge1, edge2;
        std::uint32_t material;
        bool framed;  ///< a camera should show it; false for outliers, and for emitters outside of meshes

        glm::vec3 areaVector() const { return 0.5f * glm::cross(edge1, edge2); }
    };

    struct Hit {
        std::uint32_t triangle;
        float distance;
        bool front;  ///< whether the ray hits the front side
    };

    /// The scene must outlive this object. A camera should show the bulk of its first `framedTriangles`
    /// triangles.
    Surface(const Scene& scene, std::size_t framedTriangles);

    const Scene& scene() const { return *scene_; }
    const Bulk& bulk() const { return bulk_; }
    const std::vector<Triangle>& triangles() const { return triangles_; }
    const Material& materialOf(std::uint32_t triangle) const {
        return scene_->materials[triangles_[triangle].material];
    }

    /// Whether a camera should show a triangle of the scene.
    bool isFramed(std::size_t sceneTriangle) const {
        return sceneTriangle < bulk_.framed && !bulk_.isOutlier(scene_->geometry, sceneTriangle);
    }

    glm::vec3 toLocal(const glm::dvec3& point) const { return {(point - centre_) * scale_}; }
    glm::dvec3 toScene(const glm::vec3& point) const { return glm::dvec3(point) / scale_ + centre_; }
    double scale() const { return scale_; }  ///< ratio of local lengths to lengths in the scene

    /// The nearest triangle along a unit direction, except `skipped`.
    std::optional<Hit> firstHit(const glm::vec3& origin, const glm::vec3& direction,
                                std::uint32_t skipped = kNone) const;

    /// Whether no triangle, except `skipped`, lies between two points.
    bool sees(const glm::vec3& from, const glm::vec3& to, std::uint32_t skipped = kNone) const;

    /// The emitters with an area, and those that are no triangles, in the order of the scene's: `index` is
    /// that of a triangle of this surface, `area` is in local units.
    std::vector<SceneEmitter> listEmitters() const;

  private:
    struct Ray;
    bool meets(std::uint32_t triangle, Ray& ray) const;
    bool traverse(Ray& ray, bool any) const;

    const Scene* scene_;
    Bulk bulk_;
    glm::dvec3 centre_{0.0};
    double scale_ = 1.0;
    std::vector<Triangle> triangles_;
    BinaryBvh tree_;
};

}  // namespace duolux

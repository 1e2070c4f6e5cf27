#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "host/scene/scene.h"
#include "shaders/shared/trace_layout.h"

namespace duolux {

/// A scene's triangles in Embree's own tree of the quality MEDIUM, traced by single rays on all cores.
class EmbreeScene {
  public:
    explicit EmbreeScene(const Geometry& geometry);
    ~EmbreeScene();
    EmbreeScene(const EmbreeScene&) = delete;
    EmbreeScene& operator=(const EmbreeScene&) = delete;

    struct Hit {
        std::uint32_t triangle = kNone;
        float t = 0.0f;
        static constexpr std::uint32_t kNone = 0xffffffffu;
    };
    Hit nearest(const glm::vec3& origin, const glm::vec3& direction, float tMax) const;
    bool occluded(const glm::vec3& origin, const glm::vec3& direction, float tMax) const;

    /// Traces all rays of a set by rtcIntersect1 (shared::kTraceNearest) or rtcOccluded1 (kTraceAnyHit).
    /// `distances`: of the hits, negative for a miss; one for each ray.
    void trace(std::span<const shared::TraceRay> rays, std::uint32_t mode,
               std::vector<float>& distances) const;

    double buildSeconds() const;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace duolux

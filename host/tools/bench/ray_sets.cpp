#include "host/tools/bench/ray_sets.h"

#include <algorithm>
#include <cmath>

#include "host/base/random.h"
#include "host/render/pixel_order.h"
#include "host/scene/emitters.h"
#include "host/scene/image_plane.h"
#include "host/tools/bench/trace_kernel.h"

namespace duolux {

namespace {

using shared::kInfinity;
using shared::TraceHit;
using shared::TraceRay;

std::vector<TraceRay> primaryRays(const Camera& camera, std::uint32_t width, std::uint32_t height) {
    const ImagePlane plane = imagePlane(camera, width, height);
    const glm::vec2 size(width, height);
    std::vector<TraceRay> rays;
    for (const std::uint32_t pixel : pixelOrder(width, height)) {
        const glm::vec2 at = (glm::vec2(pixel % width, pixel / width) + 0.5f) / size * 2.0f - 1.0f;
        const CameraRay ray = cameraRay(camera, plane, {at.x, -at.y});
        rays.push_back({ray.origin, 0.0f, ray.direction, kInfinity});
    }
    return rays;
}

/// The point of a ray's hit, offset from the surface by more than rounding, and the normal on that side.
struct Surface {
    glm::vec3 position, normal;
};

Surface surfaceAt(const TraceRay& ray, const TraceHit& hit) {
    glm::vec3 normal = glm::normalize(hit.normal);
    if (glm::dot(normal, ray.direction) > 0.0f) normal = -normal;
    const glm::vec3 position = ray.origin + hit.t * ray.direction;
    const glm::vec3 size = glm::max(glm::abs(position), glm::abs(ray.origin));
    const float error = std::max({size.x, size.y, size.z, hit.t}) * std::ldexp(64.0f, -24);
    return {position + normal * error, normal};
}

/// Points on emitters, uniform in area.
class Emitters {
  public:
    explicit Emitters(const Scene& scene) : geometry_(scene.geometry), triangles_(emittingTriangles(scene)) {
        double area = 0.0;
        for (const std::uint32_t i : triangles_) {
            const auto [a, b, c] = corners(i);
            area += static_cast<double>(glm::length(glm::cross(b - a, c - a)));
            sums_.push_back(area);
        }
    }

    bool none() const { return triangles_.empty(); }

    glm::vec3 point(Random& random) const {
        const double at = static_cast<double>(random.uniform()) * sums_.back();
        const auto found = std::upper_bound(sums_.begin(), sums_.end(), at) - sums_.begin();
        const auto [a, b, c] = corners(
            triangles_[std::min<std::size_t>(static_cast<std::size_t>(found), triangles_.size() - 1)]);
        float u = random.uniform();
        float v = random.uniform();
        if (u + v > 1.0f) u = 1.0f - u, v = 1.0f - v;
        return a + u * (b - a) + v * (c - a);
    }

  private:
    struct Corners {
        glm::vec3 a, b, c;
    };
    Corners corners(std::uint32_t triangle) const {
        const glm::uvec3 index = geometry_.triangles[triangle];
        return {geometry_.positions[index.x], geometry_.positions[index.y], geometry_.positions[index.z]};
    }

    const Geometry& geometry_;
    std::vector<std::uint32_t> triangles_;
    std::vector<double> sums_;
};

}  // namespace

std::vector<RaySet> makeRaySets(const Device& device, const Scene& scene, const DeviceScene& deviceScene,
                                std::uint32_t width, std::uint32_t height) {
    const std::vector<TraceRay> primary = primaryRays(scene.camera, width, height);
    TraceKernel kernel(device, deviceScene, shared::kTraceNearest, primary);
    kernel.run();
    const std::vector<TraceHit> hits = kernel.hits();
    const Emitters emitters(scene);
    Random random(1);
    std::vector<TraceRay> diffuse, shadow;
    for (std::size_t i = 0; i < primary.size(); ++i) {
        if (hits[i].t < 0.0f) continue;
        const Surface surface = surfaceAt(primary[i], hits[i]);
        diffuse.push_back({surface.position, 0.0f, cosineDirection(surface.normal, random), kInfinity});
        if (emitters.none()) continue;
        const glm::vec3 toLight = emitters.point(random) - surface.position;
        const float distance = glm::length(toLight);
        if (!(distance > 0.0f) || glm::dot(toLight, surface.normal) <= 0.0f) continue;
        // The ray ends just before the emitter, so that the emitter does not block itself.
        shadow.push_back({surface.position, 0.0f, toLight / distance, distance * 0.9999f});
    }
    std::vector<RaySet> sets{{"primary", shared::kTraceNearest, primary}};
    if (!diffuse.empty()) sets.push_back({"diffuse", shared::kTraceNearest, diffuse});
    if (!shadow.empty()) sets.push_back({"shadow", shared::kTraceAnyHit, shadow});
    sets.push_back({"crossings", shared::kTraceAllCrossings, primary});
    return sets;
}

}  // namespace duolux

#include "host/view/surface.h"

#include <algorithm>
#include <cmath>

#include "host/view/simplify.h"

namespace duolux {

namespace {

constexpr float kNearest = 1e-6f;  // smallest distance of a hit, relative to the scene's radius
// Rays usually visit some hundred nodes. Among long thin triangles whose boxes overlap they would visit
// nearly all of them, and give up: the automatic choices need no exact answer there.
constexpr std::size_t kMostNodes = 4096;

std::vector<PrimitiveRef> boxesOf(const std::vector<Surface::Triangle>& triangles) {
    std::vector<PrimitiveRef> boxes(triangles.size());
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        const auto& [a, edge1, edge2, material, framed] = triangles[i];
        boxes[i].lower = glm::min(a, glm::min(a + edge1, a + edge2));
        boxes[i].upper = glm::max(a, glm::max(a + edge1, a + edge2));
        boxes[i].primitive = static_cast<std::uint32_t>(i);
    }
    return boxes;
}

}  // namespace

struct Surface::Ray {
    glm::vec3 origin, direction, inverse;
    float end;
    std::uint32_t skipped;
    std::uint32_t triangle = kNone;

    Ray(const glm::vec3& from, const glm::vec3& along, float length, std::uint32_t skip)
        : origin(from), direction(along), end(length), skipped(skip) {
        // A large number in place of infinity, because infinity times 0 is NaN.
        for (int i = 0; i < 3; ++i)
            inverse[i] = std::abs(along[i]) > 1e-30f ? 1.0f / along[i] : 1e30f;
    }

    bool reaches(const Aabb& box) const {
        constexpr float kSlack = 1e-6f;
        const glm::vec3 t0 = (box.lower - kSlack - origin) * inverse;
        const glm::vec3 t1 = (box.upper + kSlack - origin) * inverse;
        const glm::vec3 near = glm::min(t0, t1), far = glm::max(t0, t1);
        return std::max({near.x, near.y, near.z, 0.0f}) <= std::min({far.x, far.y, far.z, end});
    }
};

Surface::Surface(const Scene& scene, std::size_t framedTriangles)
    : scene_(&scene), bulk_(bulkOf(scene.geometry, framedTriangles)) {
    centre_ = 0.5 * (bulk_.lower + bulk_.upper);
    const double radius = 0.5 * glm::length(bulk_.upper - bulk_.lower);
    scale_ = radius > 0.0 ? 1.0 / radius : 1.0;
    triangles_ = simplifiedTriangles(*this);
    std::vector<PrimitiveRef> boxes = boxesOf(triangles_);
    tree_ = buildBinaryBvh(boxes, SplitMethod::kBinnedSah);
}

std::vector<SceneEmitter> Surface::listEmitters() const {
    std::vector<SceneEmitter> emitters;
    for (std::uint32_t i = 0; i < triangles_.size(); ++i) {
        const Material& material = materialOf(i);
        const float area = glm::length(triangles_[i].areaVector());
        if (emits(material) && area > 0.0f)
            emitters.push_back({EmitterKind::kTriangle, i, material.emission, static_cast<double>(area)});
    }
    addPointEmitters(*scene_, emitters);
    return emitters;
}

/// Moeller and Trumbore, "Fast, Minimum Storage Ray-Triangle Intersection", 1997.
bool Surface::meets(std::uint32_t triangle, Ray& ray) const {
    const Triangle& t = triangles_[triangle];
    const glm::vec3 p = glm::cross(ray.direction, t.edge2);
    const float determinant = glm::dot(t.edge1, p);
    if (determinant == 0.0f || triangle == ray.skipped) return false;
    const float inverse = 1.0f / determinant;
    const glm::vec3 offset = ray.origin - t.corner;
    const float u = glm::dot(offset, p) * inverse;
    const glm::vec3 q = glm::cross(offset, t.edge1);
    const float v = glm::dot(ray.direction, q) * inverse;
    if (!(u >= 0.0f && v >= 0.0f && u + v <= 1.0f)) return false;
    const float distance = glm::dot(t.edge2, q) * inverse;
    if (!(distance > kNearest && distance < ray.end)) return false;
    ray.end = distance;
    ray.triangle = triangle;
    return true;
}

/// Depth-first traversal without a stack: a subtree over n triangles has 2n - 1 nodes.
bool Surface::traverse(Ray& ray, bool any) const {
    bool found = false;
    std::size_t visited = 0;
    for (std::size_t at = 0; at < tree_.nodes.size() && visited < kMostNodes; ++visited) {
        const BinaryBvh::Node& node = tree_.nodes[at];
        if (!ray.reaches(node.bounds)) {
            at += 2 * std::size_t{node.count} - 1;
            continue;
        }
        if (node.count == 1 && meets(node.right, ray)) {
            found = true;
            if (any) return true;
        }
        ++at;
    }
    return found;
}

std::optional<Surface::Hit> Surface::firstHit(const glm::vec3& origin, const glm::vec3& direction,
                                              std::uint32_t skipped) const {
    Ray ray(origin, direction, std::numeric_limits<float>::max(), skipped);
    if (!traverse(ray, false)) return std::nullopt;
    const bool front = glm::dot(triangles_[ray.triangle].areaVector(), direction) < 0.0f;
    return Hit{ray.triangle, ray.end, front};
}

bool Surface::sees(const glm::vec3& from, const glm::vec3& to, std::uint32_t skipped) const {
    const float distance = glm::length(to - from);
    if (!(distance > 0.0f)) return true;
    Ray ray(from, (to - from) / distance, distance * (1.0f - 1e-5f), skipped);
    return !traverse(ray, true);
}

}  // namespace duolux

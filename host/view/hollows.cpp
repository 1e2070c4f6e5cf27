#include "host/view/hollows.h"

#include <algorithm>

#include "host/view/view_axes.h"

namespace duolux {

namespace {

constexpr int kRaysPerPlace = 6;

SurfacePoint otherSide(const SurfacePoint& point) {
    return {point.position, -point.normal, point.triangle, !point.front};
}

/// The number of random paths from one side of the surface that leave the scene.
int escapes(const Surface& surface, const SurfacePoint& point, Random& random) {
    constexpr int kSegments = 32;
    int count = 0;
    for (int path = 0; path < kRaysPerPlace; ++path) {
        SurfacePoint at = point;
        for (int i = 0; i < kSegments; ++i) {
            const glm::vec3 direction = cosineDirection(at.normal, random);
            const glm::vec3 origin = at.position + kOffset * at.normal;
            const auto hit = surface.firstHit(origin, direction, at.triangle);
            if (!hit) {
                ++count;
                break;
            }
            at = pointOf(surface, origin, direction, *hit);
        }
    }
    return count;
}

}  // namespace

float facedPart(const Surface& surface, const SurfacePoint& point, Random& random) {
    int hits = 0;
    for (int i = 0; i < kRaysPerPlace; ++i) {
        const glm::vec3 origin = point.position + kOffset * point.normal;
        hits += surface.firstHit(origin, cosineDirection(point.normal, random), point.triangle) ? 1 : 0;
    }
    return static_cast<float>(hits) / kRaysPerPlace;
}

bool isInsideOut(const Surface& surface, const SurfacePoint& front, std::uint32_t seed) {
    constexpr float kMore = 0.3f;
    constexpr int kFewest = 2;  // a single path may escape through a crack
    Random random(seed);
    const SurfacePoint back = otherSide(front);
    const float faced = facedPart(surface, back, random);
    return faced > kMore && faced > kMore + facedPart(surface, front, random) &&
           escapes(surface, back, random) >= kFewest;
}

EnclosedEmitters::EnclosedEmitters(const Surface& surface) : surface_(surface) {
    constexpr std::size_t kMost = 32;
    constexpr int kDirections = 32;
    constexpr float kOpen = 0.03f, kNarrow = 0.1f;
    std::vector<std::uint32_t> emitters;
    for (const SceneEmitter& emitter : surface.listEmitters()) {
        switch (emitter.kind) {
            case EmitterKind::kTriangle:
                emitters.push_back(emitter.index);
                break;
            case EmitterKind::kPoint:  // not part of the surface
                break;
        }
    }
    const std::size_t count = std::min(kMost, emitters.size());
    float misses = 0.0f, distance = 0.0f;
    for (std::size_t k = 0; k < count; ++k) {
        const std::uint32_t triangle = emitters[k * emitters.size() / count];
        const Surface::Triangle& t = surface.triangles()[triangle];
        const SurfacePoint front{t.corner + (t.edge1 + t.edge2) / 3.0f, glm::normalize(t.areaVector()),
                                 triangle, true};
        for (const SurfacePoint& point : {front, otherSide(front)}) {
            points_.push_back(point);
            for (int i = 0; i < kDirections; ++i) {
                glm::vec3 direction = onSphere(i, kDirections);
                if (glm::dot(direction, point.normal) < 0.0f) direction = -direction;
                const auto hit =
                    surface.firstHit(point.position + kOffset * point.normal, direction, triangle);
                misses += hit ? 0.0f : 1.0f;
                distance += hit ? std::min(hit->distance, 2.0f) : 0.0f;
            }
        }
    }
    const float rays = static_cast<float>(points_.size()) * kDirections;
    enclosed_ = count > 0 && misses < kOpen * rays && distance > kNarrow * rays;
}

bool EnclosedEmitters::areSeenFrom(const glm::vec3& point) const {
    return std::any_of(points_.begin(), points_.end(), [&](const SurfacePoint& emitter) {
        const glm::vec3 from = emitter.position + kOffset * emitter.normal;
        return glm::dot(emitter.normal, point - from) > 0.0f && surface_.sees(from, point, emitter.triangle);
    });
}

}  // namespace duolux

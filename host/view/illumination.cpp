#include "host/view/illumination.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "host/base/random.h"
#include "host/scene/energy.h"

namespace duolux {

namespace {

constexpr int kScatterings = 4;

float mean(const glm::vec3& channels) {
    return (channels.x + channels.y + channels.z) / 3.0f;
}

}  // namespace

bool scatters(const Material& material, bool front) {
    return (front || material.sides == Sides::kBoth) && mean(meanAlbedo(material)) > 0.0f;
}

SurfacePoint pointOf(const Surface& surface, const glm::vec3& origin, const glm::vec3& direction,
                     const Surface::Hit& hit) {
    const glm::vec3 normal = glm::normalize(surface.triangles()[hit.triangle].areaVector());
    return {origin + hit.distance * direction, hit.front ? normal : -normal, hit.triangle, hit.front};
}

Illumination::Illumination(const Surface& surface, std::optional<std::uint32_t> material, bool bothSides)
    : surface_(surface) {
    for (const auto& [kind, index, emission, area] : surface.listEmitters()) {
        const float radiance = mean(emission.invisible);
        if (!(radiance > 0.0f)) continue;
        Emitter emitter{kind, index, power_, glm::vec3(0.0f), false, glm::vec3(0.0f)};
        switch (kind) {
            case EmitterKind::kTriangle: {
                const Surface::Triangle& triangle = surface.triangles()[index];
                if (material && triangle.material != *material) continue;
                emitter.both = bothSides || emission.sides == Sides::kBoth;
                emitter.normal = triangle.areaVector() / static_cast<float>(area);
                power_ += static_cast<double>(radiance) * area * (emitter.both ? 2.0 : 1.0);
                break;
            }
            case EmitterKind::kPoint:
                if (material) continue;
                emitter.position = surface.toLocal(glm::dvec3(surface.scene().pointEmitters[index].position));
                // In proportion to the flux; fromPoint() divides by the same factor.
                power_ += 8.0 * static_cast<double>(radiance) * surface.scale() * surface.scale();
                break;
        }
        emitters_.push_back(emitter);
    }
}

float Illumination::direct(const SurfacePoint& point, const glm::vec3& random) const {
    const double wanted = static_cast<double>(random.z) * power_;
    const auto after = std::upper_bound(emitters_.begin(), emitters_.end(), wanted,
                                        [](double p, const Emitter& e) { return p < e.powerBefore; });
    const Emitter& emitter = *(after - 1);
    const glm::vec3 origin = point.position + kOffset * point.normal;
    switch (emitter.kind) {
        case EmitterKind::kTriangle:
            return fromTriangle(emitter, point, origin, random);
        case EmitterKind::kPoint:
            return fromPoint(emitter, point, origin);
    }
    return 0.0f;
}

float Illumination::fromPoint(const Emitter& emitter, const SurfacePoint& point,
                              const glm::vec3& origin) const {
    const glm::vec3 offset = emitter.position - origin;
    const float squared = glm::dot(offset, offset);
    const float cosine = glm::dot(point.normal, offset) / std::sqrt(squared);
    if (!(cosine > 0.0f) || !surface_.sees(origin, emitter.position, point.triangle)) return 0.0f;
    return cosine / squared * static_cast<float>(power_) / (8.0f * glm::pi<float>());
}

float Illumination::fromTriangle(const Emitter& emitter, const SurfacePoint& point, const glm::vec3& origin,
                                 const glm::vec3& random) const {
    const Surface::Triangle& t = surface_.triangles()[emitter.index];
    const float root = std::sqrt(random.x);
    const glm::vec3 at = t.corner + root * (1.0f - random.y) * t.edge1 + root * random.y * t.edge2;
    const glm::vec3 offset = at - origin;
    const float squared = glm::dot(offset, offset);
    if (!(squared > 0.0f) || emitter.index == point.triangle) return 0.0f;
    const glm::vec3 direction = offset / std::sqrt(squared);
    const float cosine = glm::dot(point.normal, direction);
    float cosineThere = -glm::dot(emitter.normal, direction);
    if (emitter.both) cosineThere = std::abs(cosineThere);
    if (!(cosine > 0.0f && cosineThere > 0.0f) || !surface_.sees(origin, at, point.triangle)) return 0.0f;
    // The density per unit area is the radiance (twice the radiance for both sides) divided by the power.
    const float perRadiance = static_cast<float>(power_) / (emitter.both ? 2.0f : 1.0f);
    return cosine * cosineThere / squared * perRadiance / glm::pi<float>();
}

float Illumination::onWhite(const SurfacePoint& point, std::uint32_t seed, int paths) const {
    if (emitters_.empty()) return 0.0f;
    Random random(seed);
    const auto next3 = [&] {
        const float x = random.uniform(), y = random.uniform();
        return glm::vec3(x, y, random.uniform());
    };
    float sum = 0.0f;
    for (int path = 0; path < paths; ++path) {
        SurfacePoint at = point;
        float weight = 1.0f;
        for (int i = 0; i < kScatterings; ++i) {
            sum += weight * direct(at, next3());
            const glm::vec3 direction = cosineDirection(at.normal, random);
            const glm::vec3 origin = at.position + kOffset * at.normal;
            const auto hit = surface_.firstHit(origin, direction, at.triangle);
            if (!hit) break;
            const Material& material = surface_.materialOf(hit->triangle);
            if (!scatters(material, hit->front)) break;
            weight *= mean(meanAlbedo(material));
            at = pointOf(surface_, origin, direction, *hit);
        }
    }
    return sum / static_cast<float>(paths);
}

float Illumination::emitted(const SurfacePoint& point) const {
    const Emission& emission = surface_.materialOf(point.triangle).emission;
    return point.front || emission.sides == Sides::kBoth ? mean(emission.visible) : 0.0f;
}

}  // namespace duolux

#include "host/view/emitter_sides.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>

#include "host/base/printable.h"
#include "host/view/look_through.h"
#include "host/view/view_axes.h"

namespace duolux {

namespace {

/// The mean distance, up to the size of the scene, to surfaces that one side of an emitter could light.
float reach(const Surface& surface, const SurfacePoint& point) {
    constexpr int kDirections = 32;
    constexpr float kMost = 1.0f;
    const std::uint32_t own = surface.triangles()[point.triangle].material;
    float sum = 0.0f;
    for (int i = 0; i < kDirections; ++i) {
        glm::vec3 direction = onSphere(i, kDirections);
        if (glm::dot(direction, point.normal) < 0.0f) direction = -direction;
        const auto hit = surface.firstHit(point.position + kOffset * point.normal, direction, point.triangle);
        if (!hit) continue;
        const std::uint32_t material = surface.triangles()[hit->triangle].material;
        if (material == own || !scatters(surface.scene().materials[material], hit->front)) continue;
        sum += std::min(hit->distance, kMost);
    }
    return sum / kDirections;
}

/// What is known of the emitters of one material.
struct Emitters {
    double area = 0.0;    // of all
    double away = 0.0;    // of those whose back sides could light much more than their front sides
    double evenly = 0.0;  // of those whose back sides could light about as much
    std::vector<std::uint32_t> triangles;
    int fronts = 0, backs = 0;  // rays of the camera that hit them
};

void judge(const Surface& surface, Emitters& emitters) {
    constexpr std::size_t kMost = 64;
    constexpr float kMuchMore = 4.0f, kAsMuch = 0.8f, kLittle = 0.01f;
    const std::size_t count = std::min(kMost, emitters.triangles.size());
    for (std::size_t k = 0; k < count; ++k) {
        const std::uint32_t index = emitters.triangles[k * emitters.triangles.size() / count];
        const Surface::Triangle& t = surface.triangles()[index];
        const glm::vec3 area = t.areaVector();
        const auto size = static_cast<double>(glm::length(area));
        const glm::vec3 centre = t.corner + (t.edge1 + t.edge2) / 3.0f, normal = glm::normalize(area);
        const float front = reach(surface, {centre, normal, index, true});
        const float back = reach(surface, {centre, -normal, index, false});
        emitters.area += size;
        if (back <= kLittle) continue;
        if (back > kMuchMore * front) emitters.away += size;
        if (back > kAsMuch * front) emitters.evenly += size;
    }
}

}  // namespace

std::vector<Warning> emitterWarnings(const Surface& surface, const Camera& camera, float aspect) {
    std::map<std::uint32_t, Emitters> all;  // by material
    for (const auto& [kind, index, emission, area] : surface.listEmitters()) {
        switch (kind) {
            case EmitterKind::kTriangle:
                if (emission.sides == Sides::kFront)
                    all[surface.triangles()[index].material].triangles.push_back(index);
                break;
            case EmitterKind::kPoint:  // has no sides
                break;
        }
    }
    if (all.empty()) return {};
    lookThrough(camera, aspect, surface, [&](const SurfacePoint& point, std::uint32_t) {
        const auto emitters = all.find(surface.triangles()[point.triangle].material);
        if (emitters == all.end()) return;
        ++(point.front ? emitters->second.fronts : emitters->second.backs);
    });
    std::vector<Warning> warnings;
    for (auto& [material, emitters] : all) {
        judge(surface, emitters);
        const bool away = emitters.away > 0.25 * emitters.area;
        const bool onlyBacks = emitters.backs > 0 && emitters.fronts == 0;
        if (!away && !(onlyBacks && emitters.evenly > 0.5 * emitters.area)) continue;
        std::string what = "show the camera only their back sides";
        if (away) {
            what = fmt::format("{}face away from what they could light",
                               emitters.away > 0.9 * emitters.area ? "" : "partly ");
        }
        std::string text = fmt::format(
            "emitters (material {}) {}: they emit only from their front sides, on which the corners are "
            "counter-clockwise; turn them, or use \"sides\": \"both\" in the emission of a JSON scene",
            inQuotes(surface.scene().materials[material].name), what);
        warnings.emplace_back(std::move(text), away ? WarningKind::kEmittersFaceAway : WarningKind::kOther);
    }
    return warnings;
}

}  // namespace duolux

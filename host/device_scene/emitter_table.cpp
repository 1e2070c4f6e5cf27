#include "host/device_scene/emitter_table.h"

#include <algorithm>
#include <numeric>

namespace duolux {

namespace {

constexpr float kPointError = 32.0f / 16777216.0f;  // as pointError() of shaders/lib/intersect.glsl

float pointErrorOf(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
    const glm::vec3 largest = glm::max(glm::abs(a), glm::max(glm::abs(b), glm::abs(c)));
    return std::max({largest.x, largest.y, largest.z}) * kPointError;
}

/// Emission per unit area, summed over both sides, in an arbitrary unit of power.
double brightness(const Emission& emission, bool bothComponents) {
    const glm::dvec3 e =
        glm::dvec3(emission.invisible) + (bothComponents ? glm::dvec3(emission.visible) : glm::dvec3(0.0));
    return (e.x + e.y + e.z) * (emission.sides == Sides::kBoth ? 2.0 : 1.0);
}

double areaOf(const Geometry& geometry, std::uint32_t triangle) {
    const glm::uvec3 index = geometry.triangles[triangle];
    const glm::dvec3 a(geometry.positions[index.x]);
    return 0.5 * glm::length(glm::cross(glm::dvec3(geometry.positions[index.y]) - a,
                                        glm::dvec3(geometry.positions[index.z]) - a));
}

}  // namespace

std::uint32_t TriangleRanks::rankOf(std::uint32_t triangle) const {
    const auto next = std::ranges::lower_bound(emitters_, triangle);
    const auto before = static_cast<std::uint32_t>(next - emitters_.begin());
    if (next != emitters_.end() && *next == triangle) return before;
    return static_cast<std::uint32_t>(emitters_.size()) + triangle - before;
}

std::vector<AliasEntry> buildAliasTable(std::span<const double> weights) {
    const std::size_t n = weights.size();
    double total = 0.0;
    for (double w : weights)
        total += w;
    std::vector<double> scaled(n);
    std::vector<std::uint32_t> small;
    std::vector<std::uint32_t> large;
    for (std::size_t i = 0; i < n; ++i) {
        scaled[i] = weights[i] * static_cast<double>(n) / total;
        (scaled[i] < 1.0 ? small : large).push_back(static_cast<std::uint32_t>(i));
    }
    std::vector<AliasEntry> table(n);
    while (!small.empty() && !large.empty()) {
        const std::uint32_t s = small.back();
        const std::uint32_t l = large.back();
        small.pop_back();
        table[s] = {static_cast<float>(scaled[s]), l};
        scaled[l] -= 1.0 - scaled[s];
        if (scaled[l] < 1.0) {
            large.pop_back();
            small.push_back(l);
        }
    }
    // The remaining entries are 1 up to rounding.
    for (const auto* rest : {&small, &large}) {
        for (std::uint32_t i : *rest)
            table[i] = {1.0f, i};
    }
    return table;
}

EmitterTable buildEmitterTable(const Scene& scene, std::span<const std::uint32_t> emitters,
                               bool bothComponents) {
    const Geometry& geometry = scene.geometry;
    EmitterTable table;
    std::vector<double> weights;
    for (const std::uint32_t i : emitters) {
        const glm::uvec3 index = geometry.triangles[i];
        const Emission& emission = scene.materials[geometry.materials[i]].emission;
        shared::DeviceEmitter record{};
        record.v0 = geometry.positions[index.x];
        record.v1 = geometry.positions[index.y];
        record.v2 = geometry.positions[index.z];
        record.flags = shared::kEmitterKindTriangle | shared::kEmitterFront |
                       (emission.sides == Sides::kBoth ? shared::kEmitterBack : 0u);
        record.positionError = pointErrorOf(record.v0, record.v1, record.v2);
        record.invisible = emission.invisible;
        record.visible = emission.visible;
        table.records.push_back(record);
        weights.push_back(areaOf(geometry, i) * brightness(emission, bothComponents));
    }
    for (const PointEmitter& point : scene.pointEmitters) {
        shared::DeviceEmitter record{};
        record.v0 = point.position;
        record.flags = shared::kEmitterKindPoint;
        record.invisible = point.invisible;
        record.visible = point.visible;
        table.records.push_back(record);
        // The power is 4 pi times the intensity; that of a triangle pi times radiance and area.
        weights.push_back(4.0 * brightness({point.invisible, point.visible, Sides::kFront}, bothComponents));
    }
    const double total = std::accumulate(weights.begin(), weights.end(), 0.0);
    if (!(total > 0.0)) return table;
    const std::vector<AliasEntry> aliases = buildAliasTable(weights);
    for (std::size_t i = 0; i < table.records.size(); ++i) {
        shared::DeviceEmitter& record = table.records[i];
        const bool isPoint = i >= emitters.size();
        const double bright =
            isPoint ? weights[i]
                    : brightness(scene.materials[geometry.materials[emitters[i]]].emission, bothComponents);
        record.density = static_cast<float>(bright / total);
        record.threshold = aliases[i].threshold;
        record.alias = aliases[i].alias;
    }
    table.choices = static_cast<std::uint32_t>(table.records.size());
    return table;
}

}  // namespace duolux

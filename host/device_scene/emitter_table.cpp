#include "host/device_scene/emitter_table.h"

#include <algorithm>
#include <numeric>

#include "shaders/shared/rounding.h"

namespace duolux {

namespace {

/// As pointError() of shaders/lib/intersect.glsl.
float pointErrorOf(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
    const glm::vec3 largest = glm::max(glm::abs(a), glm::max(glm::abs(b), glm::abs(c)));
    return std::max({largest.x, largest.y, largest.z}) * shared::kPointError;
}

/// Emission summed over channels and sides.
double brightness(const Emission& emission, bool bothComponents) {
    const glm::dvec3 e =
        glm::dvec3(emission.invisible) + (bothComponents ? glm::dvec3(emission.visible) : glm::dvec3(0.0));
    return (e.x + e.y + e.z) * (emission.sides == Sides::kBoth ? 2.0 : 1.0);
}

constexpr std::uint32_t deviceKind(EmitterKind kind) {
    switch (kind) {
        case EmitterKind::kTriangle:
            return shared::kEmitterKindTriangle;
        case EmitterKind::kPoint:
            return shared::kEmitterKindPoint;
    }
    return 0;
}

/// The sum over all kinds; there are at most 32.
constexpr std::uint32_t allKinds() {
    std::uint32_t kinds = 0;
    for (std::uint8_t kind = 0; kind < 32; ++kind)
        kinds |= deviceKind(EmitterKind{kind});
    return kinds;
}
static_assert(allKinds() == shared::kAllEmitterKinds, "the shader tests go through kAllEmitterKinds");

}  // namespace

std::uint32_t emitterKinds(std::span<const SceneEmitter> emitters) {
    std::uint32_t kinds = 0;
    for (const SceneEmitter& emitter : emitters)
        kinds |= deviceKind(emitter.kind);
    return kinds;
}

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

EmitterTable buildEmitterTable(const Scene& scene, std::span<const SceneEmitter> emitters,
                               bool bothComponents) {
    const Geometry& geometry = scene.geometry;
    EmitterTable table;
    std::vector<double> weights, densities;  // powers over pi; the densities times the sum of the powers
    for (const SceneEmitter& emitter : emitters) {
        shared::DeviceEmitter record{};
        record.invisible = emitter.emission.invisible;
        record.visible = emitter.emission.visible;
        record.flags = deviceKind(emitter.kind);
        const double bright = brightness(emitter.emission, bothComponents);
        switch (emitter.kind) {
            case EmitterKind::kTriangle: {
                const glm::uvec3 index = geometry.triangles[emitter.index];
                record.v0 = geometry.positions[index.x];
                record.v1 = geometry.positions[index.y];
                record.v2 = geometry.positions[index.z];
                record.flags |= shared::kEmitterFront |
                                (emitter.emission.sides == Sides::kBoth ? shared::kEmitterBack : 0u);
                record.positionError = pointErrorOf(record.v0, record.v1, record.v2);
                weights.push_back(emitter.area * bright);
                densities.push_back(bright);  // per unit area
                break;
            }
            case EmitterKind::kPoint:
                record.v0 = scene.pointEmitters[emitter.index].position;
                // The power is 4 pi times the intensity; that of a triangle pi times radiance and area.
                weights.push_back(4.0 * bright);
                densities.push_back(weights.back());
                break;
        }
        table.records.push_back(record);
    }
    const double total = std::accumulate(weights.begin(), weights.end(), 0.0);
    if (!(total > 0.0)) return table;
    const std::vector<AliasEntry> aliases = buildAliasTable(weights);
    for (std::size_t i = 0; i < table.records.size(); ++i) {
        shared::DeviceEmitter& record = table.records[i];
        record.density = static_cast<float>(densities[i] / total);
        record.threshold = aliases[i].threshold;
        record.alias = aliases[i].alias;
    }
    table.choices = static_cast<std::uint32_t>(table.records.size());
    return table;
}

}  // namespace duolux

#include "host/gpu/lights.h"

#include <algorithm>

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

}  // namespace

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

LightTable buildLightTable(const Scene& scene, bool bothComponents) {
    const Geometry& geometry = scene.geometry;
    LightTable table;
    table.pdfArea.resize(scene.materials.size(), 0.0f);
    std::vector<double> weights;
    double total = 0.0;
    for (std::uint32_t i = 0; i < geometry.triangles.size(); ++i) {
        const std::uint32_t material = geometry.materials[i];
        const double bright = brightness(scene.materials[material].emission, bothComponents);
        if (!(bright > 0.0)) continue;
        const glm::uvec3 index = geometry.triangles[i];
        const glm::vec3 a = geometry.positions[index.x];
        const glm::vec3 b = geometry.positions[index.y];
        const glm::vec3 c = geometry.positions[index.z];
        const double area =
            0.5 * glm::length(glm::cross(glm::dvec3(b) - glm::dvec3(a), glm::dvec3(c) - glm::dvec3(a)));
        weights.push_back(area * bright);
        total += weights.back();
        table.lights.push_back({a, material, b, pointErrorOf(a, b, c), c, 0, 0.0f, 0, 0, 0});
        table.triangles.push_back(i);
    }
    if (!(total > 0.0)) {
        table.lights.clear();
        table.triangles.clear();
        return table;
    }
    const std::vector<AliasEntry> aliases = buildAliasTable(weights);
    for (std::size_t i = 0; i < table.lights.size(); ++i) {
        table.lights[i].threshold = aliases[i].threshold;
        table.lights[i].alias = aliases[i].alias;
    }
    for (std::size_t m = 0; m < scene.materials.size(); ++m) {
        table.pdfArea[m] =
            static_cast<float>(brightness(scene.materials[m].emission, bothComponents) / total);
    }
    return table;
}

}  // namespace duolux

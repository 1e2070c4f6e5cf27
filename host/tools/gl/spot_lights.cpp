#include "host/tools/gl/spot_lights.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>

#include "host/base/error.h"
#include "host/scene/emitters.h"

namespace duolux {

namespace {

struct Parallelogram {
    glm::dvec3 corner, edge1, edge2;  ///< edge1 x edge2 points to the front
};

/// The parallelogram that two triangles make, whose diagonal they share.
std::optional<Parallelogram> join(const std::array<glm::dvec3, 3>& a, const std::array<glm::dvec3, 3>& b) {
    const double size = glm::length(a[1] - a[0]) + glm::length(a[2] - a[0]);
    const auto same = [&](glm::dvec3 p, glm::dvec3 q) { return glm::length(p - q) <= 1e-5 * size; };
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j) {
            // a's side from i+1 to i+2 is b's side from j+2 to j+1: same winding.
            if (!same(a[(i + 1) % 3], b[(j + 2) % 3]) || !same(a[(i + 2) % 3], b[(j + 1) % 3])) continue;
            const glm::dvec3 edge1 = a[(i + 1) % 3] - a[i];
            const glm::dvec3 edge2 = a[(i + 2) % 3] - a[i];
            if (same(b[j], a[i] + edge1 + edge2)) return Parallelogram{a[i], edge1, edge2};
        }
    }
    return std::nullopt;
}

void addLights(std::vector<SpotLight>& lights, const Parallelogram& p, const Emission& emission,
               const Tiling& tiling) {
    const glm::dvec3 cross = glm::cross(p.edge1, p.edge2);
    const double area = glm::length(cross);
    std::vector<glm::dvec2> centres;
    for (std::uint32_t i = 0; i < tiling.rows; ++i) {
        for (std::uint32_t j = 0; j < tiling.columns; ++j) {
            if (tiling.cornersAndCentre && (i + j) % 2 != 0) continue;
            centres.emplace_back((i + 0.5) / tiling.rows, (j + 0.5) / tiling.columns);
        }
    }
    for (const glm::dvec2& c : centres) {
        const glm::vec3 position(p.corner + c.x * p.edge1 + c.y * p.edge2);
        const glm::vec3 direction(cross / area);
        const glm::vec3 intensity =
            emission.invisible * static_cast<float>(area / static_cast<double>(centres.size()));
        lights.push_back({position, direction, intensity});
        if (emission.sides == Sides::kBoth) lights.push_back({position, -direction, intensity});
    }
}

}  // namespace

Tiling Tiling::parse(std::string_view text) {
    if (text == "5") return {3, 3, true};
    Tiling tiling;
    const std::size_t x = text.find('x');
    const auto number = [](std::string_view digits, std::uint32_t& value) {
        const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
        return error == std::errc() && end == digits.data() + digits.size() && value >= 1 && value <= 256;
    };
    if (x == std::string_view::npos || !number(text.substr(0, x), tiling.rows) ||
        !number(text.substr(x + 1), tiling.columns)) {
        throw UsageError(fmt::format(
            "--lights {}: expected 5, or ROWSxCOLUMNS, each from 1 to 256, for example 8x8", text));
    }
    return tiling;
}

std::vector<SpotLight> spotLights(const Scene& scene, const Tiling& tiling) {
    const Geometry& geometry = scene.geometry;
    struct Emitter {
        std::array<glm::dvec3, 3> corners;
        std::uint32_t material;
    };
    std::vector<Emitter> emitters;
    for (const SceneEmitter& emitter : listEmitters(scene)) {
        if (glm::all(glm::equal(emitter.emission.invisible, glm::vec3(0.0f)))) continue;
        switch (emitter.kind) {
            case EmitterKind::kTriangle: {
                const glm::uvec3 v = geometry.triangles[emitter.index];
                emitters.push_back(
                    {{geometry.positions[v.x], geometry.positions[v.y], geometry.positions[v.z]},
                     geometry.materials[emitter.index]});
                break;
            }
            case EmitterKind::kPoint:  // not a luminaire
                break;
        }
    }
    if (emitters.empty()) {
        throw InputError(scene.source.string(), "", "nothing emits invisible light", "expected a luminaire");
    }
    std::vector<SpotLight> lights;
    while (!emitters.empty()) {
        const Emitter emitter = emitters.back();
        emitters.pop_back();
        std::optional<Parallelogram> parallelogram;
        // Searches the nearest triangles first; otherwise a strip of quadrilaterals would be paired wrongly.
        for (std::size_t i = emitters.size(); i-- > 0 && !parallelogram;) {
            if (emitters[i].material != emitter.material) continue;
            parallelogram = join(emitter.corners, emitters[i].corners);
            if (parallelogram) emitters.erase(emitters.begin() + static_cast<std::ptrdiff_t>(i));
        }
        const Material& material = scene.materials[emitter.material];
        if (!parallelogram) {
            throw InputError(scene.source.string(), fmt::format("material {}", material.name),
                             "a luminaire is not a parallelogram",
                             "expected pairs of adjacent triangles that make parallelograms");
        }
        addLights(lights, *parallelogram, material.emission, tiling);
    }
    return lights;
}

float coarseness(const Scene& scene, const std::vector<SpotLight>& lights) {
    const Geometry& geometry = scene.geometry;
    float largest = 0.0f;
    for (const glm::uvec3& t : geometry.triangles) {
        const glm::vec3 a = geometry.positions[t.x];
        const glm::vec3 b = geometry.positions[t.y];
        const glm::vec3 c = geometry.positions[t.z];
        const float edge = std::max({glm::length(b - a), glm::length(c - b), glm::length(a - c)});
        for (const SpotLight& light : lights) {
            const glm::vec3 offset = (a + b + c) / 3.0f - light.position;
            if (glm::dot(offset, light.direction) > 0.0f)
                largest = std::max(largest, edge / glm::length(offset));
        }
    }
    return largest;
}

}  // namespace duolux

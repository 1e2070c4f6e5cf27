#pragma once

#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <random>
#include <vector>

#include "host/scene/scene.h"
#include "tests/support/scene_builder.h"

// Difficult geometry for rays, and random points and directions.

namespace duolux::test {

class Random {
  public:
    explicit Random(std::uint32_t seed = 12345) : engine_(seed) {}

    std::uint32_t word() { return static_cast<std::uint32_t>(engine_()); }
    float uniform(float lower, float upper) {
        return std::uniform_real_distribution<float>(lower, upper)(engine_);
    }
    glm::vec3 inBox(float size) { return {uniform(-size, size), uniform(-size, size), uniform(-size, size)}; }
    glm::vec3 direction() {
        glm::vec3 d;
        do {
            d = inBox(1.0f);
        } while (glm::dot(d, d) > 1.0f || glm::dot(d, d) < 0.01f);
        return glm::normalize(d);
    }

  private:
    std::mt19937 engine_;
};

inline void addTriangle(Geometry& geometry, glm::vec3 a, glm::vec3 b, glm::vec3 c) {
    const auto base = static_cast<std::uint32_t>(geometry.positions.size());
    geometry.positions.insert(geometry.positions.end(), {a, b, c});
    geometry.triangles.push_back({base, base + 1, base + 2});
    geometry.materials.push_back(0);
}

/// Adds a neighbour of the last triangle across the edge between its first corners: the two are a pair.
inline void addNeighbour(Geometry& geometry, glm::vec3 corner) {
    const glm::uvec3 last = geometry.triangles.back();
    geometry.triangles.push_back({last.y, last.x, static_cast<std::uint32_t>(geometry.positions.size())});
    geometry.positions.push_back(corner);
    geometry.materials.push_back(0);
}

/// Triangles of very different sizes, some of them degenerate or coincident.
inline Geometry soup(int count, float scale, glm::vec3 centre = glm::vec3(0.0f)) {
    Random random, neighbours(2);
    Geometry geometry;
    for (int i = 0; i < count; ++i) {
        const glm::vec3 a = centre + scale * random.inBox(1.0f);
        const float size = scale * (i % 10 == 0 ? 1.0f : (i % 3 == 0 ? 0.01f : 0.1f));
        const glm::vec3 b = a + size * random.inBox(1.0f);
        const glm::vec3 c = a + size * random.inBox(1.0f);
        addTriangle(geometry, a, b, c);
        if (i % 2 == 0) addNeighbour(geometry, a + size * neighbours.inBox(1.0f));
        if (i % 17 == 0) addTriangle(geometry, a, a, a);                              // a point
        if (i % 19 == 0) addTriangle(geometry, a, b, a + 0.5f * (b - a));             // a line
        if (i % 23 == 0) addTriangle(geometry, a, b, c);                              // a copy
        if (i % 29 == 0) addTriangle(geometry, a, {b.x, a.y, a.z}, {b.x, b.y, a.z});  // flat along an axis
    }
    return geometry;
}

/// A latitude-longitude sphere of radius 1, closed; its triangles at the poles are slivers.
inline Geometry latitudeSphere(int rings, int segments) {
    Geometry geometry;
    const auto vertex = [&](int ring, int segment) {
        const double theta = M_PI * ring / rings;
        const double phi = 2.0 * M_PI * (segment % segments) / segments;
        const double radius = ring == 0 || ring == rings ? 0.0 : std::sin(theta);
        return glm::vec3(radius * std::cos(phi), std::cos(theta), radius * std::sin(phi));
    };
    for (int ring = 0; ring < rings; ++ring) {
        for (int segment = 0; segment < segments; ++segment) {
            const glm::vec3 a = vertex(ring, segment), b = vertex(ring, segment + 1);
            const glm::vec3 c = vertex(ring + 1, segment), d = vertex(ring + 1, segment + 1);
            if (ring > 0) addTriangle(geometry, a, b, c);
            if (ring < rings - 1) addTriangle(geometry, b, d, c);
        }
    }
    return geometry;
}

inline Geometry icosphere(int level) {
    SceneBuilder builder;
    builder.sphere(glm::vec3(0.0f), 1.0f, level, Facing::kOutward, 0);
    return builder.scene.geometry;
}

/// A cube from -1 to 1 whose faces are grids of n x n squares: all edges but the diagonals lie along axes.
inline Geometry gridCube(int n) {
    SceneBuilder builder;
    const auto at = [&](int i) { return 2.0f * static_cast<float>(i) / static_cast<float>(n) - 1.0f; };
    for (int axis = 0; axis < 3; ++axis) {
        for (int side = -1; side <= 1; side += 2) {
            const auto corner = [&](int i, int j) {
                glm::vec3 p;
                p[axis] = static_cast<float>(side);
                p[(axis + 1) % 3] = at(side > 0 ? i : j);
                p[(axis + 2) % 3] = at(side > 0 ? j : i);
                return p;
            };
            for (int i = 0; i < n; ++i) {
                for (int j = 0; j < n; ++j)
                    builder.quad(corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1), 0);
            }
        }
    }
    return builder.scene.geometry;
}

/// Moves the corners of a mesh about the origin in and out by up to `amount`, depending on their positions.
inline Geometry displaced(Geometry geometry, float amount) {
    for (glm::vec3& p : geometry.positions) {
        const float wave = std::sin(17.0f * p.x + 5.0f * p.y) * std::cos(13.0f * p.z - 7.0f * p.y);
        p *= 1.0f + amount * wave;
    }
    return geometry;
}

inline Geometry moved(Geometry geometry, float scale, glm::vec3 offset) {
    for (glm::vec3& p : geometry.positions)
        p = scale * p + offset;
    return geometry;
}

}  // namespace duolux::test

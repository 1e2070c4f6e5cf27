#include "tests/support/scene_builder.h"

#include <array>
#include <cmath>
#include <stdexcept>
#include <utility>
#include <vector>

namespace duolux::test {

ReflectanceMatrix matrix(float m00, float m01, float m10, float m11) {
    return {glm::vec3(m00), glm::vec3(m01), glm::vec3(m10), glm::vec3(m11)};
}

Reflectance preset(const char* name) {
    const std::optional<Reflectance> found = presetReflectance(name);
    if (!found) throw std::invalid_argument(name);
    return *found;
}

reference::ChannelLight lightOf(const Emission& emission) {
    return reference::channelsOf(emission.invisible, emission.visible);
}

Material filter(const std::string& name, const ReflectanceMatrix& transparent) {
    Material material;
    material.name = name;
    material.baseColor = glm::vec3(0.0f);
    material.reflectance = Reflectance{{}, transparent};
    return material;
}

std::uint32_t SceneBuilder::add(const Material& material) {
    scene.materials.push_back(material);
    return static_cast<std::uint32_t>(scene.materials.size() - 1);
}

void SceneBuilder::triangle(glm::vec3 a, glm::vec3 b, glm::vec3 c, std::uint32_t material) {
    Geometry& geometry = scene.geometry;
    const auto first = static_cast<std::uint32_t>(geometry.positions.size());
    geometry.positions.insert(geometry.positions.end(), {a, b, c});
    geometry.triangles.emplace_back(first, first + 1, first + 2);
    geometry.materials.push_back(material);
}

void SceneBuilder::quad(glm::vec3 a, glm::vec3 b, glm::vec3 c, glm::vec3 d, std::uint32_t material) {
    triangle(a, b, c, material);
    triangle(a, c, d, material);
}

void SceneBuilder::sphere(glm::vec3 centre, float radius, int level, Facing facing, std::uint32_t material) {
    using Triangle = std::array<glm::dvec3, 3>;
    const double golden = (1.0 + std::sqrt(5.0)) / 2.0;
    std::vector<glm::dvec3> corners;
    for (double one : {-1.0, 1.0}) {
        for (double g : {-golden, golden}) {
            corners.insert(corners.end(), {{0.0, one, g}, {one, g, 0.0}, {g, 0.0, one}});
        }
    }
    // The faces of an icosahedron of edge 2 are the triples of corners at that distance.
    std::vector<Triangle> faces;
    const auto adjacent = [](const glm::dvec3& p, const glm::dvec3& q) { return glm::distance(p, q) < 2.1; };
    for (std::size_t i = 0; i < corners.size(); ++i) {
        for (std::size_t j = i + 1; j < corners.size(); ++j) {
            for (std::size_t k = j + 1; k < corners.size(); ++k) {
                const glm::dvec3 &p = corners[i], &q = corners[j], &r = corners[k];
                if (!adjacent(p, q) || !adjacent(q, r) || !adjacent(p, r)) continue;
                const bool outward = glm::dot(glm::cross(q - p, r - p), p) > 0.0;
                faces.push_back(outward ? Triangle{p, q, r} : Triangle{p, r, q});
            }
        }
    }
    for (Triangle& face : faces) {
        for (glm::dvec3& p : face)
            p = glm::normalize(p);
    }
    for (int i = 0; i < level; ++i) {
        std::vector<Triangle> finer;
        for (const auto& [a, b, c] : faces) {
            const glm::dvec3 ab = glm::normalize(a + b), bc = glm::normalize(b + c),
                             ca = glm::normalize(c + a);
            finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
        }
        faces = std::move(finer);
    }
    for (const auto& [a, b, c] : faces) {
        const glm::vec3 p = centre + radius * glm::vec3(a), q = centre + radius * glm::vec3(b),
                        r = centre + radius * glm::vec3(c);
        facing == Facing::kOutward ? triangle(p, q, r, material) : triangle(p, r, q, material);
    }
}

void SceneBuilder::box(glm::vec3 lower, glm::vec3 upper, Facing facing, std::uint32_t material) {
    for (int axis = 0; axis < 3; ++axis) {
        const int u = (axis + 1) % 3, v = (axis + 2) % 3;
        for (bool high : {false, true}) {
            const auto corner = [&](bool highU, bool highV) {
                glm::vec3 p;
                p[axis] = high ? upper[axis] : lower[axis];
                p[u] = highU ? upper[u] : lower[u];
                p[v] = highV ? upper[v] : lower[v];
                return p;
            };
            const glm::vec3 a = corner(false, false), b = corner(true, false), c = corner(true, true),
                            d = corner(false, true);
            if (high == (facing == Facing::kOutward)) {
                quad(a, b, c, d, material);
            } else {
                quad(a, d, c, b, material);
            }
        }
    }
}

LoadedScene transformed(LoadedScene scene, float scale, glm::vec3 offset) {
    for (glm::vec3& p : scene.geometry.positions)
        p = scale * p + offset;
    scene.camera.position = scale * scene.camera.position + offset;
    scene.camera.target = scale * scene.camera.target + offset;
    return scene;
}

}  // namespace duolux::test

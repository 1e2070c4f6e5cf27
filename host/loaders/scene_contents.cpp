#include "host/loaders/scene_contents.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>

#include "host/loaders/tally.h"
#include "host/scene/compose.h"
#include "host/scene/origin.h"

namespace duolux {

namespace {

/// The median edge length of many triangles.
double typicalEdge(const Geometry& geometry) {
    constexpr std::size_t kMost = 4096;
    std::vector<double> lengths;
    for (std::size_t i = 0; i < geometry.triangles.size(); i += geometry.triangles.size() / kMost + 1) {
        const auto corner = [&](int k) { return glm::dvec3(geometry.positions[geometry.triangles[i][k]]); };
        for (int k = 0; k < 3; ++k)
            lengths.push_back(glm::distance(corner(k), corner((k + 1) % 3)));
    }
    return medianOf(std::move(lengths));
}

/// The mean factor by which a transform scales lengths.
double scaleOf(const std::optional<glm::dmat4>& transform) {
    return transform ? std::cbrt(std::abs(glm::determinant(glm::dmat3(*transform)))) : 1.0;
}

/// Transforms a point of a mesh to the scene.
glm::dvec3 placed(const SceneContents& contents, const SceneContents::Object& object,
                  const glm::vec3& position) {
    const glm::dvec3 place = contents.meshes[object.mesh].origin + glm::dvec3(position);
    return object.transform ? glm::dvec3(*object.transform * glm::dvec4(place, 1.0)) : place;
}

double typicalEdge(const SceneContents::Light& light) {
    return static_cast<double>(std::min(glm::length(light.edge1), glm::length(light.edge2)));
}

/// The bounds of all objects (by the corners of their bounds) and lights.
WideBounds boundsOf(const SceneContents& contents) {
    std::vector<Bounds> meshBounds;
    for (const Mesh& mesh : contents.meshes)
        meshBounds.push_back(boundsOf(mesh.geometry));
    WideBounds bounds;
    for (const SceneContents::Object& object : contents.objects) {
        const auto& [lower, upper] = meshBounds[object.mesh];
        for (int corner = 0; corner < 8; ++corner) {
            const glm::vec3 position(corner & 1 ? lower.x : upper.x, corner & 2 ? lower.y : upper.y,
                                     corner & 4 ? lower.z : upper.z);
            bounds.add(placed(contents, object, position));
        }
    }
    for (const SceneContents::Light& light : contents.lights) {
        for (const glm::vec3& edge : {glm::vec3(0.0f), light.edge1, light.edge2, light.edge1 + light.edge2})
            bounds.add(light.corner + glm::dvec3(edge));
    }
    return bounds;
}

std::vector<OriginSample> samplesOf(const SceneContents& contents) {
    constexpr std::size_t kMost = 1u << 16;
    std::vector<double> edges;
    for (const Mesh& mesh : contents.meshes)
        edges.push_back(typicalEdge(mesh.geometry));
    std::size_t triangles = 0;
    for (const SceneContents::Object& object : contents.objects)
        triangles += contents.meshes[object.mesh].geometry.triangles.size();
    std::vector<OriginSample> samples;
    for (const SceneContents::Object& object : contents.objects) {
        const Geometry& geometry = contents.meshes[object.mesh].geometry;
        const double tolerance = kUnnoticed * edges[object.mesh] * scaleOf(object.transform);
        for (std::size_t i = 0; i < geometry.triangles.size(); i += triangles / kMost + 1) {
            for (int k = 0; k < 3; ++k) {
                const glm::vec3& position = geometry.positions[geometry.triangles[i][k]];
                samples.push_back({placed(contents, object, position), tolerance});
            }
        }
    }
    for (const SceneContents::Light& light : contents.lights)
        samples.push_back({light.corner, kUnnoticed * typicalEdge(light)});
    return samples;
}

/// Objects and lights whose vertices rounding moves too far.
class Losses {
  public:
    void add(const JsonNode& node, double error, double edge) {
        if (error <= kUnnoticed * edge) return;
        if (count_++ == 0) first_ = fmt::format("{}: {}", node.file().string(), node.path());
        if (error > error_) {
            error_ = error;
            edge_ = edge;
        }
    }
    void warn(LoadedScene& scene) const {
        if (count_ == 0) return;
        scene.warnings.push_back(fmt::format(
            "{}{}: single precision moves vertices by up to {:.2g}; typical edges are {:.2g} long", first_,
            andMore(count_), error_, edge_));
    }

  private:
    std::string first_;
    std::size_t count_ = 0;
    double error_ = 0.0, edge_ = 0.0;
};

}  // namespace

glm::dvec3 originOf(const SceneContents& contents) {
    return originFor(boundsOf(contents), samplesOf(contents));
}

void appendObjects(SceneContents& contents, LoadedScene& scene) {
    Composer composer(scene);
    Losses losses;
    for (Mesh& mesh : contents.meshes)
        mesh.unusedMaterials.clear();  // copies do not need them
    std::vector<std::size_t> uses(contents.meshes.size(), 0);
    for (const SceneContents::Object& object : contents.objects)
        ++uses[object.mesh];
    for (const auto& [node, index, transform] : contents.objects) {
        Mesh& read = contents.meshes[index];
        Mesh mesh = --uses[index] == 0 ? std::move(read) : read;
        read.warnings.clear();
        read.bytes = 0;
        read.files.clear();
        double error = 0.0;
        if (!placeMesh(mesh, transform.value_or(glm::dmat4(1.0)), scene.origin, &error)) {
            node.fail("moves the mesh out of range",
                      fmt::format("expected coordinates of at most {:g} in magnitude", kLargestCoordinate));
        }
        if (error > 0.0) {
            // Only vertices that faces use count.
            const auto& [lower, upper] = boundsOf(mesh.geometry);
            const double reach = WideBounds{glm::dvec3(lower), glm::dvec3(upper)}.reach();
            losses.add(node, std::min(error, largestRoundingError(reach)), typicalEdge(mesh.geometry));
        }
        composer.append(std::move(mesh));
    }
    composer.finish();
    losses.warn(scene);
}

void appendLights(const SceneContents& contents, LoadedScene& scene) {
    Composer composer(scene);
    Losses losses;
    const auto place = [&](const JsonNode& node, const glm::dvec3& inFile) {
        const glm::dvec3 position = inFile - scene.origin;
        if (glm::any(glm::greaterThan(glm::abs(position), glm::dvec3(kLargestCoordinate)))) {
            node.fail("is too far from the rest of the scene",
                      fmt::format("expected a distance of at most {:g}", kLargestCoordinate));
        }
        return position;
    };
    for (const auto& [node, position, emitter] : contents.points) {
        scene.pointEmitters.push_back(emitter);
        scene.pointEmitters.back().position = glm::vec3(place(node, position));
    }
    for (const SceneContents::Light& light : contents.lights) {
        const glm::dvec3 corner = place(light.node, light.corner);
        losses.add(light.node, roundingError(corner), typicalEdge(light));
        composer.append({glm::vec3(corner), light.edge1, light.edge2}, light.material);
    }
    composer.finish();
    losses.warn(scene);
}

}  // namespace duolux

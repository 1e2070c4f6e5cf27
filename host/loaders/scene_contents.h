#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "host/loaders/json_node.h"
#include "host/loaders/material_files.h"
#include "host/scene/mesh.h"
#include "host/scene/scene.h"

namespace duolux {

/// The "objects" and "lights" of a JSON scene, in the coordinates of the files, until the scene's origin is
/// known.
struct SceneContents {
    struct Object {
        JsonNode node;
        std::size_t mesh;
        std::optional<glm::dmat4> transform;
    };
    struct Light {
        JsonNode node;
        glm::dvec3 corner;
        glm::vec3 edge1, edge2;
        Material material;
    };
    struct Point {
        JsonNode node;
        glm::dvec3 position;
        PointEmitter emitter;  ///< except for its position
    };
    explicit SceneContents(Reading reading) : materialFiles(reading) {}

    MaterialFiles materialFiles;
    std::vector<Mesh> meshes;  ///< each file once, even if several objects use it
    std::vector<Object> objects;
    std::vector<Light> lights;
    std::vector<Point> points;
};

/// See originFor.
glm::dvec3 originOf(const SceneContents& contents);

/// Moves the objects from the contents to a scene whose origin is set. Throws InputError.
void appendObjects(SceneContents& contents, LoadedScene& scene);

/// Adds the lights to the scene. Throws InputError.
void appendLights(const SceneContents& contents, LoadedScene& scene);

}  // namespace duolux

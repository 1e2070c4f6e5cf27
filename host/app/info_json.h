#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "host/scene/scene.h"

namespace duolux {

/// The output of `duolux info --json`. `lamp`: see addedLamp.
nlohmann::ordered_json infoJson(const LoadedScene& scene, const nlohmann::ordered_json& lamp);

/// The lamp that was added to a scene, as an entry of a scene file's "lights"; null if there is none.
nlohmann::ordered_json addedLamp(const Scene& scene);

/// Converts a position to the coordinates of the scene's file, with enough digits to convert it back exactly.
glm::dvec3 placeInFile(const Scene& scene, const glm::vec3& place);

/// The camera as an entry of a scene file.
nlohmann::ordered_json cameraOf(const Scene& scene);

/// JSON on one line, with spaces after separators.
std::string onOneLine(const nlohmann::ordered_json& json);

/// Bytes that the geometry takes on the host.
std::size_t memoryOf(const Geometry& geometry);

/// Number of triangles that have shading normals.
std::size_t smoothTriangles(const Geometry& geometry);

/// Number of triangles of each material.
std::vector<std::size_t> trianglesOfMaterials(const Scene& scene);

/// The material and the channel that return the largest fraction of the light they receive.
struct LargestFactor {
    std::string material, channel;
    float factor = -1.0f;
    bool mayGrow = false;  ///< the sum over bounces may diverge for some material
};
LargestFactor largestFactor(const Scene& scene);

}  // namespace duolux

#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "host/scene/scene.h"

namespace duolux {

/// All that `duolux info` tells of a scene, for scripts. `lamp`: of addedLamp().
nlohmann::ordered_json infoJson(const LoadedScene& scene, const nlohmann::ordered_json& lamp);

/// The lamp that was added to a scene, as an entry of a scene file's "lights"; null if there is none.
nlohmann::ordered_json addedLamp(const Scene& scene);

/// A place of the scene in the coordinates of its file, with as many digits as give the same place again.
glm::dvec3 placeInFile(const Scene& scene, const glm::vec3& place);

/// The camera as scene files give it.
nlohmann::ordered_json cameraOf(const Scene& scene);

/// JSON on one line, with blanks.
std::string onOneLine(const nlohmann::ordered_json& json);

/// Bytes of geometry on the host.
std::size_t memoryOf(const Geometry& geometry);

/// Triangles that have shading normals.
std::size_t smoothTriangles(const Geometry& geometry);

/// Triangles of each material.
std::vector<std::size_t> trianglesOfMaterials(const Scene& scene);

/// The material and the channel that return the most of the light that meets them.
struct LargestFactor {
    std::string material, channel;
    float factor = -1.0f;
    bool mayGrow = false;  ///< of any material the series of bounces may have no sum
};
LargestFactor largestFactor(const Scene& scene);

}  // namespace duolux

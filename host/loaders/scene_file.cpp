#include "host/loaders/scene_file.h"

#include <algorithm>
#include <cassert>
#include <string_view>
#include <utility>
#include <vector>

#include "host/base/error.h"
#include "host/base/text.h"
#include "host/loaders/json_scene.h"
#include "host/loaders/obj.h"
#include "host/loaders/ply.h"
#include "host/scene/compose.h"

namespace duolux {

namespace fs = std::filesystem;

namespace {

struct MeshFormat {
    std::string_view extension;
    Mesh (*load)(const fs::path& path, MaterialFiles& files);
};
constexpr MeshFormat kMeshFormats[] = {{".obj", loadObj}, {".ply", loadPly}};

std::string extensionOf(const fs::path& path) {
    std::string extension = path.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return extension;
}

/// Null if no mesh format has this extension.
const MeshFormat* meshFormatOf(const fs::path& path) {
    const std::string extension = extensionOf(path);
    const auto* const found =
        std::find_if(std::begin(kMeshFormats), std::end(kMeshFormats),
                     [&](const MeshFormat& format) { return format.extension == extension; });
    return found == std::end(kMeshFormats) ? nullptr : found;
}

SceneFile readMeshScene(const fs::path& path, Reading reading) {
    LoadedScene scene;
    scene.source = path;
    scene.reflectance = *presetReflectance("global");
    MaterialFiles files(reading);
    Mesh mesh = loadMesh(path, files);
    setOrigin(scene, mesh.origin);
    appendMesh(scene, std::move(mesh));
    if (scene.geometry.triangles.empty()) {
        throw InputError(path.string(), "", "every triangle has zero area", "expected triangles with area");
    }
    const std::size_t triangles = scene.geometry.triangles.size();
    return {std::move(scene), {}, triangles, false, false};
}

}  // namespace

bool isMeshPath(const fs::path& path) {
    return meshFormatOf(path) != nullptr;
}

Mesh loadMesh(const fs::path& path, MaterialFiles& files) {
    assert(isMeshPath(path));
    return meshFormatOf(path)->load(path, files);
}

void requireScenePath(const fs::path& path) {
    if (!isMeshPath(path) && extensionOf(path) != ".json")
        throw InputError(path.string(), "", "has no extension of a scene file",
                         "expected .obj, .ply or .json");
}

SceneFile readSceneFile(const fs::path& path, Reading reading) {
    requireScenePath(path);
    return isMeshPath(path) ? readMeshScene(path, reading) : readJsonScene(path, reading);
}

}  // namespace duolux

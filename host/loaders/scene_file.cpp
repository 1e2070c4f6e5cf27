#include "host/loaders/scene_file.h"

#include <algorithm>
#include <cassert>
#include <string_view>
#include <utility>
#include <vector>

#include "host/base/error.h"
#include "host/base/text.h"
#include "host/loaders/gltf.h"
#include "host/loaders/json_scene.h"
#include "host/loaders/ignored_specular.h"
#include "host/loaders/missing_uvs.h"
#include "host/loaders/obj.h"
#include "host/loaders/ply.h"
#include "host/loaders/stl.h"
#include "host/scene/compose.h"

namespace duolux {

namespace fs = std::filesystem;

namespace {

struct MeshFormat {
    std::string_view extension;
    Mesh (*load)(const fs::path& path, MaterialFiles& files);
};
constexpr MeshFormat kMeshFormats[] = {
    {".obj", loadObj}, {".ply", loadPly}, {".stl", loadStl}, {".gltf", loadGltf}, {".glb", loadGltf}};

constexpr std::string_view kJsonExtension = ".json";

std::string extensionOf(const fs::path& path) {
    return lowerCase(path.extension().string());
}

std::vector<std::string_view> listMeshExtensions() {
    std::vector<std::string_view> extensions;
    for (const MeshFormat& format : kMeshFormats)
        extensions.push_back(format.extension);
    return extensions;
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
    const CameraChoice camera = mesh.camera;
    appendMesh(scene, std::move(mesh));
    if (scene.geometry.triangles.empty()) {
        throw InputError(path.string(), "", "every triangle has zero area", "expected triangles with area");
    }
    const std::size_t triangles = scene.geometry.triangles.size();
    return {std::move(scene), camera, triangles, false, false};
}

}  // namespace

std::string meshExtensions() {
    return alternatives(listMeshExtensions());
}

std::string sceneExtensions() {
    std::vector<std::string_view> extensions = listMeshExtensions();
    extensions.push_back(kJsonExtension);
    return alternatives(extensions);
}

bool isMeshPath(const fs::path& path) {
    return meshFormatOf(path) != nullptr;
}

Mesh loadMesh(const fs::path& path, MaterialFiles& files) {
    assert(isMeshPath(path));
    return meshFormatOf(path)->load(path, files);
}

void requireScenePath(const fs::path& path) {
    if (!isMeshPath(path) && extensionOf(path) != kJsonExtension)
        throw InputError(path.string(), "", "has no extension of a scene file",
                         "expected " + sceneExtensions());
}

SceneFile readSceneFile(const fs::path& path, Reading reading) {
    requireScenePath(path);
    SceneFile file = isMeshPath(path) ? readMeshScene(path, reading) : readJsonScene(path, reading);
    warnOfMissingUvs(file.scene);
    warnOfIgnoredSpecular(file.scene);
    return file;
}

}  // namespace duolux

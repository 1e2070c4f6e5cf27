#include "host/scene/load.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <utility>

#include "host/base/error.h"
#include "host/base/memory.h"
#include "host/base/printable.h"
#include "host/scene/compose.h"
#include "host/scene/default_light.h"
#include "host/scene/frame_camera.h"
#include "host/scene/hash.h"
#include "host/scene/json_scene.h"
#include "host/scene/mesh.h"

namespace duolux {

namespace {

Scene readObjScene(const std::filesystem::path& path) {
    Scene scene;
    scene.source = path;
    scene.reflectance = *presetReflectance("global");
    appendMesh(scene, loadObj(path));
    if (scene.geometry.triangles.empty()) {
        throw InputError(path.string(), "", "every triangle has zero area", "expected triangles with area");
    }
    scene.camera = frameCamera(scene);
    return scene;
}

void addMissingLight(Scene& scene, bool explicitLights) {
    if (anyEmitter(scene)) return;
    if (explicitLights) {
        scene.warnings.emplace_back("nothing emits light: the picture will be black");
    } else {
        addDefaultLight(scene);
    }
}

Scene load(const std::filesystem::path& path) {
    std::string extension = path.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    Scene scene;
    if (extension == ".obj") {
        scene = readObjScene(path);
        addMissingLight(scene, false);
    } else if (extension == ".json") {
        JsonScene read = readJsonScene(path);
        scene = std::move(read.scene);
        addMissingLight(scene, read.hasLights);
    } else {
        throw InputError(path.string(), "", "is not a scene by its extension", "expected .obj or .json");
    }
    for (std::string& warning : scene.warnings)
        warning = printable(warning);
    scene.hash = hashScene(scene);
    return scene;
}

}  // namespace

Scene loadScene(const std::filesystem::path& path) {
    return withMemoryToRead(path, [&] { return load(path); });
}

}  // namespace duolux

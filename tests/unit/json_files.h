#pragma once

#include <stdexcept>
#include <string>

#include "tests/unit/scene_files.h"

namespace duolux::test {

/// Scenes around a mesh of two materials.
class JsonTest : public SceneFiles {
  protected:
    JsonTest() {
        write("mesh.obj",
              "mtllib mesh.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl white\nf 1 2 3\nusemtl lamp\nf 3 2 1\n");
        write("mesh.mtl", "newmtl white\nKd 0.5 0.6 0.7\nnewmtl lamp\nKd 0 0 0\nKe 3 2 1\n");
    }

    /// A scene with the mesh and further keys.
    static std::string with(const std::string& keys) {
        return R"({"duolux": 1, "objects": [{"mesh": "mesh.obj"}])" + (keys.empty() ? "" : ", " + keys) + "}";
    }
    LoadedScene sceneWith(const std::string& keys) const { return loadJson(with(keys)); }
    std::string errorWith(const std::string& keys) const { return errorOfJson(with(keys)); }

    static const Material& material(const LoadedScene& scene, const std::string& name) {
        for (const Material& material : scene.materials) {
            if (material.name == name) return material;
        }
        throw std::out_of_range(name);
    }
};

}  // namespace duolux::test

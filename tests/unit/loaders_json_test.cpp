#include <fmt/format.h>

#include "tests/unit/json_files.h"

namespace duolux::test {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

TEST_F(JsonTest, Defaults) {
    const LoadedScene scene = sceneWith("");
    EXPECT_EQ(scene.settings.width, 512u);
    EXPECT_EQ(scene.settings.height, 512u);
    EXPECT_EQ(scene.settings.spp, 64u);
    EXPECT_EQ(scene.settings.bounces, 16u);
    EXPECT_EQ(scene.settings.sampler, Sampler::kSobol);
    EXPECT_EQ(scene.display, glm::vec2(0, 1));
    EXPECT_EQ(scene.reflectance, presetReflectance("global"));
    EXPECT_EQ(scene.geometry.triangles.size(), 2u);
    EXPECT_THAT(textsOf(scene.warnings), IsEmpty());
}

TEST_F(JsonTest, EveryKey) {
    const LoadedScene scene = sceneWith(R"(
        "camera": {"position": [1, 2, 3], "target": [4, 5, -6], "up": [0, 0, 2], "vfov": 39.5},
        "film": {"width": 640, "height": 1},
        "render": {"spp": 16777216, "bounces": 0, "seed": 4294967295, "sampler": "independent"},
        "display": [1, 0.5],
        "reflectance": {"blend": [0.25, 0.75]},
        "materials": {"white": {"diffuse": 0.25, "sides": "front", "reflectance": {"preset": "local"}},
                      "lamp": {"base_color": [1, 0.5, 0.25], "metallic": 0.75, "roughness": 0.125,
                               "emission": {"visible": [0, 0, 0.5], "sides": "both"}}})");
    EXPECT_EQ(scene.camera.position, glm::vec3(1, 2, 3));
    EXPECT_EQ(scene.camera.target, glm::vec3(4, 5, -6));
    EXPECT_EQ(scene.camera.up, glm::vec3(0, 0, 2));
    EXPECT_EQ(scene.camera.vfov, 39.5f);
    EXPECT_EQ(scene.settings.width, 640u);
    EXPECT_EQ(scene.settings.height, 1u);
    EXPECT_EQ(scene.settings.spp, 16777216u);
    EXPECT_EQ(scene.settings.bounces, 0u);
    EXPECT_EQ(scene.settings.seed, 4294967295u);
    EXPECT_EQ(scene.settings.sampler, Sampler::kIndependent);
    EXPECT_EQ(scene.display, glm::vec2(1.0f, 0.5f));
    EXPECT_EQ(scene.reflectance, blendReflectance(0.25f, 0.75f));
    const Material& white = material(scene, "white");
    EXPECT_EQ(white.baseColor, glm::vec3(0.25f));
    EXPECT_EQ(white.sides, Sides::kFront);
    EXPECT_EQ(white.reflectance, presetReflectance("local"));
    EXPECT_EQ(white.metallic, 0.0f);
    EXPECT_EQ(white.roughness, 1.0f);
    const Material& lamp = material(scene, "lamp");
    EXPECT_EQ(lamp.baseColor, glm::vec3(1.0f, 0.5f, 0.25f));
    EXPECT_EQ(lamp.metallic, 0.75f);
    EXPECT_EQ(lamp.roughness, 0.125f);
    EXPECT_EQ(lamp.emission.invisible, glm::vec3(3, 2, 1)) << "what is not overridden stays as in the MTL";
    EXPECT_EQ(lamp.emission.visible, glm::vec3(0, 0, 0.5f));
    EXPECT_EQ(lamp.emission.sides, Sides::kBoth);
    EXPECT_FALSE(lamp.reflectance.has_value());
}

TEST_F(JsonTest, ReflectanceMatrices) {
    const LoadedScene scene = sceneWith(R"("reflectance": {
        "opaque": [[1, 2], [[3, 4, 5], 6]], "transparent": [[0.1, 0], [[0, 0.5, 1], 7]]})");
    const Reflectance& r = scene.reflectance;
    EXPECT_EQ(r.opaque.m00, glm::vec3(1));
    EXPECT_EQ(r.opaque.m01, glm::vec3(2));
    EXPECT_EQ(r.opaque.m10, glm::vec3(3, 4, 5));
    EXPECT_EQ(r.opaque.m11, glm::vec3(6));
    EXPECT_EQ(r.transparent.m00, glm::vec3(0.1f));
    EXPECT_EQ(r.transparent.m10, glm::vec3(0, 0.5f, 1));
    EXPECT_EQ(r.transparent.m11, glm::vec3(7));
}

TEST_F(JsonTest, EveryPreset) {
    for (const Preset& preset : presets()) {
        const LoadedScene scene = sceneWith(fmt::format(R"("reflectance": {{"preset": "{}"}})", preset.name));
        EXPECT_EQ(scene.reflectance, blendReflectance(preset.t, preset.o));
    }
}

TEST_F(JsonTest, RectangleLightEmitsAlongEdge1CrossEdge2) {
    const LoadedScene scene =
        sceneWith(R"("lights": [{"type": "rectangle", "origin": [0, 5, 0], "edge1": [2, 0, 0],
        "edge2": [0, 0, 3], "emission": {"invisible": [4, 5, 6], "visible": 0}, "reflectance": {"preset": "local"}}])");
    ASSERT_EQ(scene.geometry.triangles.size(), 4u);
    for (const std::size_t i : {2u, 3u}) {
        EXPECT_THAT(areaVector(scene.geometry, i), IsNear(glm::vec3(0, -3, 0), 1e-6f));
        const Material& light = scene.materials[scene.geometry.materials[i]];
        EXPECT_EQ(light.name, "lights[0]");
        EXPECT_EQ(light.baseColor, glm::vec3(0));
        EXPECT_EQ(light.emission.invisible, glm::vec3(4, 5, 6));
        EXPECT_EQ(light.emission.visible, glm::vec3(0));
        EXPECT_EQ(light.emission.sides, Sides::kFront);
        EXPECT_EQ(light.reflectance, presetReflectance("local"));
    }
    const Bounds bounds = boundsOf(scene.geometry);
    EXPECT_EQ(bounds.upper, glm::vec3(2, 5, 3));
}

TEST_F(JsonTest, LightsAloneAreAScene) {
    const LoadedScene scene = loadJson(R"({"duolux": 1, "lights": [{"type": "rectangle", "origin": [0, 0, 0],
        "edge1": [1, 0, 0], "edge2": [0, 1, 0], "emission": {"visible": 1}}]})");
    EXPECT_EQ(scene.geometry.triangles.size(), 2u);
    EXPECT_GT(scene.camera.position.z, 0.0f);
}

TEST_F(JsonTest, ObjectsShareEqualMaterials) {
    const LoadedScene scene = loadJson(R"({"duolux": 1, "objects": [{"mesh": "mesh.obj"}, {"mesh": "mesh.obj",
        "transform": [1,0,0,5, 0,1,0,0, 0,0,1,0, 0,0,0,1]}]})");
    EXPECT_EQ(scene.geometry.triangles.size(), 4u);
    EXPECT_EQ(scene.materials.size(), 2u);
    EXPECT_EQ(scene.geometry.positions[scene.geometry.triangles[2].x], glm::vec3(5, 0, 0));
}

TEST_F(JsonTest, MeshPathsAreRelativeToTheSceneFile) {
    std::filesystem::create_directory(folder_ / "deep");
    write("deep/scene.json", R"({"duolux": 1, "objects": [{"mesh": "../mesh.obj"}]})");
    EXPECT_EQ(load("deep/scene.json").geometry.triangles.size(), 2u);
}

TEST_F(JsonTest, PointLights) {
    const LoadedScene scene = sceneWith(R"("lights": [{"type": "point", "position": [1, 2, 3],
        "emission": {"invisible": [4, 5, 6], "visible": 7}}])");
    ASSERT_EQ(scene.pointEmitters.size(), 1u);
    EXPECT_EQ(scene.pointEmitters[0].position, glm::vec3(1, 2, 3));
    EXPECT_EQ(scene.pointEmitters[0].invisible, glm::vec3(4, 5, 6));
    EXPECT_EQ(scene.pointEmitters[0].visible, glm::vec3(7));
}

TEST_F(JsonTest, MeshPathsMayHaveBackslashes) {
    std::filesystem::create_directories(folder_ / "meshes");
    write("meshes/a.obj", kTriangleObj);
    EXPECT_EQ(loadJson(R"({"duolux": 1, "objects": [{"mesh": "meshes\\a.obj"}], "lights": []})")
                  .geometry.triangles.size(),
              1u);
    write("meshes\\a.obj", std::string(kTriangleObj) + "f 1 3 2\n");
    EXPECT_EQ(loadJson(R"({"duolux": 1, "objects": [{"mesh": "meshes\\a.obj"}], "lights": []})")
                  .geometry.triangles.size(),
              2u)
        << "a file of exactly this name comes first";
    EXPECT_THAT(errorOfJson(R"({"duolux": 1, "objects": [{"mesh": "meshes\\b.obj"}]})"),
                HasSubstr("objects[0].mesh: there is no file "));
}

TEST_F(JsonTest, StatedLimitsAreAccepted) {
    const LoadedScene scene =
        loadJson(R"({"duolux": 1, "display": [1e6, 1e6], "reflectance": {"opaque": [[1e6, 0], [0, 0]],
        "transparent": [[0, 0], [0, 0]]}, "lights": [{"type": "rectangle", "origin": [0, 0, 0], "edge1": [1e9, 0, 0],
        "edge2": [0, 1e9, 0], "emission": {"invisible": 1e12, "visible": [1e12, 0, 1e12]}}]})");
    EXPECT_EQ(scene.materials[0].emission.invisible, glm::vec3(1e12f));
    EXPECT_EQ(scene.materials[0].emission.visible, glm::vec3(1e12f, 0, 1e12f));
}

}  // namespace
}  // namespace duolux::test

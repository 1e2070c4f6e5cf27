// Loading time is proportional to the size of a scene.
#include <fmt/format.h>

#include <ctime>
#include <string>

#include "tests/unit/scene_files.h"

namespace duolux::test {
namespace {

using testing::HasSubstr;

class ManyTest : public SceneFiles {
  protected:
    static constexpr int kMany = 20'000;

    /// Takes tenths of a second. Searching all other items for each item would take several seconds.
    LoadedScene loadSoon(const std::string& name) const {
        const std::clock_t start = std::clock();
        LoadedScene scene = load(name);
        EXPECT_LT(static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC, 2.0);
        return scene;
    }

    std::string repeated(const char* text) const {
        std::string all;
        for (int i = 0; i < kMany; ++i)
            all += fmt::format(fmt::runtime(text), i);
        return all;
    }
};

TEST_F(ManyTest, MaterialsOfMeshAndScene) {
    write("m.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n" + repeated("usemtl m{}\nf 1 2 3\n"));
    write("scene.json", R"({"duolux": 1, "objects": [{"mesh": "m.obj"}], "materials": {)" +
                            repeated("\"m{}\": {{\"diffuse\": 0.25}}, ") + R"("default": {}}})");
    EXPECT_THAT(errorOf("scene.json"), HasSubstr("materials.default: no mesh has a material of this name"));
    std::string materials = repeated("\"m{}\": {{\"diffuse\": 0.25}},");
    materials.pop_back();
    write("scene.json", R"({"duolux": 1, "objects": [{"mesh": "m.obj"}], "materials": {)" + materials + "}}");
    const LoadedScene scene = loadSoon("scene.json");
    EXPECT_EQ(scene.materials[0].baseColor, glm::vec3(0.25f));
    EXPECT_EQ(scene.materials[kMany - 1].baseColor, glm::vec3(0.25f));
}

TEST_F(ManyTest, ObjectsOfOneMeshWarnOnce) {
    write("t.obj", std::string(kTriangleObj) + "f 1 1 2\n");
    write("scene.json", R"({"duolux": 1, "objects": [)" + repeated("{{\"mesh\": \"t.obj\"}}, ") +
                            R"({"mesh": "t.obj", "transform": [1,0,0,5, 0,1,0,0, 0,0,1,0, 0,0,0,1]}]})");
    const LoadedScene scene = loadSoon("scene.json");
    EXPECT_EQ(scene.geometry.triangles.size(), kMany + 1u + 2u);
    EXPECT_EQ(scene.geometry.positions[3 * kMany].x, 5.0f);
    ASSERT_EQ(scene.warnings.size(), 2u);
    EXPECT_THAT(scene.warnings[0].text, HasSubstr("t.obj: 20001 of 40002 triangles left out: zero area"));
}

TEST_F(ManyTest, LinesThatAreContinued) {
    std::string face = "f";
    for (int i = 0; i < 5 * kMany; ++i)
        face += fmt::format(" {} \\\n", 1 + i % 3);
    write("mesh.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n" + face + "\n");
    EXPECT_GT(loadSoon("mesh.obj").geometry.triangles.size(), 0u);
    write("mesh.obj", std::string(kTriangleObj) + "#" + repeated(" {} \\") + "\n");
    loadSoon("mesh.obj");
}

TEST_F(ManyTest, LightsAreNoReasonToLoseTheModel) {
    std::string lights = repeated(
        "{{\"type\": \"rectangle\", \"origin\": [{}, 0, 1], \"edge1\": [1, 0, 0], \"edge2\": [0, 1, 0], "
        "\"emission\": {{\"invisible\": 1}}}},");
    lights.pop_back();
    write("one.obj", kTriangleObj);
    write("scene.json", R"({"duolux": 1, "objects": [{"mesh": "one.obj"}], "lights": [)" + lights + "]}");
    const LoadedScene scene = loadSoon("scene.json");
    EXPECT_LT(glm::distance(scene.camera.target, glm::vec3(0.5f, 0.5f, 0.0f)), 1.0f);
    EXPECT_LT(glm::distance(scene.camera.position, scene.camera.target), 10.0f);
}

TEST_F(ManyTest, Lights) {
    std::string lights = repeated(
        "{{\"type\": \"rectangle\", \"origin\": [{}, 0, 0], \"edge1\": [1, 0, 0], \"edge2\": [0, 1, 0], "
        "\"emission\": {{\"invisible\": 1}}}},");
    lights.pop_back();
    write("scene.json", R"({"duolux": 1, "lights": [)" + lights + "]}");
    EXPECT_EQ(loadSoon("scene.json").geometry.triangles.size(), 2u * kMany);
}

TEST_F(ManyTest, LibrariesThatAreMissingAreOneWarning) {
    write("mesh.obj", repeated("mtllib none{}.mtl\n") + std::string(kTriangleObj));
    const LoadedScene scene = loadSoon("mesh.obj");
    ASSERT_EQ(scene.warnings.size(), 2u);
    EXPECT_THAT(scene.warnings[0].text,
                HasSubstr("none0.mtl: no such file: its materials are grey (19999 more MTL"));
}

}  // namespace
}  // namespace duolux::test

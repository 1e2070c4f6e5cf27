#include <functional>
#include <set>
#include <utility>
#include <vector>

#include "host/scene/hash.h"
#include "tests/unit/scene_files.h"

namespace duolux::test {
namespace {

class HashTest : public SceneFiles {};

TEST_F(HashTest, IsSixteenHexDigitsAndRepeats) {
    const LoadedScene scene = loadObj(kTriangleObj);
    EXPECT_THAT(hashScene(scene), testing::MatchesRegex("[0-9a-f]+"));
    EXPECT_EQ(hashScene(scene).size(), 16u);
    EXPECT_EQ(hashScene(scene), hashScene(loadObj(kTriangleObj)));
}

TEST_F(HashTest, EverythingThatChangesTheImageChangesIt) {
    const Scene original = loadObj(std::string(kTriangleObj) + "vn 0 0 1\nf 1//1 2//1 3//1\n");
    const std::vector<std::function<void(Scene&)>> changes{
        [](Scene& s) { s.geometry.positions[1].x = 2.0f; },
        [](Scene& s) { s.geometry.positions[1].x = -1.0f; },  // the sign is the highest bit of its word
        [](Scene& s) { std::swap(s.geometry.triangles[0].x, s.geometry.triangles[0].y); },
        [](Scene& s) { s.geometry.materials[0] = 1; },
        [](Scene& s) { s.geometry.normals[0].z = 0.5f; },
        [](Scene& s) { s.geometry.normalIndices[1].x = Geometry::kNoNormal; },
        [](Scene& s) { s.geometry.colours.assign(s.geometry.positions.size(), glm::vec3(1.0f)); },
        [](Scene& s) { s.geometry.colours.assign(s.geometry.positions.size(), glm::vec3(0.5f)); },
        [](Scene& s) { s.materials[0].baseColor.y = 0.1f; },
        [](Scene& s) { s.materials[0].sides = Sides::kFront; },
        [](Scene& s) { s.materials[0].emission.visible.z = 1.0f; },
        [](Scene& s) { s.materials[0].emission.sides = Sides::kBoth; },
        [](Scene& s) { s.materials[0].reflectance = presetReflectance("local"); },
        [](Scene& s) { s.reflectance = *presetReflectance("shadowless"); },
        [](Scene& s) { s.camera.position.x += 1.0f; },
        [](Scene& s) { s.camera.target.x += 1.0f; },
        [](Scene& s) { s.camera.up.x += 1.0f; },
        [](Scene& s) { s.camera.vfov += 1.0f; },
        [](Scene& s) { s.display.x = 1.0f; }};
    std::set<std::string> hashes{hashScene(original)};
    for (const auto& change : changes) {
        Scene scene = original;
        change(scene);
        hashes.insert(hashScene(scene));
    }
    EXPECT_EQ(hashes.size(), changes.size() + 1);
}

TEST_F(HashTest, NamesAndSettingsDoNotCount) {
    LoadedScene scene = loadObj(kTriangleObj);
    const std::string original = hashScene(scene);
    scene.materials[0].name = "other";
    scene.settings.spp = 7;
    scene.settings.seed = 9;
    scene.source = "elsewhere.obj";
    scene.warnings.clear();
    EXPECT_EQ(hashScene(scene), original);
}

}  // namespace
}  // namespace duolux::test

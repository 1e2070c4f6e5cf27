#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "host/base/error.h"
#include "host/scene/validate.h"

namespace duolux::test {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinite = std::numeric_limits<float>::infinity();

/// A scene with all that a scene can have.
Scene completeScene() {
    Scene scene;
    scene.geometry.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
    scene.geometry.triangles = {{0, 1, 2}, {1, 3, 2}};
    scene.geometry.materials = {0, 1};
    scene.geometry.normals = {{0, 0, 1}};
    scene.geometry.normalIndices = {{0, 0, 0}, {Geometry::kNoNormal, 5, 5}};
    scene.geometry.colours.assign(4, glm::vec3(1.0f));
    scene.materials.resize(2);
    scene.materials[0].emission.invisible = glm::vec3(1e12f);
    scene.materials[1].reflectance = blendReflectance(1.0f, 3.0f);
    scene.pointEmitters = {{{1, 2, 3}, {1, 1, 1}, {0, 0, 0}}};
    noteContent(scene);
    return scene;
}

std::string problemOf(const Scene& scene) {
    try {
        validate(scene);
    } catch (const InputError& e) {
        return e.what();
    }
    return "none";
}

TEST(Validate, AcceptsWhatIsValid) {
    EXPECT_EQ(problemOf(completeScene()), "none");
    Scene plain = completeScene();
    plain.geometry.normals.clear();
    plain.geometry.normalIndices.clear();
    plain.geometry.colours.clear();
    plain.pointEmitters.clear();
    plain.content = {};
    plain.materials[0].baseColor = glm::vec3(1.5f);  // as OBJ files may
    EXPECT_EQ(problemOf(plain), "none");
}

TEST(Validate, NamesTheFieldThatIsWrong) {
    using Change = std::function<void(Scene&)>;
    const std::vector<std::pair<const char*, Change>> changes{
        {"geometry.triangles: is empty", [](Scene& s) { s.geometry.triangles.clear(); }},
        {"geometry.positions[2]", [](Scene& s) { s.geometry.positions[2].y = kNan; }},
        {"geometry.positions[3]", [](Scene& s) { s.geometry.positions[3].z = -kInfinite; }},
        {"geometry.triangles[1]: is out of range; expected indices below 4",
         [](Scene& s) { s.geometry.triangles[1].z = 4; }},
        {"geometry.triangles[0]", [](Scene& s) { s.geometry.triangles[0].x = 0xffffffffu; }},
        {"geometry.materials: has 1 items; expected 2", [](Scene& s) { s.geometry.materials.pop_back(); }},
        {"geometry.materials: has 0 items", [](Scene& s) { s.geometry.materials.clear(); }},
        {"geometry.materials[1]: is out of range; expected indices below 2",
         [](Scene& s) { s.geometry.materials[1] = 2; }},
        {"geometry.normals[0]", [](Scene& s) { s.geometry.normals[0].x = kInfinite; }},
        {"geometry.normalIndices: has 0 items", [](Scene& s) { s.geometry.normalIndices.clear(); }},
        {"geometry.normalIndices: has 1 items", [](Scene& s) { s.geometry.normalIndices.pop_back(); }},
        {"geometry.normalIndices[0]", [](Scene& s) { s.geometry.normalIndices[0].y = 1; }},
        {"geometry.normalIndices[0]", [](Scene& s) { s.geometry.normals.clear(); }},
        {"geometry.colours: has 5 items; expected 4",
         [](Scene& s) { s.geometry.colours.push_back(glm::vec3(0.0f)); }},
        {"geometry.colours[3]: is out of range; expected numbers from 0 to 1",
         [](Scene& s) { s.geometry.colours[3].z = 1.01f; }},
        {"geometry.colours[0]", [](Scene& s) { s.geometry.colours[0].x = kNan; }},
        {"materials[1].base_color", [](Scene& s) { s.materials[1].baseColor.x = -0.1f; }},
        {"materials[1].base_color", [](Scene& s) { s.materials[1].baseColor.z = kInfinite; }},
        {"materials[0].metallic", [](Scene& s) { s.materials[0].metallic = 1.1f; }},
        {"materials[0].metallic", [](Scene& s) { s.materials[0].metallic = kNan; }},
        {"materials[0].roughness", [](Scene& s) { s.materials[0].roughness = -1.0f; }},
        {"materials[0].emission", [](Scene& s) { s.materials[0].emission.invisible.y = -1.0f; }},
        {"materials[0].emission", [](Scene& s) { s.materials[0].emission.visible.y = kInfinite; }},
        {"materials[1].reflectance.opaque", [](Scene& s) { s.materials[1].reflectance->opaque.m10.y = -1; }},
        {"materials[1].reflectance.transparent",
         [](Scene& s) { s.materials[1].reflectance->transparent.m01.x = kNan; }},
        {"reflectance.opaque", [](Scene& s) { s.reflectance.opaque.m00.x = kInfinite; }},
        {"reflectance.transparent", [](Scene& s) { s.reflectance.transparent.m11.z = -0.5f; }},
        {"pointEmitters[0].position", [](Scene& s) { s.pointEmitters[0].position.x = kNan; }},
        {"pointEmitters[0]: is out of range; expected finite intensities from 0",
         [](Scene& s) { s.pointEmitters[0].invisible.x = -1.0f; }},
        {"pointEmitters[0]", [](Scene& s) { s.pointEmitters[0].visible.x = kInfinite; }},
        {"display", [](Scene& s) { s.display.y = kNan; }},
        {"origin", [](Scene& s) { s.origin.z = std::numeric_limits<double>::infinity(); }},
        {"camera", [](Scene& s) { s.camera.position.x = kNan; }},
        {"camera", [](Scene& s) { s.camera.target.x = kInfinite; }},
        {"camera", [](Scene& s) { s.camera.up.x = kInfinite; }},
        {"camera: position and target are the same", [](Scene& s) { s.camera.target = s.camera.position; }},
        {"camera: up has no direction", [](Scene& s) { s.camera.up = glm::vec3(0.0f); }},
        {"camera: up is parallel to the view direction",
         [](Scene& s) {
             s.camera.up = {0, 0, -2};
         }},
        {"camera.vfov", [](Scene& s) { s.camera.vfov = 180.0f; }},
        {"camera.vfov", [](Scene& s) { s.camera.vfov = kNan; }},
        {"camera.height",
         [](Scene& s) {
             s.camera.type = CameraType::kOrthographic;
             s.camera.height = 0.0f;
         }},
        {"camera.height",
         [](Scene& s) {
             s.camera.type = CameraType::kOrthographic;
             s.camera.height = kInfinite;
         }},
        {"content", [](Scene& s) { s.content.materials = 3; }},
        {"content", [](Scene& s) { s.content.triangles = 3; }},
        {"content", [](Scene& s) { s.content.positions = 5; }},
    };
    for (const auto& [problem, change] : changes) {
        Scene scene = completeScene();
        change(scene);
        EXPECT_THAT(problemOf(scene), testing::StartsWith(std::string("scene: ") + problem));
    }
}

/// What a camera of this type does not have may be anything.
TEST(Validate, IgnoresTheFieldsOfOtherCameras) {
    Scene scene = completeScene();
    scene.camera.height = kNan;
    EXPECT_EQ(problemOf(scene), "none");
    scene.camera.type = CameraType::kOrthographic;
    scene.camera.height = 1.0f;
    scene.camera.vfov = kNan;
    EXPECT_EQ(problemOf(scene), "none");
}

TEST(Validate, SettingsAreWithinTheirRanges) {
    const auto problem = [](std::uint32_t RenderSettings::*field, std::uint32_t value) -> std::string {
        RenderSettings settings;
        settings.*field = value;
        try {
            validate(settings);
        } catch (const UsageError& e) {
            return e.what();
        }
        return "";
    };
    EXPECT_EQ(problem(&RenderSettings::width, 0), "settings: width is 0; expected a number from 1 to 16384");
    EXPECT_EQ(problem(&RenderSettings::height, 16385),
              "settings: height is 16385; expected a number from 1 to 16384");
    EXPECT_EQ(problem(&RenderSettings::spp, 0), "settings: spp is 0; expected a number from 1 to 16777216");
    EXPECT_EQ(problem(&RenderSettings::bounces, 65536),
              "settings: bounces is 65536; expected a number from 0 to 65535");
    EXPECT_EQ(problem(&RenderSettings::width, 16384), "");
    EXPECT_EQ(problem(&RenderSettings::bounces, 0), "");
}

TEST(Validate, ExceptGeometryLeavesItOut) {
    Scene scene = completeScene();
    scene.geometry.positions[0].x = kNan;
    EXPECT_NO_THROW(validateExceptGeometry(scene));
    scene.display.x = kNan;
    EXPECT_THROW(validateExceptGeometry(scene), InputError);
}

}  // namespace
}  // namespace duolux::test

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "host/view/load.h"
#include "tests/unit/scene_files.h"

namespace duolux::test {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

class LampTest : public SceneFiles {
  protected:
    /// The two added triangles come last.
    static void expectLamp(const LoadedScene& scene) {
        const Geometry& geometry = scene.geometry;
        const std::size_t first = geometry.triangles.size() - 2;
        const Material& material = scene.materials[geometry.materials[first]];
        EXPECT_EQ(material.name, "default light");
        EXPECT_EQ(material.emission.visible, glm::vec3(0));
        EXPECT_EQ(material.baseColor, glm::vec3(0));
        const Camera& camera = scene.camera;
        const glm::vec3 forward = glm::normalize(camera.target - camera.position);
        for (std::size_t i = first; i < first + 2; ++i) {
            for (int corner = 0; corner < 3; ++corner) {
                const glm::vec3 position = geometry.positions[geometry.triangles[i][corner]];
                EXPECT_LT(glm::dot(position - camera.position, forward), 0.0f) << "never in view";
            }
        }
    }

    /// Radiance of a small white patch in the middle of the view, as far away as the middle of the scene,
    /// that faces the lamp. Subdivides the lamp.
    static float radianceOfWhite(const LoadedScene& scene) {
        const Geometry& geometry = scene.geometry;
        Geometry seen = geometry;
        seen.triangles.resize(seen.triangles.size() - 2);
        const Bounds bounds = boundsOf(seen);
        const Camera& camera = scene.camera;
        const glm::vec3 forward = glm::normalize(camera.target - camera.position);
        const glm::vec3 middle = 0.5f * (bounds.lower + bounds.upper) - camera.position;
        const glm::vec3 point = camera.position + glm::dot(middle, forward) * forward;
        const glm::uvec3 t = geometry.triangles[geometry.triangles.size() - 2];
        const glm::vec3 origin = geometry.positions[t.x];
        const glm::vec3 edge1 = geometry.positions[t.y] - origin;
        const glm::vec3 edge2 = geometry.positions[t.z] - geometry.positions[t.y];
        const glm::vec3 centre = origin + 0.5f * (edge1 + edge2);
        const glm::vec3 normal = glm::normalize(glm::cross(edge1, edge2));
        const glm::vec3 facing = glm::normalize(centre - point);
        constexpr int kSteps = 50;
        float irradiance = 0.0f;
        for (int i = 0; i < kSteps * kSteps; ++i) {
            const glm::vec3 at = origin + edge1 * ((static_cast<float>(i % kSteps) + 0.5f) / kSteps) +
                                 edge2 * ((static_cast<float>(i / kSteps) + 0.5f) / kSteps);
            const glm::vec3 offset = at - point;
            const float squared = glm::dot(offset, offset);
            const glm::vec3 direction = offset / std::sqrt(squared);
            irradiance += std::max(0.0f, glm::dot(direction, facing)) *
                          std::max(0.0f, -glm::dot(direction, normal)) / squared *
                          glm::length(glm::cross(edge1, edge2)) / (kSteps * kSteps);
        }
        const float radiance = scene.materials[geometry.materials.back()].emission.invisible.x;
        return radiance * irradiance / glm::pi<float>();
    }
};

TEST_F(LampTest, IsAddedToADarkObjWithAWarning) {
    const LoadedScene scene = loadObj(kTriangleObj);
    ASSERT_EQ(scene.geometry.triangles.size(), 3u);
    expectLamp(scene);
    EXPECT_THAT(textsOf(scene.warnings),
                testing::ElementsAre(HasSubstr("nothing emits light: a lamp is added")));
    EXPECT_NEAR(radianceOfWhite(scene), 0.8f, 0.04f);
}

TEST_F(LampTest, LooksTheSameAtEveryScale) {
    for (const char* size : {"0.001", "1000000"}) {
        const std::string s(size);
        const LoadedScene scene = loadObj("v 0 0 0\nv " + s + " 0 0\nv 0 " + s + " 0\nf 1 2 3\n");
        expectLamp(scene);
        EXPECT_NEAR(radianceOfWhite(scene), 0.8f, 0.04f);
    }
}

TEST_F(LampTest, IsNotAddedIfSomethingEmits) {
    write("m.mtl", "newmtl lamp\nKe 1 1 1\n");
    const LoadedScene scene = loadObj("mtllib m.mtl\nusemtl lamp\n" + std::string(kTriangleObj));
    EXPECT_EQ(scene.geometry.triangles.size(), 1u);
    EXPECT_THAT(textsOf(scene.warnings), IsEmpty());
}

TEST_F(LampTest, AnUnusedEmitterDoesNotCount) {
    write("m.mtl", "newmtl lamp\nKe 1 1 1\n");
    expectLamp(loadObj("mtllib m.mtl\n" + std::string(kTriangleObj)));
}

TEST_F(LampTest, IsNotAddedWhereNoSurfaceScatters) {
    write("m.mtl", "newmtl black\nKd 0 0 0\nnewmtl dim\nKd 0 0 0\nKe 0.01 0 0\n");
    write("mesh.obj", "mtllib m.mtl\nusemtl black\n" + std::string(kTriangleObj));
    const LoadedScene dark = load("mesh.obj");
    EXPECT_EQ(dark.geometry.triangles.size(), 1u);
    EXPECT_THAT(textsOf(dark.warnings),
                testing::ElementsAre("all surfaces are black: they neither reflect nor emit "
                                     "light: the picture will be black"));
    // Surfaces that only transmit light, in front of a dim emitter that is seen unchanged.
    write("mesh.obj", "mtllib m.mtl\nusemtl dim\n" + std::string(kTriangleObj) + "usemtl grey\nf 1 3 2\n");
    const LoadedScene seen = loadJson(R"({"duolux": 1, "objects": [{"mesh": "mesh.obj"}], "reflectance":
        {"opaque": [[0, 0], [0, 0]], "transparent": [[1, 0], [0, 1]]}})");
    EXPECT_EQ(seen.geometry.triangles.size(), 2u);
}

TEST_F(LampTest, JsonThatSaysLightsGetsNoOther) {
    write("mesh.obj", kTriangleObj);
    const LoadedScene dark = loadJson(R"({"duolux": 1, "objects": [{"mesh": "mesh.obj"}], "lights": []})");
    EXPECT_EQ(dark.geometry.triangles.size(), 1u);
    EXPECT_THAT(textsOf(dark.warnings), testing::ElementsAre(HasSubstr("the picture will be black")));
}

TEST_F(LampTest, JsonWithoutLightsGetsOneBehindItsCamera) {
    write("mesh.obj", kTriangleObj);
    for (const char* camera : {R"({"position": [0, 0, -3], "target": [0, 0, 0]})",
                               R"({"position": [9, 9, 9], "target": [20, 9, 9], "vfov": 170})",
                               R"({"position": [0.2, 0.2, 5], "target": [0.2, 0.2, 4], "up": [1, 0, 0]})"}) {
        const LoadedScene scene = loadJson(
            std::string(R"({"duolux": 1, "objects": [{"mesh": "mesh.obj"}], "camera": )") + camera + "}");
        ASSERT_EQ(scene.geometry.triangles.size(), 3u);
        expectLamp(scene);
    }
}

/// A plane of 2 x 2 and a small lamp beside it, of radiance `radiance`, which faces it.
std::string planeAndLamp(const char* radiance) {
    return std::string("mtllib m.mtl\nv -1 0 -1\nv -1 0 1\nv 1 0 1\nv 1 0 -1\nf 1 2 3 4\nusemtl ") +
           radiance + "\nv 0 1 0\nv .1 1 0\nv .1 1 .1\nv 0 1 .1\nf 5 6 7 8\n";
}

TEST_F(LampTest, EmittersThatLightNearlyNothingDoNotCount) {
    write("m.mtl", "newmtl dim\nKe 0.01 0 0\nnewmtl bright\nKe 200 200 200\n");
    const LoadedScene dim = loadObj(planeAndLamp("dim"));
    expectLamp(dim);
    EXPECT_THAT(textsOf(dim.warnings), testing::ElementsAre(HasSubstr("less than 5 % of white")));
    const LoadedScene bright = loadObj(planeAndLamp("bright"));
    EXPECT_EQ(bright.geometry.triangles.size(), 4u);
    EXPECT_THAT(textsOf(bright.warnings), IsEmpty());
}

TEST_F(LampTest, IsAddedOrLeftOutAsTheCallerSays) {
    write("m.mtl", "newmtl dim\nKe 0.01 0 0\nnewmtl bright\nKe 200 200 200\n");
    const auto file = write("mesh.obj", planeAndLamp("bright"));
    expectLamp(loadScene(file, {.lamp = Lamp::kAlways}));
    write("mesh.obj", planeAndLamp("dim"));
    const LoadedScene none = loadScene(file, {.lamp = Lamp::kNever});
    EXPECT_EQ(none.geometry.triangles.size(), 4u);
    const LoadedScene dark = loadScene(write("dark.obj", kTriangleObj), {.lamp = Lamp::kNever});
    EXPECT_EQ(dark.geometry.triangles.size(), 1u);
    EXPECT_THAT(textsOf(dark.warnings), testing::ElementsAre(HasSubstr("the picture will be black")));
}

TEST_F(LampTest, StandsInsideAClosedRoomOutOfView) {
    const LoadedScene scene = loadObj(
        "v -2 0 -2\nv 2 0 -2\nv 2 0 2\nv -2 0 2\nv -2 2 -2\nv 2 2 -2\nv 2 2 2\nv -2 2 2\n"
        "f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 3 4 8 7\nf 2 3 7 6\nf 4 1 5 8\n");
    const Geometry& geometry = scene.geometry;
    ASSERT_EQ(geometry.triangles.size(), 14u);
    const auto inside = [](const glm::vec3& p) {
        return glm::all(glm::lessThan(glm::abs(p - glm::vec3(0, 1, 0)), glm::vec3(2, 1, 2)));
    };
    const Camera& camera = scene.camera;
    EXPECT_TRUE(inside(camera.position));
    const glm::vec3 forward = glm::normalize(camera.target - camera.position);
    const glm::vec3 right = glm::normalize(glm::cross(forward, camera.up));
    const glm::vec3 up = glm::cross(right, forward);
    const float tangent = std::tan(glm::radians(camera.vfov) / 2);
    for (std::size_t i = 12; i < 14; ++i) {
        for (int corner = 0; corner < 3; ++corner) {
            const glm::vec3 position = geometry.positions[geometry.triangles[i][corner]];
            EXPECT_TRUE(inside(position));
            const glm::vec3 offset = position - camera.position;
            const float reach = tangent * glm::dot(offset, forward);
            EXPECT_TRUE(std::abs(glm::dot(offset, right)) > reach || std::abs(glm::dot(offset, up)) > reach);
        }
    }
}

}  // namespace
}  // namespace duolux::test

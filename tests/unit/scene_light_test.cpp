#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "tests/unit/scene_files.h"

namespace duolux::test {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

class LightTest : public SceneFiles {
  protected:
    /// The two triangles that were added come last.
    static void expectDefaultLight(const Scene& scene) {
        const Geometry& geometry = scene.geometry;
        const std::size_t first = geometry.triangles.size() - 2;
        const Material& material = scene.materials[geometry.materials[first]];
        EXPECT_EQ(material.name, "default light");
        EXPECT_EQ(material.emission.visible, glm::vec3(0));
        EXPECT_EQ(material.diffuse, glm::vec3(0));
        const Camera& camera = scene.camera;
        const glm::vec3 forward = glm::normalize(camera.target - camera.position);
        for (std::size_t i = first; i < first + 2; ++i) {
            for (int corner = 0; corner < 3; ++corner) {
                const glm::vec3 position = geometry.positions[geometry.triangles[i][corner]];
                EXPECT_LT(glm::dot(position - camera.position, forward), 0.0f) << "never in view";
            }
        }
    }

    /// Irradiance of a small patch at `point` that faces the light, by subdividing the light.
    static float radianceOfWhite(const Scene& scene, const glm::vec3& point) {
        const Geometry& geometry = scene.geometry;
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

TEST_F(LightTest, IsAddedToADarkObjWithAWarning) {
    const Scene scene = loadObj(kTriangleObj);
    ASSERT_EQ(scene.geometry.triangles.size(), 3u);
    expectDefaultLight(scene);
    EXPECT_THAT(scene.warnings, testing::ElementsAre(HasSubstr("default luminaire")));
    EXPECT_NEAR(radianceOfWhite(scene, {0.5f, 0.5f, 0.0f}), 0.8f, 0.04f);
}

TEST_F(LightTest, LooksTheSameAtEveryScale) {
    for (const char* size : {"0.001", "1000000"}) {
        const std::string s(size);
        const Scene scene = loadObj("v 0 0 0\nv " + s + " 0 0\nv 0 " + s + " 0\nf 1 2 3\n");
        expectDefaultLight(scene);
        const float half = 0.5f * std::stof(s);
        EXPECT_NEAR(radianceOfWhite(scene, {half, half, 0.0f}), 0.8f, 0.04f);
    }
}

TEST_F(LightTest, IsNotAddedIfSomethingEmits) {
    write("m.mtl", "newmtl lamp\nKe 1 1 1\n");
    const Scene scene = loadObj("mtllib m.mtl\nusemtl lamp\n" + std::string(kTriangleObj));
    EXPECT_EQ(scene.geometry.triangles.size(), 1u);
    EXPECT_THAT(scene.warnings, IsEmpty());
}

TEST_F(LightTest, AnUnusedEmitterDoesNotCount) {
    write("m.mtl", "newmtl lamp\nKe 1 1 1\n");
    expectDefaultLight(loadObj("mtllib m.mtl\n" + std::string(kTriangleObj)));
}

TEST_F(LightTest, JsonThatSaysLightsGetsNoOther) {
    write("mesh.obj", kTriangleObj);
    const Scene dark = loadJson(R"({"duolux": 1, "objects": [{"mesh": "mesh.obj"}], "lights": []})");
    EXPECT_EQ(dark.geometry.triangles.size(), 1u);
    EXPECT_THAT(dark.warnings, testing::ElementsAre(HasSubstr("the picture will be black")));
}

TEST_F(LightTest, JsonWithoutLightsGetsOneBehindItsCamera) {
    write("mesh.obj", kTriangleObj);
    for (const char* camera : {R"({"position": [0, 0, -3], "target": [0, 0, 0]})",
                               R"({"position": [9, 9, 9], "target": [20, 9, 9], "vfov": 170})",
                               R"({"position": [0.2, 0.2, 5], "target": [0.2, 0.2, 4], "up": [1, 0, 0]})"}) {
        const Scene scene = loadJson(
            std::string(R"({"duolux": 1, "objects": [{"mesh": "mesh.obj"}], "camera": )") + camera + "}");
        ASSERT_EQ(scene.geometry.triangles.size(), 3u);
        expectDefaultLight(scene);
    }
}

}  // namespace
}  // namespace duolux::test

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "host/scene/frame_camera.h"
#include "tests/unit/scene_files.h"

namespace duolux::test {
namespace {

Scene boxScene(const glm::vec3& lower, const glm::vec3& upper, std::uint32_t width, std::uint32_t height) {
    Scene scene;
    scene.geometry.positions = {lower, upper, {lower.x, upper.y, lower.z}};
    scene.geometry.triangles = {{0, 1, 2}};
    scene.geometry.materials = {0};
    scene.render.width = width;
    scene.render.height = height;
    return scene;
}

/// Position in the picture: -1 to 1 from side to side and from bottom to top, depth along the view in z.
glm::vec3 project(const Camera& camera, float aspect, const glm::vec3& point) {
    const glm::vec3 forward = glm::normalize(camera.target - camera.position);
    const glm::vec3 right = glm::normalize(glm::cross(forward, camera.up));
    const glm::vec3 up = glm::cross(right, forward);
    const glm::vec3 offset = point - camera.position;
    const float depth = glm::dot(offset, forward);
    const float tangent = std::tan(glm::radians(camera.vfov) / 2);
    return {glm::dot(offset, right) / (depth * tangent * aspect), glm::dot(offset, up) / (depth * tangent),
            depth};
}

TEST(SceneCamera, AllCornersAreInViewAndOneIsNearTheEdge) {
    const glm::vec3 boxes[][2] = {{{0, 0, 0}, {1, 1, 1}},
                                  {{-50, -2, -3}, {70, 5, 9}},
                                  {{0, 0, 0}, {1, 100, 1}},
                                  {{1000, 1000, 1000}, {1000.5f, 1001, 1400}},
                                  {{0, 0, 0}, {1, 1, 0}}};
    for (const auto& box : boxes) {
        for (const glm::uvec2 size : {glm::uvec2(512, 512), glm::uvec2(900, 300), glm::uvec2(300, 900)}) {
            const Camera camera = frameCamera(boxScene(box[0], box[1], size.x, size.y));
            const float aspect = static_cast<float>(size.x) / static_cast<float>(size.y);
            float farthest = 0.0f;
            for (int i = 0; i < 8; ++i) {
                const glm::vec3 corner(box[i & 1].x, box[(i >> 1) & 1].y, box[(i >> 2) & 1].z);
                const glm::vec3 p = project(camera, aspect, corner);
                EXPECT_GT(p.z, 0.0f);
                farthest = std::max({farthest, std::abs(p.x), std::abs(p.y)});
            }
            EXPECT_LT(farthest, 1.0f);
            EXPECT_GT(farthest, 0.9f) << "no farther away than need be";
        }
    }
}

TEST(SceneCamera, LooksFromTheFrontAndAbove) {
    const Camera camera = frameCamera(boxScene({-1, -1, -1}, {1, 1, 1}, 512, 512));
    EXPECT_EQ(camera.target, glm::vec3(0));
    EXPECT_EQ(camera.position.x, 0.0f);
    EXPECT_GT(camera.position.y, 0.0f);
    EXPECT_GT(camera.position.z, camera.position.y);
}

class CameraTest : public SceneFiles {};

TEST_F(CameraTest, JsonWithoutCameraFramesTheMeshesNotTheLights) {
    write("mesh.obj", kTriangleObj);
    const std::string mesh = R"({"duolux": 1, "objects": [{"mesh": "mesh.obj"}])";
    const Scene alone = loadJson(mesh + "}");
    const Scene lit =
        loadJson(mesh + R"(, "lights": [{"type": "rectangle", "origin": [0, 90, 0], "edge1": [9, 0, 0],
        "edge2": [0, 0, 9], "emission": {"invisible": 1}}]})");
    EXPECT_EQ(alone.camera.position, lit.camera.position);
    EXPECT_EQ(alone.camera.target, glm::vec3(0.5f, 0.5f, 0.0f));
}

}  // namespace
}  // namespace duolux::test

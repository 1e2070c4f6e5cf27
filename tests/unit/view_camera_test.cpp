#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "host/view/load.h"
#include "tests/support/scene_builder.h"
#include "tests/unit/scene_files.h"
#include "tests/unit/view_framed.h"

namespace duolux::test {
namespace {

glm::vec3 viewOf(const Camera& camera) {
    return glm::normalize(camera.target - camera.position);
}

/// Position in the image: -1 to 1 from side to side and from bottom to top, depth along the view in z.
glm::vec3 project(const Camera& camera, float aspect, const glm::vec3& point) {
    const glm::vec3 forward = viewOf(camera);
    const glm::vec3 right = glm::normalize(glm::cross(forward, camera.up));
    const glm::vec3 up = glm::cross(right, forward);
    const glm::vec3 offset = point - camera.position;
    const float depth = glm::dot(offset, forward);
    const bool parallel = camera.type == CameraType::kOrthographic;
    const float half = parallel ? camera.height / 2 : depth * std::tan(glm::radians(camera.vfov) / 2);
    return {glm::dot(offset, right) / (half * aspect), glm::dot(offset, up) / half, depth};
}

TEST(ViewCamera, EverythingIsInViewAndTouchesOppositeEdges) {
    const glm::vec3 boxes[][2] = {{{0, 0, 0}, {1, 1, 1}},
                                  {{-50, -2, -3}, {70, 5, 9}},
                                  {{0, 0, 0}, {1, 100, 1}},
                                  {{1000, 1000, 1000}, {1000.5f, 1001, 1400}},
                                  {{0, 0, 0}, {1, 1, 1e-4f}}};
    for (const auto& box : boxes) {
        for (const glm::uvec2 size : {glm::uvec2(512, 512), glm::uvec2(900, 300), glm::uvec2(300, 900)}) {
            for (const float vfov : {0.0f, 5.0f, 40.0f, 120.0f}) {
                CameraChoice choice;
                if (vfov > 0.0f) {
                    choice.vfov = vfov;
                } else {
                    choice.type = CameraType::kOrthographic;
                }
                const Camera camera = framed(boxScene(box[0], box[1]), choice, size);
                EXPECT_TRUE(vfov == 0.0f || camera.vfov == vfov);
                const float aspect = static_cast<float>(size.x) / static_cast<float>(size.y);
                glm::vec2 lower(9.0f), upper(-9.0f);
                for (int i = 0; i < 8; ++i) {
                    const glm::vec3 corner(box[i & 1].x, box[(i >> 1) & 1].y, box[(i >> 2) & 1].z);
                    const glm::vec3 p = project(camera, aspect, corner);
                    EXPECT_GT(p.z, 0.0f);
                    lower = glm::min(lower, glm::vec2(p));
                    upper = glm::max(upper, glm::vec2(p));
                }
                EXPECT_GT(std::min(lower.x, lower.y), -0.97f);
                EXPECT_LT(std::max(upper.x, upper.y), 0.97f);
                EXPECT_TRUE((lower.x < -0.93f && upper.x > 0.93f) || (lower.y < -0.93f && upper.y > 0.93f))
                    << "no farther away than need be: " << size.x << " " << vfov;
            }
        }
    }
}

TEST(ViewCamera, LooksAtASolidFromTheFrontTheRightAndAbove) {
    for (const float size : {1e-6f, 1.0f, 1e6f}) {
        for (const glm::vec3 at : {glm::vec3(0.0f), 1000.0f * size * glm::vec3(3.0f, -2.0f, 5.0f)}) {
            const Camera camera = framed(boxScene(at - size, at + size));
            const glm::vec3 view = viewOf(camera);
            EXPECT_NEAR(glm::degrees(std::atan2(-view.x, -view.z)), 30.0f, 1.0f);
            EXPECT_NEAR(glm::degrees(std::asin(-view.y)), 35.0f, 1.0f);
            EXPECT_EQ(camera.up, glm::vec3(0, 1, 0));
            EXPECT_LT(glm::distance(camera.target, at), 0.3f * size);
        }
    }
}

TEST(ViewCamera, UpTurnsEverything) {
    CameraChoice choice;
    choice.up = {0, 0, 1};
    const Camera camera = framed(boxScene({-1, -1, -1}, {1, 1, 1}), choice);
    EXPECT_EQ(camera.up, glm::vec3(0, 0, 1));
    const glm::vec3 view = viewOf(camera);
    EXPECT_NEAR(glm::degrees(std::atan2(-view.x, view.y)), 30.0f, 1.0f) << "the front is -y, as in Blender";
    EXPECT_NEAR(glm::degrees(std::asin(-view.z)), 35.0f, 1.0f);
}

TEST(ViewCamera, NothingFlatIsSeenEdgeOn) {
    for (const glm::vec3 normal :
         {glm::vec3(1, 0, 0), glm::vec3(0, 1, 0), glm::vec3(0, 0, 1), glm::vec3(1, 1, 0),
          glm::vec3(1, 0.1f, -1), glm::vec3(0, 1, -0.1f), glm::vec3(-1, -3, -2), glm::vec3(0.1f, -1, 0)}) {
        const glm::vec3 n = glm::normalize(normal);
        const glm::vec3 a = glm::normalize(glm::cross(n, glm::vec3(0.3f, 0.5f, 0.7f)));
        const glm::vec3 b = glm::cross(n, a);
        SceneBuilder builder;
        builder.quad(-a - b, a - b, a + b, b - a, builder.add(Material{}));
        const glm::vec3 view = viewOf(framed(builder.scene));
        EXPECT_GT(std::abs(glm::dot(view, n)), 0.4f) << n.x << " " << n.y << " " << n.z;
    }
}

/// The open box with a lamp in it.
LoadedScene litBox(const glm::vec3& opening, bool inward) {
    SceneBuilder builder;
    builder.scene = openBox(opening, inward);
    Material lamp;
    lamp.emission.invisible = glm::vec3(9.0f);
    const std::uint32_t material = builder.add(lamp);
    builder.quad({-0.3f, 0.9f, -0.3f}, {0.3f, 0.9f, -0.3f}, {0.3f, 0.9f, 0.3f}, {-0.3f, 0.9f, 0.3f},
                 material);
    return builder.scene;
}

TEST(ViewCamera, LooksIntoOpenBoxes) {
    for (const glm::vec3& opening : kOpenings) {
        for (const LoadedScene& scene : {openBox(opening, true), openBox(opening, false),
                                         litBox(opening, true), litBox(opening, false)}) {
            const Camera camera = framed(scene);
            EXPECT_LT(glm::dot(viewOf(camera), opening), -0.95f) << opening.x << " " << opening.z;
            EXPECT_GT(glm::dot(camera.position, opening), 1.0f);
        }
    }
    for (const bool inward : {true, false})
        EXPECT_LT(viewOf(framed(openBox({0, 1, 0}, inward))).y, -0.5f) << "from above";
}

TEST(ViewCamera, LooksIntoOpenBoxesWithThickWalls) {
    SceneBuilder builder;
    const std::uint32_t material = builder.add(Material{});
    const auto wall = [&](glm::vec3 lower, glm::vec3 upper) {
        builder.box(lower, upper, Facing::kOutward, material);
    };
    wall({-1.2f, -1.2f, -1.2f}, {1.2f, -1, 1.2f});
    wall({-1.2f, 1, -1.2f}, {1.2f, 1.2f, 1.2f});
    wall({-1.2f, -1, -1.2f}, {-1, 1, 1.2f});
    wall({1, -1, -1.2f}, {1.2f, 1, 1.2f});
    wall({-1, -1, 1}, {1, 1, 1.2f});
    wall({-0.6f, -1, -0.5f}, {-0.1f, 0.3f, 0});
    EXPECT_GT(viewOf(framed(builder.scene)).z, 0.95f) << "it is open towards -z";
}

TEST(ViewCamera, ModelsWithoutABottomAreSolid) {
    const Camera open = framed(openBox({0, -1, 0}, false));
    const Camera closed = framed(boxScene(glm::vec3(-1), glm::vec3(1)));
    EXPECT_LT(glm::distance(viewOf(open), viewOf(closed)), 1e-3f);
}

TEST(ViewCamera, AFewTrianglesFarAwayAreLeftOut) {
    const LoadedScene box = boxScene({-1, -1, -1}, {1, 1, 1});
    const Camera alone = framed(box);
    for (const float distance : {20.0f, 1e3f, 1e6f}) {
        SceneBuilder builder;
        builder.scene = box;
        builder.triangle({distance, 0, 0}, {distance + 1, 0, 0}, {distance, 1, 0}, 0);
        const Camera camera = framed(builder.scene);
        EXPECT_LT(glm::distance(camera.position, alone.position), 0.01f) << distance;
        EXPECT_LT(glm::distance(camera.target, alone.target), 0.01f) << distance;
    }
    // Shows triangles that are not relatively far away, and parts that are as large as the rest.
    SceneBuilder near;
    near.scene = box;
    near.triangle({4, 0, 0}, {5, 0, 0}, {4, 1, 0}, 0);
    EXPECT_GT(framed(near.scene).position.x, alone.position.x + 1.0f);
    SceneBuilder two;
    two.scene = box;
    two.box({99, -1, -1}, {101, 1, 1}, Facing::kOutward, 0);
    EXPECT_GT(glm::length(framed(two.scene).position), 100.0f);
}

TEST(ViewCamera, TheCornellBoxIsSeenAsUsual) {
    const Camera camera = loadScene(DUOLUX_ASSETS "/cornell/cornell.obj").camera;
    EXPECT_LT(camera.position.z, -500.0f);
    EXPECT_NEAR(camera.position.x, 278.0f, 5.0f);
    EXPECT_NEAR(camera.position.y, 274.0f, 10.0f);
    EXPECT_GT(viewOf(camera).z, 0.99f);
}

TEST(ViewCamera, ManyTrianglesAreFramedAsFew) {
    const Camera coarse = framed(terrain(40)), fine = framed(terrain(400));
    EXPECT_LT(glm::distance(viewOf(coarse), viewOf(fine)), 0.01f);
    EXPECT_LT(glm::distance(coarse.position, fine.position), 0.05f * glm::length(coarse.position));
}

TEST(ViewCamera, WhatIsSaidIsKeptAndTheRestFollows) {
    const LoadedScene scene = boxScene({-1, -1, -1}, {1, 1, 1});
    CameraChoice from;
    from.position = {9, 1, 0};
    const Camera seen = framed(scene, from);
    EXPECT_EQ(seen.position, glm::vec3(9, 1, 0));
    EXPECT_LT(glm::length(seen.target), 0.01f);
    EXPECT_NEAR(seen.vfov, 20.0f, 4.0f) << "all of the box, and no more";

    CameraChoice at;
    at.target = {1, 0.5, 1};
    const Camera centred = framed(scene, at);
    EXPECT_EQ(centred.target, glm::vec3(1, 0.5, 1));
    EXPECT_GT(glm::distance(centred.position, glm::vec3(0)), 2.0f);
    EXPECT_LT(glm::dot(viewOf(centred), glm::vec3(1, 0.5f, 1)), 0.2f) << "sees the target";
    for (int i = 0; i < 8; ++i) {
        const glm::vec3 corner(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1);
        const glm::vec3 p = project(centred, 1.0f, corner);
        EXPECT_LT(std::max(std::abs(p.x), std::abs(p.y)), 1.0f);
    }

    CameraChoice down;
    down.position = {0, 5, 0};
    down.target = {0, 0, 0};
    EXPECT_EQ(framed(scene, down).up, glm::vec3(0, 0, -1)) << "y is along the view";
}

class ViewCameraFiles : public SceneFiles {};

TEST_F(ViewCameraFiles, JsonWithoutCameraFramesTheMeshesNotTheLights) {
    write("mesh.obj", kTriangleObj);
    const std::string mesh = R"({"duolux": 1, "objects": [{"mesh": "mesh.obj"}])";
    const LoadedScene alone = loadJson(mesh + R"(, "lights": []})");
    const LoadedScene lit =
        loadJson(mesh + R"(, "lights": [{"type": "rectangle", "origin": [-40, 90, -40], "edge1": [0, 0, 90],
        "edge2": [90, 0, 0], "emission": {"invisible": 1}}]})");
    for (const Scene* scene : {&alone, &lit}) {
        EXPECT_LT(glm::distance(scene->camera.target, glm::vec3(0.4f, 0.4f, 0.0f)), 0.3f);
        EXPECT_LT(glm::distance(scene->camera.position, scene->camera.target), 3.0f);
    }
}

TEST_F(ViewCameraFiles, AnyPartOfAJsonCameraMayBeMissing) {
    write("mesh.obj", kTriangleObj);
    const auto cameraOf = [&](const std::string& keys, const CameraChoice& choice = {}) {
        return loadScene(
                   write("scene.json",
                         R"({"duolux": 1, "objects": [{"mesh": "mesh.obj"}], "camera": {)" + keys + "}}"),
                   {.camera = choice})
            .camera;
    };
    EXPECT_EQ(cameraOf(R"("vfov": 25)").vfov, 25.0f);
    EXPECT_EQ(cameraOf(R"("position": [0, 1, 7])").position, glm::vec3(0, 1, 7));
    EXPECT_EQ(cameraOf(R"("target": [0, 1, 0])").target, glm::vec3(0, 1, 0));
    EXPECT_EQ(cameraOf(R"("up": [1, 0, 0])").up, glm::vec3(1, 0, 0));
    const Camera defaults = cameraOf(R"("position": [0, 1, 7], "target": [0, 1, 0])");
    EXPECT_EQ(defaults.up, glm::vec3(0, 1, 0));
    EXPECT_EQ(defaults.vfov, 40.0f);

    // Each part that the caller specifies takes precedence.
    CameraChoice choice;
    choice.target = {0, 2, 0};
    const Camera mixed = cameraOf(R"("position": [0, 1, 7], "target": [0, 1, 0], "vfov": 50)", choice);
    EXPECT_EQ(mixed.position, glm::vec3(0, 1, 7));
    EXPECT_EQ(mixed.target, glm::vec3(0, 2, 0));
    EXPECT_EQ(mixed.vfov, 50.0f);
}

TEST_F(ViewCameraFiles, AnOrthographicCameraShowsAsMuchAtItsTarget) {
    write("mesh.obj", kTriangleObj);
    const auto cameraOf = [&](const std::string& keys) {
        return loadJson(R"({"duolux": 1, "objects": [{"mesh": "mesh.obj"}], "camera": {)" + keys + "}}")
            .camera;
    };
    const std::string view = R"("position": [0, 1, 7], "target": [0, 1, 0], "type": "orthographic")";
    const Camera given = cameraOf(view + R"(, "height": 3)");
    EXPECT_EQ(given.type, CameraType::kOrthographic);
    EXPECT_EQ(given.height, 3.0f);
    EXPECT_NEAR(cameraOf(view).height, 14.0f * std::tan(glm::radians(20.0f)), 1e-5f);
    const Camera automatic = cameraOf(R"("type": "orthographic")");
    EXPECT_EQ(automatic.type, CameraType::kOrthographic);
    EXPECT_GT(automatic.height, 0.9f) << "the triangle, whose sides are 1, fills it";
    EXPECT_LT(automatic.height, 1.5f);
    EXPECT_EQ(cameraOf(R"("type": "orthographic", "height": 9)").height, 9.0f);
    const Camera from = cameraOf(R"("type": "orthographic", "position": [0.5, 0.5, 7])");
    EXPECT_GT(from.height, 0.9f);
    EXPECT_LT(from.height, 1.5f);
    const Camera at = cameraOf(R"("type": "orthographic", "target": [0, 1, 0])");
    EXPECT_GT(at.height, 1.8f) << "twice the distance to what is farthest from the middle";
    EXPECT_LT(at.height, 3.0f);
    EXPECT_EQ(cameraOf("").type, CameraType::kPerspective);
}

TEST_F(ViewCameraFiles, WhatIsLeftOutIsSaid) {
    const std::string far = std::string(kTriangleObj) + "v 0 0 700\nv .1 0 700\nv 0 .1 700\nf -3 -2 -1\n";
    EXPECT_THAT(
        textsOf(loadObj(far).warnings),
        testing::Contains(testing::HasSubstr("1 triangle is far from the rest (one of the corners is at "
                                             "0, 0, 700)")));
}

TEST_F(ViewCameraFiles, ThePictureThatTheCallerWantsIsFilled) {
    write("mesh.obj", "v 0 0 0\nv 9 0 0\nv 9 1 0\nv 0 1 0\nf 1 2 3 4\n");
    const float square = glm::length(loadScene(folder_ / "mesh.obj").camera.position);
    const float wide =
        glm::length(loadScene(folder_ / "mesh.obj", {.size = glm::uvec2(1600, 200)}).camera.position);
    EXPECT_LT(wide, 0.5f * square);
}

}  // namespace
}  // namespace duolux::test

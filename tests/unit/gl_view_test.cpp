#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "host/tools/gl/vertices.h"
#include "host/tools/gl/view.h"
#include "tests/reference/pinhole.h"
#include "tests/support/scene_builder.h"

namespace duolux::test {
namespace {

LoadedScene scene() {
    SceneBuilder builder;
    builder.box({-1, -2, -3}, {4, 2, 1}, Facing::kOutward, builder.add({}));
    LoadedScene result = builder.scene;
    result.camera = {{5, 6, 8}, {0.5f, -0.5f, 0}, {0.2f, 1, 0}, 35.0f};
    result.settings.width = 60;
    result.settings.height = 40;
    return result;
}

/// Where OpenGL draws a point, in pixels from the top left corner of the window.
glm::vec2 drawnAt(const LoadedScene& s, glm::vec3 point, glm::vec2 jitter,
                  const std::array<float, 4>& window) {
    const glm::vec4 clip =
        projectionMatrix(s, s.settings, jitter, window) * viewMatrix(s.camera) * glm::vec4(point, 1.0f);
    EXPECT_GT(clip.w, 0.0f);
    EXPECT_LE(std::abs(clip.z), clip.w) << "between the clipping planes";
    return {(clip.x / clip.w + 1.0f) / 2.0f * static_cast<float>(s.settings.width),
            (1.0f - clip.y / clip.w) / 2.0f * static_cast<float>(s.settings.height)};
}

class GlView : public testing::TestWithParam<CameraType> {};
INSTANTIATE_TEST_SUITE_P(Cameras, GlView,
                         testing::Values(CameraType::kPerspective, CameraType::kOrthographic),
                         [](const auto& test) { return std::string(nameOf(test.param)); });

TEST_P(GlView, TheCentreOfAPixelShowsWhatTheRenderersCameraSeesAtTheJitter) {
    LoadedScene s = scene();
    s.camera.type = GetParam();
    s.camera.height = 7.0f;
    const reference::Pinhole pinhole(s.camera, s.settings.width, s.settings.height);
    for (const glm::vec2 jitter : {glm::vec2(0.5f, 0.5f), {0.1f, 0.8f}, {0.99f, 0.0f}}) {
        for (const glm::vec2 pixel : {glm::vec2(0, 0), {30, 20}, {59, 39}, {12, 33}}) {
            const reference::Ray ray =
                pinhole.ray(static_cast<double>(pixel.x + jitter.x), static_cast<double>(pixel.y + jitter.y));
            const glm::vec3 point(ray.origin + 9.0 * ray.direction);
            const glm::vec2 at = drawnAt(s, point, jitter, {0, 0, 1, 1});
            EXPECT_NEAR(at.x, pixel.x + 0.5f, 1e-3f);
            EXPECT_NEAR(at.y, pixel.y + 0.5f, 1e-3f);
        }
    }
}

TEST_P(GlView, AWindowMagnifiesItsPart) {
    LoadedScene s = scene();
    s.camera.type = GetParam();
    s.camera.height = 7.0f;
    const reference::Pinhole pinhole(s.camera, s.settings.width, s.settings.height);
    const reference::Ray ray = pinhole.ray(30.0, 10.0);
    // The window's left top corner is at (15, 5) of 60 x 40 pixels; it is half as wide and high as the image.
    const glm::vec2 at =
        drawnAt(s, glm::vec3(ray.origin + 9.0 * ray.direction), {0.5f, 0.5f}, {0.25f, 0.125f, 0.5f, 0.5f});
    EXPECT_NEAR(at.x, 30.0f, 1e-3f);
    EXPECT_NEAR(at.y, 10.0f, 1e-3f);
}

TEST(GlJitter, JittersMeetEdgesOfAnyDirectionAtDifferentPlaces) {
    constexpr std::uint32_t kCount = 64;
    for (const glm::vec2 across : {glm::vec2(1, 0), {0, 1}, {1, 1}, {1, -1}, {1, -2}, {2, 1}, {3, -1}}) {
        std::vector<float> places;
        for (std::uint32_t i = 0; i < kCount; ++i) {
            const glm::vec2 j = jitterOf(i);
            ASSERT_GE(std::min(j.x, j.y), 0.0f);
            ASSERT_LT(std::max(j.x, j.y), 1.0f);
            const float place = glm::dot(j, across);
            places.push_back(place - std::floor(place));  // relative to the pixel
        }
        std::sort(places.begin(), places.end());
        for (std::uint32_t i = 1; i < kCount; ++i) {
            EXPECT_GT(places[i] - places[i - 1], 0.02f / kCount) << across.x << " " << across.y;
            EXPECT_LT(places[i] - places[i - 1], 5.0f / kCount) << across.x << " " << across.y;
        }
    }
}

TEST(GlMesh, SharesCornersOfOneNormalAndGroupsMaterials) {
    SceneBuilder builder;
    const std::uint32_t a = builder.add({});
    const std::uint32_t b = builder.add({});
    builder.quad({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, b);
    builder.quad({0, 0, 0}, {0, 1, 0}, {0, 1, 1}, {0, 0, 1}, a);
    builder.triangle({5, 5, 5}, {5, 5, 5}, {6, 6, 6}, a);  // no area, no normal
    const GlMesh mesh = makeGlMesh(builder.scene);
    EXPECT_EQ(mesh.indices.size(), 12u);
    ASSERT_EQ(mesh.ranges.size(), 2u);
    EXPECT_EQ(mesh.ranges[0].material, a);
    EXPECT_EQ(mesh.ranges[1].first, 6u);
    for (const std::uint32_t index : mesh.indices)
        EXPECT_NEAR(glm::length(mesh.vertices[index].normal), 1.0f, 1e-6f);
}

}  // namespace
}  // namespace duolux::test

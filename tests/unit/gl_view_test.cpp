#include <gtest/gtest.h>

#include <set>

#include "host/gl/vertices.h"
#include "host/gl/view.h"
#include "tests/reference/pinhole.h"
#include "tests/support/scene_builder.h"

namespace duolux::test {
namespace {

Scene scene() {
    SceneBuilder builder;
    builder.box({-1, -2, -3}, {4, 2, 1}, Facing::kOutward, builder.add({}));
    Scene result = builder.scene;
    result.camera = {{5, 6, 8}, {0.5f, -0.5f, 0}, {0.2f, 1, 0}, 35.0f};
    result.render.width = 60;
    result.render.height = 40;
    return result;
}

/// Where OpenGL draws a point, in pixels from the top left corner of the window.
glm::vec2 drawnAt(const Scene& s, glm::vec3 point, glm::vec2 jitter, const std::array<float, 4>& window) {
    const glm::vec4 clip =
        projectionMatrix(s, jitter, window) * viewMatrix(s.camera) * glm::vec4(point, 1.0f);
    EXPECT_GT(clip.w, 0.0f);
    EXPECT_LE(std::abs(clip.z), clip.w) << "between the clipping planes";
    return {(clip.x / clip.w + 1.0f) / 2.0f * static_cast<float>(s.render.width),
            (1.0f - clip.y / clip.w) / 2.0f * static_cast<float>(s.render.height)};
}

TEST(GlView, TheCentreOfAPixelShowsWhatTheRenderersCameraSeesAtTheJitter) {
    const Scene s = scene();
    const reference::Pinhole pinhole(s.camera, s.render.width, s.render.height);
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

TEST(GlView, AWindowMagnifiesItsPart) {
    const Scene s = scene();
    const reference::Pinhole pinhole(s.camera, s.render.width, s.render.height);
    const reference::Ray ray = pinhole.ray(30.0, 10.0);
    // The window's left top corner is at (15, 5) of 60 x 40 pixels; it is half as wide and high as the image.
    const glm::vec2 at =
        drawnAt(s, glm::vec3(ray.origin + 9.0 * ray.direction), {0.5f, 0.5f}, {0.25f, 0.125f, 0.5f, 0.5f});
    EXPECT_NEAR(at.x, 30.0f, 1e-3f);
    EXPECT_NEAR(at.y, 10.0f, 1e-3f);
}

TEST(GlView, JittersCoverThePixelEvenly) {
    for (const std::uint32_t count : {1u, 16u, 64u, 100u}) {
        std::set<int> columns;
        std::set<int> rows;
        glm::dvec2 sum(0.0);
        for (std::uint32_t i = 0; i < count; ++i) {
            const glm::vec2 j = jitterOf(i, count);
            ASSERT_GE(std::min(j.x, j.y), 0.0f);
            ASSERT_LT(std::max(j.x, j.y), 1.0f);
            columns.insert(static_cast<int>(j.x * static_cast<float>(count)));
            rows.insert(static_cast<int>(j.y * static_cast<float>(count)));
            sum += glm::dvec2(j);
        }
        EXPECT_EQ(columns.size(), count);
        EXPECT_EQ(rows.size(), (count & (count - 1)) == 0 ? count : rows.size());
        EXPECT_NEAR(sum.x / count, 0.5, 1e-6);
        EXPECT_NEAR(sum.y / count, 0.5, 0.01);
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

#include <gtest/gtest.h>

#include "host/render/render.h"
#include "tests/statistical/films.h"
#include "tests/support/device.h"
#include "tests/support/scene_builder.h"

// The range of a film: dim and bright light in one scene.

namespace duolux::test {
namespace {

/// Panels in front of the camera that show their emission, and one out of sight.
class FilmRange : public testing::TestWithParam<Integrator> {
  protected:
    FilmRange() {
        LoadedScene& scene = builder_.scene;
        scene.reflectance = *presetReflectance("global");
        scene.camera = {{0, 0, 4}, {0, 0, 0}, {0, 1, 0}, 20.0f};
        scene.settings.width = scene.settings.height = 8;
        scene.settings.bounces = 0;
        scene.settings.spp = 256;
        scene.settings.integrator = GetParam();
    }

    void panel(float left, float right, float visible, float invisible = 0.0f) {
        Material material;
        material.baseColor = glm::vec3(0.0f);
        material.emission.visible = glm::vec3(visible);
        material.emission.invisible = glm::vec3(invisible);
        builder_.quad({left, -2, 0}, {right, -2, 0}, {right, 2, 0}, {left, 2, 0}, builder_.add(material));
    }

    double meanOf(const RenderOutput& output, std::uint32_t firstColumn, std::uint32_t endColumn) {
        const RadianceImage image = output.film.resolve();
        double sum = 0.0;
        for (std::uint32_t row = 0; row < 8; ++row) {
            for (std::uint32_t x = firstColumn; x < endColumn; ++x)
                sum += static_cast<double>(image.visible[row * 8 + x].y);
        }
        return sum / (8.0 * (endColumn - firstColumn));
    }

    /// Exact with the path tracer; with the light tracer, a visible emitter has noise.
    double tolerance() const { return GetParam() == Integrator::kLightTracer ? 0.05 : 1e-4; }

    SceneBuilder builder_;
};

// A lamp 10^17 times as bright, which the camera does not see. (Hardly any light path starts at the panel.)
TEST_P(FilmRange, DimLightIsKeptBesideBrightEmittersOutOfSight) {
    builder_.scene.settings.integrator = Integrator::kPathTracer;
    panel(-2.0f, 2.0f, 1e-5f);
    panel(30.0f, 31.0f, 0.0f, 1e12f);
    const RenderOutput output = render(device(), builder_.scene);
    EXPECT_NEAR(meanOf(output, 0, 8) / 1e-5, 1.0, 1e-3);
    EXPECT_FALSE(output.statistics.filmOverflowed);
}

// Both in view, with a ratio of 10^8: both are held without bias.
TEST_P(FilmRange, BrightAndDimInOnePicture) {
    panel(-2.0f, 0.0f, 1e-4f);
    panel(0.0f, 2.0f, 1e4f);
    const RenderOutput output = render(device(), builder_.scene);
    EXPECT_NEAR(meanOf(output, 5, 8) / 1e4, 1.0, tolerance());
    if (GetParam() == Integrator::kPathTracer) {
        // A quantum is 2^-30 of about 5000: 0.047 of the dim value. The limit is 5 standard errors of 6144
        // samples.
        EXPECT_NEAR(meanOf(output, 0, 3) / 1e-4, 1.0, 0.02);
    }
    EXPECT_FALSE(output.statistics.filmOverflowed);
}

INSTANTIATE_TEST_SUITE_P(Integrators, FilmRange,
                         testing::Values(Integrator::kPathTracer, Integrator::kLightTracer),
                         [](const auto& tested) { return std::string(nameOf(tested.param)); });

// An emitter in a pixel that the first look misses, 10^14 times as bright as the rest.
TEST(FilmOverflow, BeyondTheFilmIsClampedAndTold) {
    SceneBuilder builder;
    LoadedScene& scene = builder.scene;
    scene.reflectance = *presetReflectance("global");
    scene.camera = {{0, 0, 4}, {0, 0, 0}, {0, 1, 0}, 40.0f};
    scene.settings.width = scene.settings.height = 256;
    scene.settings.bounces = 0;
    scene.settings.spp = 1;
    Material wall, spot;
    wall.emission.visible = glm::vec3(1.0f);
    spot.emission.visible = glm::vec3(1e14f);
    builder.quad({-9, -9, 0}, {9, -9, 0}, {9, 9, 0}, {-9, 9, 0}, builder.add(wall));
    // The first look takes pixels 4 k + 2; this is pixel (128, 127).
    const float pixel = 2.0f * 4.0f * std::tan(glm::radians(20.0f)) / 256.0f, z = 1e-3f;
    builder.quad({0.1f * pixel, 0.1f * pixel, z}, {0.9f * pixel, 0.1f * pixel, z},
                 {0.9f * pixel, 0.9f * pixel, z}, {0.1f * pixel, 0.9f * pixel, z}, builder.add(spot));
    scene.settings.spp = 16;
    const RenderOutput output = render(device(), scene);
    EXPECT_TRUE(output.statistics.filmOverflowed);
    const RadianceImage image = output.film.resolve();
    const float largest = static_cast<float>(output.film.largestRadiance());
    EXPECT_GE(largest, 0x1p28f);
    EXPECT_GT(image.visible[127 * 256 + 128].x, 0.3f * largest);
    EXPECT_LE(image.visible[127 * 256 + 128].x, largest);
    EXPECT_EQ(image.visible[0].x, 1.0f);
    // The film holds less bright emitters, although the first look misses them.
    for (Material& material : scene.materials)
        material.emission.visible = glm::min(material.emission.visible, glm::vec3(5e10f));
    EXPECT_FALSE(render(device(), scene).statistics.filmOverflowed);
}

// 512 light paths in one batch add 2^58 quanta each to the same pixel: in 64 bits, their sum would wrap
// around to 0. The unit of the film is that of an emitter 10^12 times as dim.
TEST(FilmOverflow, SumsOfLightPathsDoNotWrapAround) {
    SceneBuilder builder;
    LoadedScene& scene = builder.scene;
    scene.reflectance = *presetReflectance("global");
    scene.camera = {{0, 0, 0}, {0, 0, -1}, {0, 1, 0}, 40.0f};
    scene.settings.width = scene.settings.height = 4;
    scene.settings.bounces = 0;
    scene.settings.spp = 1;
    scene.settings.integrator = Integrator::kLightTracer;
    Material lamp;
    lamp.emission.visible = glm::vec3(1e-6f);
    builder.quad({0.01f, 0.01f, -1}, {0.1f, 0.01f, -1}, {0.1f, 0.1f, -1}, {0.01f, 0.1f, -1},
                 builder.add(lamp));
    const RenderState state{render(device(), scene).film};
    scene.materials[0].emission.visible = glm::vec3(1e6f);
    scene.settings.spp = 33;
    RenderControl control;
    control.resume = &state;
    const RenderOutput output = render(device(), scene, control);
    EXPECT_TRUE(output.statistics.filmOverflowed);
    const float largest = static_cast<float>(output.film.largestRadiance());
    EXPECT_GT(output.film.resolve().visible[1 * 4 + 2].x, 0.3f * largest);
}

}  // namespace
}  // namespace duolux::test

#include <gtest/gtest.h>

#include <cstddef>
#include <vector>

#include "host/render/render.h"
#include "host/scene/image_plane.h"
#include "tests/support/device.h"
#include "tests/support/scene_builder.h"
#include "tests/support/tunings.h"

// Vertex colours scale the light that a surface scatters, by a factor that is known at every point.

namespace duolux::test {
namespace {

/// Linear in x and z, so that interpolation over any triangles of the floor reproduces it.
glm::dvec3 colourAt(const glm::dvec3& p) {
    return {0.5 + 0.4 * p.x, 0.5 - 0.3 * p.z, 0.3 + 0.1 * p.x + 0.15 * p.z};
}

/// A floor from -1 to 1, white or with vertex colours, under a large lamp out of view.
LoadedScene floorScene(bool coloured) {
    SceneBuilder builder;
    Material white;
    white.baseColor = glm::vec3(1.0f);
    const std::uint32_t material = builder.add(white);
    // Neighbours share vertices and form pairs, with the shared edge at different corners of the triangles.
    Geometry& geometry = builder.scene.geometry;
    geometry.positions = {{-1, 0, 1}, {0.2f, 0, 1}, {0.2f, 0, -1}, {-1, 0, -1}, {1, 0, -1}, {1, 0, 1}};
    geometry.triangles = {{0, 1, 2}, {0, 2, 3}, {4, 2, 1}, {1, 5, 4}};
    geometry.materials.assign(geometry.triangles.size(), material);
    LoadedScene& scene = builder.scene;
    if (coloured) {
        for (const glm::vec3& position : scene.geometry.positions)
            scene.geometry.colours.emplace_back(colourAt(glm::dvec3(position)));
    }
    Material lamp;
    lamp.baseColor = glm::vec3(0.0f);
    lamp.emission.invisible = glm::vec3(10.0f);
    builder.quad({-4, 3, -4}, {4, 3, -4}, {4, 3, 4}, {-4, 3, 4}, builder.add(lamp));
    scene.geometry.colours.resize(coloured ? scene.geometry.positions.size() : 0, glm::vec3(1.0f));
    scene.reflectance = preset("global");
    scene.camera.position = {0, 2, 0};
    scene.camera.target = {0, 0, 0};
    scene.camera.up = {0, 0, -1};
    scene.camera.vfov = 45.0f;
    scene.settings.width = scene.settings.height = 24;
    scene.settings.spp = 64;
    scene.settings.bounces = 1;
    return scene;
}

void expectColours(Integrator integrator, const TuningChoice& tuning) {
    LoadedScene white = floorScene(false), coloured = floorScene(true);
    RenderControl control;
    control.tuning = tuning;
    white.settings.integrator = coloured.settings.integrator = integrator;
    // Few light paths reach a pixel, and each pixel needs some.
    if (integrator == Integrator::kLightTracer) white.settings.spp = coloured.settings.spp = 2048;
    const std::vector<glm::vec3> expected = render(device(), white, control).film.resolve().visible;
    const std::vector<glm::vec3> actual = render(device(), coloured, control).film.resolve().visible;
    const ImagePlane plane = imagePlane(white.camera, white.settings.width, white.settings.height);
    for (std::uint32_t y = 0; y < white.settings.height; ++y) {
        for (std::uint32_t x = 0; x < white.settings.width; ++x) {
            const glm::vec2 point(
                2.0f * (static_cast<float>(x) + 0.5f) / static_cast<float>(white.settings.width) - 1.0f,
                1.0f - 2.0f * (static_cast<float>(y) + 0.5f) / static_cast<float>(white.settings.height));
            const std::size_t pixel = std::size_t{y} * white.settings.width + x;
            const CameraRay ray = cameraRay(white.camera, plane, point);
            const glm::dvec3 p =
                glm::dvec3(ray.origin) -
                glm::dvec3(ray.direction) * static_cast<double>(ray.origin.y / ray.direction.y);
            const glm::dvec3 ratio = glm::dvec3(actual[pixel]) / glm::dvec3(expected[pixel]);
            // All samples of a pixel are within half its width, 0.0345, of its centre, and colours are stored
            // in steps of at most 0.002.
            for (int c = 0; c < 3; ++c)
                ASSERT_NEAR(ratio[c], colourAt(p)[c], 0.016)
                    << nameOf(integrator) << " " << x << " " << y << " " << c;
        }
    }
}

TEST(VertexColours, ScaleTheLightOfPathsFromTheCamera) {
    for (const TuningChoice& tuning : allTunings(device().info()))
        expectColours(Integrator::kPathTracer, tuning);
}

TEST(VertexColours, ScaleTheLightOfLightPaths) {
    expectColours(Integrator::kLightTracer, {});
}

/// The camera sees the colour of an unlit surface itself, in either integrator.
TEST(VertexColours, ScaleTheEmissionOfUnlitSurfaces) {
    for (const TuningChoice& tuning : allTunings(device().info())) {
        for (const Integrator integrator : {Integrator::kPathTracer, Integrator::kLightTracer}) {
            LoadedScene scene = floorScene(true);
            Material& material = scene.materials[0];
            material.baseColor = glm::vec3(0.0f);
            material.emission.visible = {0.5f, 1.0f, 2.0f};
            material.emission.sides = Sides::kBoth;
            const bool byLight = integrator == Integrator::kLightTracer;
            if (byLight && tuning.layout != allTunings(device().info()).front().layout) continue;
            scene.settings.integrator = integrator;
            scene.settings.spp = byLight ? 4096 : 64;
            RenderControl control;
            control.tuning = tuning;
            const std::vector<glm::vec3> plain = render(device(), scene, control).film.resolve().visible;
            material.unlit = true;
            const std::vector<glm::vec3> unlit = render(device(), scene, control).film.resolve().visible;
            // The middle of the picture, around the centre of the floor, where the colour is (0.5, 0.5, 0.3).
            glm::dvec3 plainMean(0.0), mean(0.0);
            for (std::uint32_t y = 10; y < 14; ++y) {
                for (std::uint32_t x = 10; x < 14; ++x) {
                    plainMean += glm::dvec3(plain[y * 24 + x]) / 16.0;
                    mean += glm::dvec3(unlit[y * 24 + x]) / 16.0;
                }
            }
            const double tolerance = byLight ? 0.1 : 2e-3;
            for (int c = 0; c < 3; ++c) {
                const double expected = static_cast<double>(material.emission.visible[c]);
                EXPECT_NEAR(plainMean[c], expected, tolerance * expected) << nameOf(integrator);
                EXPECT_NEAR(mean[c], expected * colourAt(glm::dvec3(0.0))[c], 2.0 * tolerance * expected)
                    << nameOf(integrator);
            }
        }
    }
}

}  // namespace
}  // namespace duolux::test

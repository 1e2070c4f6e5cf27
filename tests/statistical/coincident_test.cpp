#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "host/render/render.h"
#include "tests/support/device.h"
#include "tests/support/scene_builder.h"
#include "tests/support/tunings.h"

// Coincident surfaces and very large triangles, with both integrators: the image must equal that of slightly
// separated surfaces.

namespace duolux::test {
namespace {

glm::dvec3 meanOf(const RenderOutput& output) {
    const RadianceImage image = output.film.resolve();
    glm::dvec3 sum(0.0);
    for (const glm::vec3& pixel : image.visible)
        sum += glm::dvec3(pixel);
    return sum / static_cast<double>(image.visible.size());
}

double meanBy(LoadedScene scene, Integrator integrator, std::uint32_t spp) {
    scene.settings.integrator = integrator;
    scene.settings.spp = spp;
    return meanOf(render(device(), scene)).y;
}

Material absorbing() {
    Material material;
    material.baseColor = glm::vec3(0.0f);
    return material;
}

class Coincident : public testing::Test {
  protected:
    Coincident() {
        LoadedScene& scene = builder_.scene;
        scene.reflectance = preset("global");
        scene.camera = {{0.02f, 0.03f, 3}, {0.02f, 0.03f, 0}, {0, 1, 0}, 10.0f};
        scene.settings.width = scene.settings.height = 8;
        scene.settings.bounces = 0;
    }
    /// A square about the z axis that faces up, or down if `turned`.
    void pane(float halfWidth, float z, const Material& material, bool turned = false) {
        const float a = halfWidth;
        const std::uint32_t index = builder_.add(material);
        if (turned) {
            builder_.quad({-a, -a, z}, {-a, a, z}, {a, a, z}, {a, -a, z}, index);
        } else {
            builder_.quad({-a, -a, z}, {a, -a, z}, {a, a, z}, {-a, a, z}, index);
        }
    }
    SceneBuilder builder_;
};

// Two filters with matrices that do not commute, of all windings and with or without one being a decal on the
// other. The order is that across a small gap: the one that faces the camera is in front; of two that face
// alike, the first if they face the camera, else the second.
TEST_F(Coincident, FiltersAreMetInOneOrderByBothIntegrators) {
    const ReflectanceMatrix first{glm::vec3(0.5f), glm::vec3(0.0f), glm::vec3(0.8f), glm::vec3(0.1f)};
    const ReflectanceMatrix second{glm::vec3(0.2f), glm::vec3(0.0f), glm::vec3(0.0f), glm::vec3(0.9f)};
    for (const float width : {1.0f, 0.7f}) {
        for (const bool firstTurned : {false, true}) {
            for (const bool secondTurned : {false, true}) {
                const bool firstInFront = !firstTurned;
                const auto scene = [&](float gap) {
                    builder_ = SceneBuilder{builder_.scene};
                    builder_.scene.geometry = {};
                    builder_.scene.materials.clear();
                    Material lamp = absorbing();
                    lamp.emission = {glm::vec3(1.0f), glm::vec3(1.0f), Sides::kFront};
                    pane(1.0f, 0.0f, lamp);
                    pane(1.0f, 1.0f, filter("first", first), firstTurned);
                    pane(width, firstInFront ? 1.0f - gap : 1.0f + gap, filter("second", second),
                         secondTurned);
                    return builder_.scene;
                };
                const double apart = meanBy(scene(0.01f), Integrator::kPathTracer, 16);
                const double path = meanBy(scene(0.0f), Integrator::kPathTracer, 16);
                const double light = meanBy(scene(0.0f), Integrator::kLightTracer, 2048);
                EXPECT_NEAR(path, apart, 1e-5) << width << firstTurned << secondTurned;
                EXPECT_NEAR(light, apart, 0.05 * apart) << width << firstTurned << secondTurned;
            }
        }
    }
}

/// Two coincident sheets, between which a vertex scatters light that has passed one of them: without T of the
/// other, no light from below reaches a camera above. A vertex between them is met from the first, in its own
/// plane.
TEST_F(Coincident, LightThatScattersBetweenSheetsDoesNotLeak) {
    builder_.scene.settings.bounces = 4;
    for (const bool sheetFirst : {false, true}) {
        for (const Integrator integrator : {Integrator::kPathTracer, Integrator::kLightTracer}) {
            builder_ = SceneBuilder{builder_.scene};
            builder_.scene.geometry = {};
            builder_.scene.materials.clear();
            Material wall = absorbing(), sheet, lamp = absorbing();
            wall.baseColor = sheet.baseColor = glm::vec3(0.8f);
            sheet.reflectance = Reflectance{preset("global").opaque, matrix(0.5f, 0.0f, 0.0f, 0.5f)};
            lamp.emission = {glm::vec3(1.0f), glm::vec3(1.0f), Sides::kFront};
            if (sheetFirst) pane(1.0f, 1.0f, sheet);
            pane(1.0f, 1.0f, wall);
            if (!sheetFirst) pane(1.0f, 1.0f, sheet);
            pane(1.0f, 0.0f, lamp);
            EXPECT_EQ(meanBy(builder_.scene, integrator, 2048), 0.0) << sheetFirst;
        }
    }
}

/// A lamp above a floor, and the expected radiance of the floor or the lamp, whichever the camera sees.
class Lamp : public Coincident {
  protected:
    Lamp() {
        LoadedScene& scene = builder_.scene;
        scene.settings.bounces = 1;
        Material floor;
        floor.baseColor = glm::vec3(0.5f);
        builder_.quad({-2, 0, 2}, {2, 0, 2}, {2, 0, -2}, {-2, 0, -2}, builder_.add(floor));
        lookAtFloor();
    }
    void lookAtFloor() { builder_.scene.camera = {{0.3f, 0.5f, 0.2f}, {0.3f, 0.0f, 0.2f}, {0, 0, 1}, 20.0f}; }
    void lookUp() { builder_.scene.camera = {{0.3f, 0.5f, 0.2f}, {0.3f, 1.0f, 0.2f}, {0, 0, 1}, 20.0f}; }
    void plate(float halfWidth, float y, const Material& material, bool frontBelow) {
        const float a = halfWidth;
        const std::uint32_t index = builder_.add(material);
        if (frontBelow) {
            builder_.quad({-a, y, -a}, {a, y, -a}, {a, y, a}, {-a, y, a}, index);
        } else {
            builder_.quad({-a, y, -a}, {-a, y, a}, {a, y, a}, {a, y, -a}, index);
        }
    }
    static Material lamp() {
        Material material = absorbing();
        material.emission = {glm::vec3(1.0f), glm::vec3(1.0f), Sides::kFront};
        return material;
    }
    /// Compares both integrators with a scene that has separated surfaces.
    void expectAs(const LoadedScene& apart) {
        const LoadedScene together = builder_.scene;
        for (const bool up : {false, true}) {
            builder_.scene = apart;
            up ? lookUp() : lookAtFloor();
            const double expected = meanBy(builder_.scene, Integrator::kPathTracer, 512);
            builder_.scene = together;
            up ? lookUp() : lookAtFloor();
            EXPECT_NEAR(meanBy(builder_.scene, Integrator::kPathTracer, 512), expected, 0.01 * expected)
                << up;
            // 4 standard errors.
            EXPECT_NEAR(meanBy(builder_.scene, Integrator::kLightTracer, 8192), expected, 0.08 * expected)
                << up;
        }
    }
};

TEST_F(Lamp, OfTwoFacesShinesBothWays) {
    for (const bool downFirst : {false, true}) {
        const SceneBuilder floor = builder_;
        for (const bool first : {true, false})
            plate(1.0f, first == downFirst ? 1.0f : 1.001f, lamp(), first == downFirst);
        const LoadedScene apart = builder_.scene;
        builder_ = floor;
        for (const bool first : {true, false})
            plate(1.0f, 1.0f, lamp(), first == downFirst);
        expectAs(apart);
        builder_ = floor;
    }
}

TEST_F(Lamp, InThePlaneOfACeilingShines) {
    Material ceiling;
    ceiling.baseColor = glm::vec3(0.3f);
    const SceneBuilder floor = builder_;
    plate(2.0f, 1.0f, ceiling, true);
    plate(0.5f, 0.999f, lamp(), true);
    const LoadedScene apart = builder_.scene;
    for (const bool lampFirst : {false, true}) {
        for (const bool ceilingDown : {false, true}) {
            // From below, the ceiling is in front of the lamp only if it faces down and the lamp does not.
            builder_ = floor;
            if (lampFirst) plate(0.5f, 1.0f, lamp(), true);
            plate(2.0f, 1.0f, ceiling, ceilingDown);
            if (!lampFirst) plate(0.5f, 1.0f, lamp(), true);
            expectAs(apart);
        }
    }
    builder_ = floor;
}

/// The back of the lamp lights the wall that it lies on, and nothing in front of it.
TEST_F(Lamp, WithTwoSidesOnAWallDoesNotShineThroughItself) {
    Material both = lamp(), wall;
    both.emission.sides = Sides::kBoth;
    both.baseColor = wall.baseColor = glm::vec3(1.0f);
    for (const bool lampFirst : {false, true}) {
        for (const Integrator integrator : {Integrator::kPathTracer, Integrator::kLightTracer}) {
            SceneBuilder scene;
            scene.scene.reflectance = preset("global");
            scene.scene.settings = builder_.scene.settings;
            scene.scene.settings.bounces = 2;
            builder_ = scene;
            if (lampFirst) plate(1.0f, 1.0f, both, true);
            plate(3.0f, 1.0f, wall, false);
            if (!lampFirst) plate(1.0f, 1.0f, both, true);
            lookUp();
            EXPECT_NEAR(meanBy(builder_.scene, integrator, 4096), 1.0, 0.02) << lampFirst;
        }
    }
}

// A transmitting surface before a scattering one: the scattering vertex is on the second.
TEST_F(Lamp, LightScattersBehindACoincidentFilter) {
    builder_.scene.reflectance = preset("one-bounce");
    const SceneBuilder floor = builder_;
    Material film = filter("film", matrix(0.5f, 0.0f, 0.0f, 0.5f));
    const auto withFilm = [&](float height) {
        builder_ = floor;
        plate(2.0f, height, film, false);
        plate(1.0f, 1.0f, lamp(), true);
        return builder_.scene;
    };
    // The film faces up like the floor and follows it in the scene, so it is behind the floor unless it is
    // above.
    const LoadedScene above = withFilm(0.001f);
    const double expected = meanBy(above, Integrator::kPathTracer, 512);
    builder_ = floor;
    LoadedScene together = floor.scene;
    {
        SceneBuilder filmFirst;
        filmFirst.scene.reflectance = floor.scene.reflectance;
        filmFirst.scene.camera = floor.scene.camera;
        filmFirst.scene.settings = floor.scene.settings;
        builder_ = filmFirst;
        plate(2.0f, 0.0f, film, false);
        Material floorMaterial;
        floorMaterial.baseColor = glm::vec3(0.5f);
        plate(2.0f, 0.0f, floorMaterial, false);
        plate(1.0f, 1.0f, lamp(), true);
        together = builder_.scene;
    }
    EXPECT_NEAR(meanBy(together, Integrator::kPathTracer, 512), expected, 0.01 * expected);
    EXPECT_NEAR(meanBy(together, Integrator::kLightTracer, 2048), expected, 0.05 * expected);
    // The light crosses the film twice.
    const double bare = [&] {
        builder_ = floor;
        plate(1.0f, 1.0f, lamp(), true);
        return meanBy(builder_.scene, Integrator::kPathTracer, 512);
    }();
    EXPECT_NEAR(expected, 0.25 * bare, 0.02 * bare);
    builder_ = floor;
}

/// A plate slightly above a ground of any size, and its shadow.
LoadedScene groundScene(float reach, bool tilted) {
    SceneBuilder builder;
    Material white, lamp = absorbing();
    white.baseColor = glm::vec3(0.8f);
    lamp.emission = {glm::vec3(100.0f), glm::vec3(0.0f), Sides::kFront};
    const std::uint32_t w = builder.add(white), l = builder.add(lamp);
    const float g = reach;
    builder.quad({-g, 0, -g}, {-g, 0, g}, {g, 0, g}, {g, 0, -g}, w);
    builder.quad({-.5f, .1f, -.5f}, {-.5f, .1f, .5f}, {.5f, .1f, .5f}, {.5f, .1f, -.5f}, w);
    builder.quad({-.1f, 3, -.1f}, {.1f, 3, -.1f}, {.1f, 3, .1f}, {-.1f, 3, .1f}, l);
    LoadedScene& scene = builder.scene;
    scene.reflectance = preset("one-bounce");
    scene.camera = {{1.5f, 2.0f, 3.0f}, {0, 0, 0}, {0, 1, 0}, 30.0f};
    scene.settings.width = scene.settings.height = 32;
    scene.settings.bounces = 1;
    if (tilted) {
        const glm::dmat3 turn(0.6, 0.8, 0.0, -0.64, 0.48, 0.6, 0.48, -0.36, 0.8);
        for (glm::vec3& p : scene.geometry.positions)
            p = glm::vec3(turn * glm::dvec3(p));
        scene.camera.position = glm::vec3(turn * glm::dvec3(scene.camera.position));
        scene.camera.up = glm::vec3(turn * glm::dvec3(scene.camera.up));
    }
    return scene;
}

TEST(LargeTriangles, AGroundOfAnySizeHasTheSamePicture) {
    const double expected = meanBy(groundScene(8.0f, false), Integrator::kPathTracer, 64);
    for (const float reach : {8.0f, 3e3f, 1e5f}) {
        for (const bool tilted : {false, true}) {
            const LoadedScene scene = groundScene(reach, tilted);
            EXPECT_NEAR(meanBy(scene, Integrator::kPathTracer, 64), expected, 0.01 * expected)
                << reach << tilted;
            EXPECT_NEAR(meanBy(scene, Integrator::kLightTracer, 256), expected, 0.04 * expected)
                << reach << tilted;
        }
    }
}

// All layouts and kernels give the same bits, with planes, too.
TEST(LargeTriangles, AllLayoutsHaveTheSameBits) {
    const LoadedScene scene = groundScene(1e5f, true);
    std::optional<Film> first;
    for (const TuningChoice& tuning : allTunings(device().info())) {
        if (tuning.layout == Layout::kRayQuery) continue;
        RenderControl control;
        control.tuning = tuning;
        const RenderOutput output = render(device(), scene, control);
        if (!first) first = output.film;
        EXPECT_EQ(first->resolve().visible, output.film.resolve().visible) << nameOf(tuning);
    }
}

}  // namespace
}  // namespace duolux::test

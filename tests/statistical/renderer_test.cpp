#include "host/render/renderer.h"

#include <gtest/gtest.h>
#include <malloc.h>

#include <string>
#include <utility>

#include "host/base/error.h"
#include "host/cli/temporary_folder.h"
#include "host/generators/two_spheres.h"
#include "host/view/load.h"
#include "tests/statistical/films.h"
#include "tests/support/address_space.h"
#include "tests/support/cornell.h"
#include "tests/support/device.h"
#include "tests/support/scene_builder.h"
#include "tests/support/tunings.h"

// A scene that is uploaded once gives the same images as one that is uploaded for each render.

namespace duolux::test {
namespace {

LoadedScene small(LoadedScene scene) {
    scene.settings.width = 21;
    scene.settings.height = 15;
    scene.settings.spp = 3;
    scene.settings.bounces = 4;
    return scene;
}

class RendererTest : public testing::Test {
  protected:
    static void expectSame(Renderer& renderer, const RenderSettings& settings, const TuningChoice& tuning,
                           const std::string& what) {
        RenderControl control;
        control.tuning = tuning;
        const RenderOutput expected = render(device(), renderer.scene(), settings, control);
        const RenderOutput output = renderer.render(settings);
        EXPECT_TRUE(sameBits(output.film, expected.film)) << what << ", " << nameOf(tuning);
        EXPECT_EQ(output.statistics.directLightInClosedForm, expected.statistics.directLightInClosedForm);
        EXPECT_EQ(output.statistics.effectiveBounces, expected.statistics.effectiveBounces);
        EXPECT_GT(output.statistics.meanRadiance, 0.0) << what;
    }

    static void goThroughChanges(LoadedScene scene, const TuningChoice& tuning) {
        RenderSettings settings = scene.settings;
        Renderer renderer(device(), std::move(scene), tuning);
        expectSame(renderer, settings, tuning, "first");

        Camera camera = renderer.scene().camera;
        camera.position += glm::vec3(30, -20, 10);
        renderer.setCamera(camera);
        expectSame(renderer, settings, tuning, "another camera");
        camera.type = CameraType::kOrthographic;
        camera.height = 500.0f;
        renderer.setCamera(camera);
        expectSame(renderer, settings, tuning, "another kind of camera");

        for (const char* preset : {"shadowless", "one-bounce", "local", "global"}) {
            renderer.setReflectance(*presetReflectance(preset));
            expectSame(renderer, settings, tuning, preset);
        }

        settings.integrator = Integrator::kLightTracer;
        settings.width = 17;
        settings.seed = 5;
        expectSame(renderer, settings, tuning, "light paths");
        renderer.setReflectance(*presetReflectance("shadowless"));
        expectSame(renderer, settings, tuning, "light paths through everything");
        settings.integrator = Integrator::kPathTracer;
        settings.bounces = 2;
        renderer.setDisplay({1, 0});
        expectSame(renderer, settings, tuning, "fewer bounces, the other component");

        std::vector<Material> materials = renderer.scene().materials;
        for (Material& material : materials) {
            material.emission.invisible *= 2.0f;
            material.baseColor *= 0.5f;
        }
        renderer.setMaterials(materials);
        expectSame(renderer, settings, tuning, "brighter emitters");
        materials.front().emission = {glm::vec3(3.0f), glm::vec3(1.0f), Sides::kBoth};
        renderer.setMaterials(materials);
        expectSame(renderer, settings, tuning, "another emitter");
        for (Material& material : materials)
            material.reflectance = *presetReflectance("local");
        renderer.setMaterials(materials);
        expectSame(renderer, settings, tuning, "reflectances of materials");

        const glm::vec3 middle =
            0.5f * (boundsOf(renderer.scene().geometry).lower + boundsOf(renderer.scene().geometry).upper);
        const PointEmitter lamp{middle, glm::vec3(1e6f, 2e6f, 3e6f), glm::vec3(1e5f)};
        renderer.setPointEmitters({lamp, {middle + glm::vec3(100, 50, -60), glm::vec3(2e6f), {}}});
        expectSame(renderer, settings, tuning, "points");
        renderer.setReflectance(*presetReflectance("shadowless"));
        for (Material& material : materials) {
            material.emission = {};
            material.reflectance.reset();
        }
        renderer.setMaterials(materials);
        expectSame(renderer, settings, tuning, "points alone");
        settings.integrator = Integrator::kLightTracer;
        renderer.setPointEmitters({lamp});
        expectSame(renderer, settings, tuning, "light paths from one point");
        settings.integrator = Integrator::kPathTracer;
        materials.back().emission.invisible = glm::vec3(5.0f);
        renderer.setMaterials(materials);
        renderer.setPointEmitters({});
        expectSame(renderer, settings, tuning, "triangles again");
    }
};

TEST_F(RendererTest, GivesTheSameBitsAfterAnyChange) {
    for (const TuningChoice& tuning : allTunings(device().info()))
        goThroughChanges(small(cornellBox()), tuning);
}

/// Emitters come first among coincident surfaces, so the order depends on which surfaces emit.
TEST_F(RendererTest, GivesTheSameBitsWhereSurfacesCoincide) {
    LoadedScene scene = small(cornellBox());
    Geometry& geometry = scene.geometry;
    const std::size_t triangles = geometry.triangles.size();
    for (std::size_t i = 0; i < triangles; ++i) {
        geometry.triangles.push_back(geometry.triangles[i]);
        geometry.materials.push_back(geometry.materials[(i + 2) % triangles]);
    }
    goThroughChanges(scene, {});
}

TEST_F(RendererTest, BuildsTheTreeOnce) {
    const LoadedScene scene = small(cornellBox());
    Renderer renderer(device(), scene);
    EXPECT_GT(renderer.render(scene.settings).statistics.buildSeconds, 0.0);
    renderer.setReflectance(*presetReflectance("one-bounce"));
    EXPECT_EQ(renderer.render(scene.settings).statistics.buildSeconds, 0.0);
    std::vector<Material> materials = renderer.scene().materials;
    for (Material& material : materials)
        material.emission.invisible *= 0.5f;
    renderer.setMaterials(materials);
    EXPECT_EQ(renderer.render(scene.settings).statistics.buildSeconds, 0.0);
    renderer.setPointEmitters({{glm::vec3(278.0f, 270.0f, 280.0f), glm::vec3(1e6f), glm::vec3(0.0f)}});
    EXPECT_EQ(renderer.render(scene.settings).statistics.buildSeconds, 0.0);
}

/// Memory for the update is refused: the next render tries again, with the tree that the host has.
/// A suite of its own, and so large arrays that no memory which others have freed serves them.
TEST(RendererMemory, AnUpdateWithoutIsTriedAgain) {
    if (kAddressSanitizer) return;         // which needs more address space than any limit allows
    ::mallopt(M_MMAP_THRESHOLD, 1 << 16);  // arrays are mapped anew, so that the limit applies
    const TemporaryFolder folder;
    writeTwoSpheres(folder.path(), 500'000);
    const LoadedScene scene = small(loadScene(folder.path() / "two_spheres.json"));
    Renderer renderer(device(), scene);
    renderer.render(scene.settings);
    std::vector<Material> materials = scene.materials;
    for (Material& material : materials)
        material.emission.invisible = glm::vec3(0.5f);
    renderer.setMaterials(materials);
    {
        const AddressSpaceLimit limit(std::size_t{1} << 20);
        EXPECT_THROW(renderer.render(scene.settings), MemoryError);
    }
    LoadedScene changed = scene;
    changed.materials = materials;
    EXPECT_TRUE(sameBits(renderer.render(scene.settings).film, render(device(), changed).film));
}

TEST_F(RendererTest, RefusesWhatIsNotValid) {
    const LoadedScene scene = small(cornellBox());
    LoadedScene broken = scene;
    broken.geometry.triangles.back().x = 1'000'000;
    EXPECT_THROW(Renderer(device(), broken), InputError);
    EXPECT_THROW(render(device(), broken), InputError);

    Renderer renderer(device(), scene);
    const RenderOutput before = renderer.render(scene.settings);
    EXPECT_THROW(renderer.setMaterials({}), UsageError);
    RenderSettings settings = scene.settings;
    settings.width = 0;
    EXPECT_THROW(renderer.render(settings), UsageError);
    Camera camera = scene.camera;
    camera.target = camera.position;
    renderer.setCamera(camera);
    EXPECT_THROW(renderer.render(scene.settings), InputError);
    renderer.setCamera(scene.camera);
    renderer.setPointEmitters({{glm::vec3(0.0f), glm::vec3(-1.0f), glm::vec3(0.0f)}});
    EXPECT_THROW(renderer.render(scene.settings), InputError);
    renderer.setPointEmitters({});
    EXPECT_TRUE(sameBits(renderer.render(scene.settings).film, before.film));
}

}  // namespace
}  // namespace duolux::test

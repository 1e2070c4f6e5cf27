#include "tests/support/cornell.h"

#include <gtest/gtest.h>

#include "tests/reference/tracer.h"
#include "tests/statistical/renders.h"
#include "tests/support/scene_builder.h"

// Compares whole images with the reference, pixel by pixel, for what no closed form covers: occlusion by
// crossings in a scene of many depths, visibility of the luminaire's front and back, colour bleeding, the
// interplay of per-material reflectances, and every estimator where it is noisy.

namespace duolux::test {

namespace {

struct CornellCase {
    const char* name;
    LoadedScene scene;
    std::uint32_t bounces;
};

LoadedScene boxOf(const Reflectance& reflectance) {
    LoadedScene scene = cornellBox();
    scene.reflectance = reflectance;
    return scene;
}

/// The scene's reflectance lets light through everything, except one block.
LoadedScene oneShadow() {
    LoadedScene scene = boxOf(preset("local"));
    scene.materials[kShort].reflectance = preset("global");
    return scene;
}

LoadedScene lamps(const char* name) {
    LoadedScene scene = lampsCornellBox();
    scene.reflectance = preset(name);
    return scene;
}

/// Not square, tilted, off-axis, with a wider angle; and a point inside the square of reflectances.
LoadedScene tiltedView() {
    LoadedScene scene = boxOf(blendReflectance(0.6f, 0.4f));
    scene.camera = {{350, 350, -400}, {250, 200, 200}, {0.4f, 1, 0.1f}, 55.0f};
    scene.settings.width = 44;
    scene.settings.height = 24;
    return scene;
}

/// Parallel rays from above and from the side, which also hit the box from outside.
LoadedScene orthographicView() {
    LoadedScene scene = boxOf(preset("global"));
    scene.camera = {{400, 500, -300}, {250, 250, 250}, {0.2f, 1, 0}};
    scene.camera.type = CameraType::kOrthographic;
    scene.camera.height = 700.0f;
    scene.settings.width = 40;
    scene.settings.height = 28;
    return scene;
}

/// Visible light, converted from invisible light, also passes: every surface is seen through, and scatters.
LoadedScene seeThrough() {
    return boxOf({matrix(0.5f, 0, 0.75f, 0), matrix(1, 0, 0.5f, 0)});
}

std::vector<CornellCase> cornellCases() {
    return {{"CornellLocal", boxOf(preset("local")), 4},
            {"CornellGlobal", boxOf(preset("global")), 8},
            {"CornellShadowless", boxOf(preset("shadowless")), 4},
            {"CornellOneBounce", boxOf(preset("one-bounce")), 4},
            {"CornellTiltedView", tiltedView(), 4},
            {"CornellSeeThrough", seeThrough(), 3},
            {"CornellEmissionOnly", mixedCornellBox(), 0},
            {"CornellOneShadow", oneShadow(), 4},
            {"CornellLampsLocal", lamps("local"), 3},
            {"CornellLampsGlobal", lamps("global"), 3},
            {"CornellLampsShadowless", lamps("shadowless"), 3},
            {"CornellMixed", mixedCornellBox(), 4},
            {"CornellOrthographic", orthographicView(), 4}};
}

/// For messages of the test framework.
void PrintTo(const CornellCase& cornell, std::ostream* out) {
    *out << cornell.name;
}

class Cornell : public testing::TestWithParam<CornellCase> {};

TEST_P(Cornell, MatchesReference) {
    CornellCase cornell = GetParam();
    cornell.scene.settings.bounces = cornell.bounces;
    reference::Settings settings;
    settings.width = cornell.scene.settings.width;
    settings.height = cornell.scene.settings.height;
    settings.bounces = cornell.bounces;
    settings.samples = 2048;
    const reference::Estimates expected = reference::trace(cornell.scene, settings);
    const Renders renders = renderSeeds(cornell.scene, 128, 16);
    expectAgreement(cornell.name, renders, expected);
    if (const auto others = renderOtherEstimator(cornell.scene, 128, 16, renders)) {
        expectAgreement(cornell.name + std::string("OtherEstimator"), *others, expected);
    }
    expectAgreement(cornell.name + std::string("Light"), renderByLight(cornell.scene, 128, 16), expected,
                    {.lightPaths = true});
}

INSTANTIATE_TEST_SUITE_P(Often, Cornell, testing::ValuesIn(oftenCases(cornellCases())),
                         [](const auto& test) { return test.param.name; });
INSTANTIATE_TEST_SUITE_P(Nightly, Cornell, testing::ValuesIn(nightlyCases(cornellCases())),
                         [](const auto& test) { return test.param.name; });

}  // namespace

}  // namespace duolux::test

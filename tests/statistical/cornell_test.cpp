#include "tests/support/cornell.h"

#include <gtest/gtest.h>

#include "tests/reference/tracer.h"
#include "tests/statistical/renders.h"
#include "tests/support/scene_builder.h"

// Whole pictures against the reference, pixel by pixel: what no closed form covers. Occlusion by crossings in
// a scene of many depths, visibility of the luminaire's front and back, colour bleeding, the interplay of
// per-material reflectances, and every estimator where it is noisy.

namespace duolux::test {

namespace {

struct CornellCase {
    const char* name;
    Scene scene;
    std::uint32_t bounces;
};

Scene boxOf(const Reflectance& reflectance) {
    Scene scene = cornellBox();
    scene.reflectance = reflectance;
    return scene;
}

/// The box in which the scene's reflectance would let light through everything, but one block does not.
Scene oneShadow() {
    Scene scene = boxOf(preset("local"));
    scene.materials[kShort].reflectance = preset("global");
    return scene;
}

std::vector<CornellCase> cornellCases() {
    return {{"CornellLocal", boxOf(preset("local")), 4},
            {"CornellGlobal", boxOf(preset("global")), 8},
            {"CornellShadowless", boxOf(preset("shadowless")), 4},
            {"CornellOneBounce", boxOf(preset("one-bounce")), 4},
            {"CornellBlend", boxOf(blendReflectance(0.6f, 0.4f)), 4},
            {"CornellEmissionOnly", mixedCornellBox(), 0},
            {"CornellOneShadow", oneShadow(), 4},
            {"CornellMixed", mixedCornellBox(), 4}};
}

/// For messages of the test framework.
void PrintTo(const CornellCase& cornell, std::ostream* out) {
    *out << cornell.name;
}

class Cornell : public testing::TestWithParam<CornellCase> {};

TEST_P(Cornell, MatchesReference) {
    CornellCase cornell = GetParam();
    cornell.scene.render.bounces = cornell.bounces;
    reference::Settings settings;
    settings.width = cornell.scene.render.width;
    settings.height = cornell.scene.render.height;
    settings.bounces = cornell.bounces;
    settings.samples = 1536;
    const reference::Estimates expected = reference::trace(cornell.scene, settings);
    expectAgreement(cornell.name, renderSeeds(cornell.scene, 64, 16), expected);
}

INSTANTIATE_TEST_SUITE_P(All, Cornell, testing::ValuesIn(cornellCases()),
                         [](const auto& test) { return test.param.name; });

}  // namespace

}  // namespace duolux::test

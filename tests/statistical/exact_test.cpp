#include <gtest/gtest.h>

#include "host/base/error.h"
#include "tests/statistical/renders.h"
#include "tests/support/cornell.h"
#include "tests/support/device.h"
#include "tests/support/exact_case.h"

// The kernels against closed forms. The files that build the cases describe the errors that each family
// detects.

namespace duolux::test {

namespace {

class Exact : public testing::TestWithParam<ExactCase> {};

TEST_P(Exact, MatchesClosedForm) {
    const ExactCase& exact = GetParam();
    const Renders renders = renderSeeds(exact.scene, 128, 4);
    expectAgreement(exact.name, renders, exact.expected, {.relative = exact.relative});
    if (const auto others = renderOtherEstimator(exact.scene, 128, 4, renders)) {
        expectAgreement(exact.name + "OtherEstimator", *others, exact.expected, {.relative = exact.relative});
    }
}

/// Variance between seeds over all channels of the visible component, averaged over pixels.
double varianceBetween(const Renders& renders) {
    double total = 0.0;
    const std::size_t pixels = renders.images.front().visible.size();
    for (std::size_t i = 0; i < pixels; ++i) {
        glm::dvec3 sum(0.0);
        glm::dvec3 squares(0.0);
        for (const RadianceImage& image : renders.images) {
            const glm::dvec3 v(image.visible[i]);
            sum += v;
            squares += v * v;
        }
        const auto n = static_cast<double>(renders.images.size());
        const glm::dvec3 variance = (squares - sum * sum / n) / (n - 1.0);
        total += variance.x + variance.y + variance.z;
    }
    return total / static_cast<double>(pixels);
}

TEST(ClosedForm, LocalHasNoNoiseWithinASurface) {
    // The camera sees so little that every sample hits nearly the same point.
    LoadedScene scene = cornellBox();
    scene.reflectance = *presetReflectance("local");
    scene.camera.vfov = 1e-3f;
    scene.camera.target = {100.0f, 200.0f, 559.2f};  // the back wall
    scene.settings.width = scene.settings.height = 8;
    RenderControl sampled;
    sampled.directLight = DirectLight::kSampled;
    const Renders exact = renderSeeds(scene, 1, 8);
    EXPECT_TRUE(exact.directLightInClosedForm);
    const double noise = varianceBetween(renderSeeds(scene, 1, 8, 1, sampled));
    EXPECT_GT(noise, 1e-6);
    EXPECT_LT(varianceBetween(exact), 1e-6 * noise);
}

TEST(ClosedForm, IsChosenWhereItAppliesAndPays) {
    LoadedScene scene = cornellBox();
    scene.settings.width = scene.settings.height = 4;
    const auto applies = [&](std::string_view preset) {
        scene.reflectance = *presetReflectance(preset);
        return renderSeeds(scene, 1, 1).directLightInClosedForm;
    };
    EXPECT_TRUE(applies("local"));
    EXPECT_FALSE(applies("shadowless"));  // possible, but not worthwhile
    EXPECT_FALSE(applies("global"));
    EXPECT_FALSE(applies("one-bounce"));
    RenderControl control;
    control.directLight = DirectLight::kClosedForm;
    scene.reflectance = *presetReflectance("shadowless");
    EXPECT_TRUE(render(device(), scene, control).statistics.directLightInClosedForm);
    scene.reflectance = *presetReflectance("one-bounce");
    EXPECT_THROW(render(device(), scene, control), UsageError);
}

INSTANTIATE_TEST_SUITE_P(Metal, Exact, testing::ValuesIn(metalCases()),
                         [](const auto& test) { return test.param.name; });
INSTANTIATE_TEST_SUITE_P(Points, Exact, testing::ValuesIn(pointCases()),
                         [](const auto& test) { return test.param.name; });
INSTANTIATE_TEST_SUITE_P(Often, Exact, testing::ValuesIn(oftenCases(exactCases())),
                         [](const auto& test) { return test.param.name; });
INSTANTIATE_TEST_SUITE_P(Nightly, Exact, testing::ValuesIn(nightlyCases(exactCases())),
                         [](const auto& test) { return test.param.name; });

}  // namespace

}  // namespace duolux::test

#include <gtest/gtest.h>

#include <string>

#include "host/render/render.h"
#include "tests/support/cornell.h"
#include "tests/support/device.h"
#include "tests/support/scene_builder.h"

// The statistics of the last bounces, with which the renderer warns of a limit that cuts light off. Renders
// that differ only in the limit have identical paths up to it, so their means differ by one bounce.

namespace duolux::test {

namespace {

class Bounces : public testing::TestWithParam<Integrator> {};

TEST_P(Bounces, LastAndPreviousAreWhatTheyAdd) {
    LoadedScene scene = mixedCornellBox();
    scene.settings.width = scene.settings.height = 16;
    scene.settings.spp = 64;
    scene.settings.integrator = GetParam();
    RenderStatistics statistics[4];
    for (std::uint32_t bounces = 1; bounces < 4; ++bounces) {
        scene.settings.bounces = bounces;
        statistics[bounces] = render(device(), scene).statistics;
    }
    const double last = statistics[3].meanRadiance - statistics[2].meanRadiance;
    const double previous = statistics[2].meanRadiance - statistics[1].meanRadiance;
    EXPECT_GT(last, 0.0);
    EXPECT_GT(previous, 1.2 * last);
    EXPECT_NEAR(statistics[3].lastBounceRadiance, last, 1e-3 * last);
    EXPECT_NEAR(statistics[3].previousBounceRadiance, previous, 1e-3 * previous);
}

/// All light of `local`, which is computed in closed form here, is scattered once.
TEST(BouncesInClosedForm, DirectLightIsTheFirst) {
    LoadedScene scene = cornellBox();
    scene.reflectance = preset("local");
    scene.settings.width = scene.settings.height = 16;
    scene.settings.spp = 4;
    for (const std::uint32_t bounces : {1u, 2u}) {
        scene.settings.bounces = bounces;
        const RenderStatistics statistics = render(device(), scene).statistics;
        ASSERT_TRUE(statistics.directLightInClosedForm);
        ASSERT_GT(statistics.meanRadiance, 0.0);
        EXPECT_NEAR(bounces == 1 ? statistics.lastBounceRadiance : statistics.previousBounceRadiance,
                    statistics.meanRadiance, 1e-5 * statistics.meanRadiance);
    }
}

INSTANTIATE_TEST_SUITE_P(All, Bounces, testing::Values(Integrator::kPathTracer, Integrator::kLightTracer),
                         [](const auto& test) {
                             return test.param == Integrator::kPathTracer ? "Path" : "Light";
                         });

}  // namespace

}  // namespace duolux::test

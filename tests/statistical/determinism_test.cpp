#include <gtest/gtest.h>

#include <string>

#include "host/base/error.h"
#include "host/render/render.h"
#include "tests/statistical/films.h"
#include "tests/support/cornell.h"
#include "tests/support/device.h"
#include "tests/support/exact_case.h"
#include "tests/support/scene_builder.h"

// The same seed gives bitwise identical images, however the work is divided: a sample must depend only on its
// pixel, its index and the seed, and sums must be exact. These tests detect random state that is carried from
// one sample to the next, floating-point sums, races between lanes, and stale data from an earlier dispatch.

namespace duolux::test {

namespace {

LoadedScene scene(std::uint32_t seed = 5) {
    LoadedScene result = mixedCornellBox();
    result.settings.width = 19;
    result.settings.height = 13;
    result.settings.spp = 22;
    result.settings.bounces = 5;
    result.settings.seed = seed;
    return result;
}

Film filmOf(const LoadedScene& what, const RenderControl& control = {}) {
    return render(device(), what, control).film;
}

TEST(Determinism, SameSeedSameBits) {
    for (LoadedScene same : {scene(), byLight(scene())}) {
        EXPECT_TRUE(sameBits(filmOf(same), filmOf(same)));
        same.settings.sampler = Sampler::kIndependent;
        EXPECT_TRUE(sameBits(filmOf(same), filmOf(same)));
    }
}

TEST(Determinism, SeedsAndSamplersDiffer) {
    for (const auto& variant : {+[](LoadedScene s) { return s; }, &byLight}) {
        EXPECT_FALSE(sameBits(filmOf(variant(scene(5))), filmOf(variant(scene(6)))));
        LoadedScene independent = variant(scene(5));
        independent.settings.sampler = Sampler::kIndependent;
        EXPECT_FALSE(sameBits(filmOf(variant(scene(5))), filmOf(independent)));
    }
}

/// Paths are weighted by how much of each component is displayed, whatever its sign.
TEST(Determinism, TheSignOfTheDisplayDoesNotMatter) {
    for (const auto& variant : {+[](LoadedScene s) { return s; }, &byLight}) {
        LoadedScene displayed = variant(scene(5));
        // Nothing but the invisible component, which is hardly displayed, has light from the walls.
        displayed.reflectance.opaque = matrix(0.5f, 0.0f, 0.0f, 0.0f);
        displayed.display = {0.01f, 1.0f};
        const Film film = filmOf(displayed);
        for (const glm::vec2 signs : {glm::vec2(1, -1), glm::vec2(-1, 1), glm::vec2(-1, -1)}) {
            LoadedScene other = displayed;
            other.display *= signs;
            EXPECT_TRUE(sameBits(filmOf(other), film)) << signs.x << " " << signs.y;
        }
    }
}

/// Samples and pixels of a dispatch, samples of a lane; 0: chosen by the renderer.
struct Limits {
    std::uint32_t samples, pixels, lane;
};

class Split : public testing::TestWithParam<Limits> {};

TEST_P(Split, AnySplitGivesTheSameBits) {
    static const Film whole = filmOf(scene());
    RenderControl control;
    control.limits.maxSamplesPerDispatch = GetParam().samples;
    control.limits.maxPixelsPerDispatch = GetParam().pixels;
    control.limits.maxSamplesPerLane = GetParam().lane;
    EXPECT_TRUE(sameBits(whole, filmOf(scene(), control)));
    static const Film wholeByLight = filmOf(byLight(scene()));
    EXPECT_TRUE(sameBits(wholeByLight, filmOf(byLight(scene()), control)));
}

// The image has 247 pixels with 22 samples each.
INSTANTIATE_TEST_SUITE_P(All, Split,
                         testing::Values(Limits{1, 0, 0}, Limits{2, 0, 0}, Limits{3, 0, 0}, Limits{7, 0, 0},
                                         Limits{15, 0, 0}, Limits{0, 7, 0}, Limits{0, 64, 0},
                                         Limits{0, 100, 0}, Limits{5, 31, 0}, Limits{8, 3, 0},
                                         Limits{0, 0, 1}, Limits{0, 0, 5}, Limits{0, 0, 17}, Limits{0, 0, 64},
                                         Limits{4, 50, 6}, Limits{0, 33, 3}),
                         [](const auto& test) {
                             return std::to_string(test.param.samples) + "By" +
                                    std::to_string(test.param.pixels) + "Lane" +
                                    std::to_string(test.param.lane);
                         });

TEST(Determinism, TheFilmOfLightPathsIsTheSameInAnyBuffers) {
    const Film whole = filmOf(byLight(scene()));
    RenderControl control;
    control.limits.noInt64Atomics = true;
    EXPECT_TRUE(sameBits(whole, filmOf(byLight(scene()), control)));
    for (const std::uint32_t band : {246u, 100u, 31u}) {  // two, three and all eight buffers
        control.limits.filmBandPixels = band;
        control.limits.noInt64Atomics = false;
        EXPECT_TRUE(sameBits(whole, filmOf(byLight(scene()), control))) << band;
        control.limits.noInt64Atomics = true;
        EXPECT_TRUE(sameBits(whole, filmOf(byLight(scene()), control))) << band;
    }
    control.limits.filmBandPixels = 30;
    EXPECT_THROW(filmOf(byLight(scene()), control), DeviceError);
}

TEST(Determinism, LightPathsAreNumberedBeyond32Bits) {
    LoadedScene far = byLight(scene());
    far.settings.width = 32;
    far.settings.height = 16;
    const auto film = [&](std::uint32_t first, std::uint32_t pathsPerDispatch) {
        RenderControl control;
        control.samples = SampleRange{first, first + 4};
        control.limits.maxPixelsPerDispatch = pathsPerDispatch;
        return filmOf(far, control);
    };
    constexpr std::uint32_t kBeyond = 1u << 23;  // times 512 pixels: path 2^32
    const Film across = film(kBeyond - 2, 0);
    EXPECT_TRUE(sameBits(across, film(kBeyond - 2, 700)));  // the number passes 2^32 within a dispatch
    EXPECT_FALSE(sameBits(film(kBeyond, 0), film(0, 0)));
}

TEST(Determinism, LightPathsOfManyCrossingsAreWhole) {
    // Panes that pass and scatter: light paths meet hundreds of surfaces.
    LoadedScene stack = byLight(stackedPanesCase(100).scene);
    stack.camera.vfov = 60.0f;
    stack.settings.width = stack.settings.height = 32;
    stack.settings.spp = 24;
    RenderControl single;
    single.limits.maxSamplesPerLane = 1;
    RenderControl parts;
    parts.limits.maxPixelsPerDispatch = 1024;
    const RenderOutput reference = render(device(), stack, single);
    EXPECT_EQ(reference.statistics.dispatchesCutShort, 0u);
    EXPECT_EQ(reference.film.lightPaths(), 32u * 32u * 24u);
    EXPECT_GT(reference.statistics.meanRadiance, 0.0);
    for (const RenderControl& control : {RenderControl{}, parts}) {
        const RenderOutput whole = render(device(), stack, control);
        if (device().info().driver.find("llvmpipe Mesa 22.") != std::string::npos) {
            EXPECT_GT(whole.statistics.dispatchesCutShort, 0u)
                << "the case no longer reaches lavapipe's limit";
        }
        EXPECT_TRUE(sameBits(whole.film, reference.film));
        EXPECT_EQ(whole.statistics.bounceRays, reference.statistics.bounceRays);
        EXPECT_EQ(whole.statistics.shadowRays, reference.statistics.shadowRays);
        EXPECT_EQ(whole.statistics.lastBounceRadiance, reference.statistics.lastBounceRadiance);
    }
}

TEST(Determinism, PathsOfManyCrossingsAreWhole) {
    // A hundred surfaces per ray. Some drivers silently end long loops; such dispatches are traced again in
    // smaller parts.
    LoadedScene panes = stackedPanesCase(100).scene;
    panes.settings.width = panes.settings.height = 10;
    panes.settings.spp = 9;
    RenderControl single;
    single.limits.maxSamplesPerDispatch = 1;
    single.limits.maxPixelsPerDispatch = 8;
    RenderControl
        parts;  // a pass of several dispatches, so that the first is cut short while another is in flight
    parts.limits.maxPixelsPerDispatch = 48;
    const RenderOutput reference = render(device(), panes, single);
    EXPECT_EQ(reference.statistics.dispatchesCutShort, 0u);
    EXPECT_EQ(reference.film.totalSamples(), 10u * 10u * 9u);
    // Later versions have no limit. On a busy machine the first dispatches may seem slow, so that the next
    // are too small to reach it.
    const bool limited = device().info().driver.find("llvmpipe Mesa 22.") != std::string::npos;
    for (const RenderControl& control : {RenderControl{}, parts}) {
        std::uint64_t cutShort = 0;
        for (int attempt = 0; attempt < 5 && (attempt == 0 || (limited && cutShort == 0)); ++attempt) {
            const RenderOutput whole = render(device(), panes, control);
            cutShort += whole.statistics.dispatchesCutShort;
            EXPECT_TRUE(sameBits(whole.film, reference.film));
        }
        EXPECT_TRUE(!limited || cutShort > 0) << "the case no longer reaches lavapipe's limit";
    }
}

/// Panes that scatter and pass most of the light: a path meets thousands of surfaces.
LoadedScene thickStack() {
    LoadedScene result = stackedPanesCase(30).scene;
    result.reflectance = blendReflectance(0.97f, 1.0f);
    for (Material& material : result.materials)
        material.reflectance.reset();
    result.settings.width = result.settings.height = 32;
    result.settings.bounces = 1;
    return result;
}

/// Dispatches aim at 0.1 s. One may take long on a busy machine, but not all of them.
void expectShortDispatches(const RenderStatistics& statistics) {
    EXPECT_LT(statistics.deviceSeconds / static_cast<double>(statistics.dispatches), 0.5);
}

TEST(Determinism, DispatchesAreBoundedWhereAPathMeetsManySurfaces) {
    LoadedScene stack = thickStack();
    stack.settings.spp = 20;
    RenderControl parts;  // many dispatches of a pass are in flight when the first is found to be too long
    parts.limits.maxPixelsPerDispatch = 128;
    const RenderOutput output = render(device(), stack, parts);
    EXPECT_EQ(output.film.totalSamples(), 32u * 32u * 20u);
    expectShortDispatches(output.statistics);
    EXPECT_TRUE(sameBits(output.film, filmOf(stack)));

    stack.camera.vfov = 60.0f;
    const RenderOutput light = render(device(), byLight(stack), {});
    EXPECT_EQ(light.film.lightPaths(), 32u * 32u * 20u);
    expectShortDispatches(light.statistics);
}

TEST(Determinism, ATimeLimitLeavesNoPixelWithoutSample) {
    LoadedScene stack = thickStack();
    stack.settings.spp = 100'000;
    RenderControl control;
    control.timeLimit = 0.001;
    const RenderOutput output = render(device(), stack, control);
    EXPECT_TRUE(output.statistics.stopped);
    for (std::uint32_t pixel = 0; pixel < 32 * 32; ++pixel)
        ASSERT_GE(output.film.samplesOf(pixel), 1u) << pixel;

    const RenderOutput light = render(device(), byLight(stack), control);
    EXPECT_TRUE(light.statistics.stopped);
    EXPECT_GE(light.film.lightPaths(), 32u * 32u);
    EXPECT_LT(light.film.lightPaths(), 32u * 32u * 100'000u);
    EXPECT_EQ(light.film.lightPaths(), light.statistics.samples);
}

TEST(Determinism, ARenderLeavesNothingBehindOnTheDevice) {
    const Film before = filmOf(scene());
    LoadedScene other = cornellBox();
    other.settings.width = other.settings.height = 31;
    other.settings.spp = 3;
    filmOf(other);
    EXPECT_TRUE(sameBits(before, filmOf(scene())));
}

}  // namespace

}  // namespace duolux::test

#include <gtest/gtest.h>

#include <algorithm>
#include <tuple>
#include <utility>

#include "host/render/render.h"
#include "tests/support/cornell.h"
#include "tests/support/device.h"
#include "tests/support/exact_case.h"

// The same seed gives the same bits, however the work is cut: a sample must depend on its pixel, its index
// and the seed alone, and sums must be exact. A random state carried from one sample to the next, a sum in
// floating point, a race between lanes, and buffers that keep something from the dispatch before all show.

namespace duolux::test {

namespace {

Scene scene(std::uint32_t seed = 5) {
    Scene result = mixedCornellBox();
    result.render.width = 19;
    result.render.height = 13;
    result.render.spp = 22;
    result.render.bounces = 5;
    result.render.seed = seed;
    return result;
}

Film filmOf(const Scene& what, const RenderControl& control = {}) {
    return render(device(), what, control).film;
}

bool sameBits(const Film& a, const Film& b) {
    const auto equal = [](const Film::PixelSum& p, const Film::PixelSum& q) {
        return std::ranges::equal(p.invisible, q.invisible) && std::ranges::equal(p.visible, q.visible);
    };
    return a.quantum() == b.quantum() && a.totalSamples() == b.totalSamples() &&
           std::ranges::equal(a.sums(), b.sums(), equal);
}

TEST(Determinism, SameSeedSameBits) {
    EXPECT_TRUE(sameBits(filmOf(scene()), filmOf(scene())));
    Scene independent = scene();
    independent.render.sampler = Sampler::kIndependent;
    EXPECT_TRUE(sameBits(filmOf(independent), filmOf(independent)));
}

TEST(Determinism, SeedsAndSamplersDiffer) {
    EXPECT_FALSE(sameBits(filmOf(scene(5)), filmOf(scene(6))));
    Scene independent = scene(5);
    independent.render.sampler = Sampler::kIndependent;
    EXPECT_FALSE(sameBits(filmOf(scene(5)), filmOf(independent)));
}

class Split : public testing::TestWithParam<std::pair<std::uint32_t, std::uint32_t>> {};

TEST_P(Split, AnySplitGivesTheSameBits) {
    static const Film whole = filmOf(scene());
    RenderControl control;
    std::tie(control.maxSamplesPerDispatch, control.maxPixelsPerDispatch) = GetParam();
    EXPECT_TRUE(sameBits(whole, filmOf(scene(), control)));
}

// Samples and pixels a dispatch; 0: as measured. 247 pixels and 22 samples divide by none of them.
INSTANTIATE_TEST_SUITE_P(All, Split,
                         testing::Values(std::pair(1u, 0u), std::pair(3u, 0u), std::pair(7u, 0u),
                                         std::pair(22u, 0u), std::pair(1000u, 0u), std::pair(0u, 7u),
                                         std::pair(0u, 64u), std::pair(0u, 100u), std::pair(0u, 247u),
                                         std::pair(5u, 31u), std::pair(8u, 3u)),
                         [](const auto& test) {
                             return std::to_string(test.param.first) + "By" +
                                    std::to_string(test.param.second);
                         });

TEST(Determinism, PathsOfManyCrossingsAreWhole) {
    // A hundred surfaces a ray. Drivers that end long loops without a word must not end these: what was cut
    // short is traced again, in smaller parts.
    Scene panes = stackedPanesCase(100).scene;
    panes.render.width = panes.render.height = 10;
    panes.render.spp = 9;
    RenderControl single;
    single.maxSamplesPerDispatch = 1;
    single.maxPixelsPerDispatch = 8;
    RenderControl
        parts;  // a pass of several dispatches, so that the first is cut short while another is in flight
    parts.maxPixelsPerDispatch = 48;
    const RenderOutput reference = render(device(), panes, single);
    EXPECT_EQ(reference.statistics.dispatchesCutShort, 0u);
    EXPECT_EQ(reference.film.totalSamples(), 10u * 10u * 9u);
    for (const RenderControl& control : {RenderControl{}, parts}) {
        const RenderOutput whole = render(device(), panes, control);
        if (device().info().driver.find("llvmpipe") != std::string::npos) {
            EXPECT_GT(whole.statistics.dispatchesCutShort, 0u)
                << "the case no longer reaches lavapipe's limit";
        }
        EXPECT_TRUE(sameBits(whole.film, reference.film));
    }
}

TEST(Determinism, ARenderLeavesNothingBehindOnTheDevice) {
    const Film before = filmOf(scene());
    Scene other = cornellBox();
    other.render.width = other.render.height = 31;
    other.render.spp = 3;
    filmOf(other);
    EXPECT_TRUE(sameBits(before, filmOf(scene())));
}

}  // namespace

}  // namespace duolux::test

#include <gtest/gtest.h>

#include <vector>

#include "host/render/render.h"
#include "tests/statistical/films.h"
#include "tests/support/cornell.h"
#include "tests/support/device.h"
#include "tests/support/exact_case.h"

// A render that resumes from any saved state, and the sum of renders of ranges of samples, are bitwise
// identical to a single render, with both integrators.

namespace duolux::test {

namespace {

class Resume : public testing::TestWithParam<Integrator> {
  protected:
    static LoadedScene scene(std::uint32_t spp = 21) {
        LoadedScene result = mixedCornellBox();
        result.settings.width = 19;
        result.settings.height = 13;
        result.settings.spp = spp;
        result.settings.bounces = 5;
        result.settings.integrator = GetParam();
        return result;
    }
    /// So many surfaces on a ray that some drivers end dispatches early.
    static LoadedScene manyPanes() {
        LoadedScene result = stackedPanesCase(100).scene;
        result.settings.integrator = GetParam();
        result.settings.width = result.settings.height = 24;
        result.settings.spp = 9;
        return result;
    }
    /// Small dispatches, so that there are many states.
    static RenderControl inParts() {
        RenderControl control;
        control.limits.maxPixelsPerDispatch = 100;
        control.limits.maxSamplesPerDispatch = 6;
        return control;
    }
};

TEST_P(Resume, FromAnyStateGivesTheSameBits) {
    const RenderOutput whole = render(device(), scene(), {});
    std::vector<RenderState> states;
    RenderControl keeping = inParts();
    keeping.checkpointSeconds = 0.0;
    keeping.onCheckpoint = [&](const Film& film, const RenderStatistics& statistics) {
        states.push_back({film, statistics.lastBounceRadiance, statistics.previousBounceRadiance,
                          statistics.filmOverflowed});
    };
    EXPECT_TRUE(sameBits(render(device(), scene(), keeping).film, whole.film));
    ASSERT_GT(states.size(), 5u);
    for (std::size_t i = 0; i < states.size(); i += 1 + states.size() / 12) {
        RenderControl control = inParts();
        control.resume = &states[i];
        const RenderOutput output = render(device(), scene(), control);
        EXPECT_TRUE(sameBits(output.film, whole.film)) << i;
        const std::uint64_t before = states[i].film.totalSamples() + states[i].film.lightPaths();
        EXPECT_EQ(output.statistics.samples, whole.statistics.samples - before);
        EXPECT_NEAR(output.statistics.lastBounceRadiance, whole.statistics.lastBounceRadiance,
                    1e-5 * whole.statistics.lastBounceRadiance);
    }
}

TEST_P(Resume, WithMoreSamplesGivesTheBitsOfThese) {
    const RenderOutput some = render(device(), scene(9), {});
    const RenderState state{some.film, some.statistics.lastBounceRadiance,
                            some.statistics.previousBounceRadiance, false};
    RenderControl control;
    control.resume = &state;
    EXPECT_TRUE(sameBits(render(device(), scene(), control).film, render(device(), scene(), {}).film));
    // With a smaller spp, the film stays unchanged.
    const RenderOutput fewer = render(device(), scene(5), control);
    EXPECT_TRUE(sameBits(fewer.film, some.film));
    EXPECT_EQ(fewer.statistics.samples, 0u);
    EXPECT_FALSE(fewer.statistics.stopped);
}

TEST_P(Resume, GoesOnInTheUnitOfItsFilm) {
    const Film whole = render(device(), scene(), {}).film;
    const Film some = render(device(), scene(9), {}).film;
    Film finer(some.width(), some.height(), some.quantum() * 0x1p-3f);
    finer.add(some);
    const RenderState state{finer, 0.0, 0.0, false};
    RenderControl control;
    control.resume = &state;
    const Film resumed = render(device(), scene(), control).film;
    EXPECT_EQ(resumed.quantum(), finer.quantum());
    const RadianceImage image = resumed.resolve(), expected = whole.resolve();
    for (std::size_t i = 0; i < image.visible.size(); ++i) {
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(image.visible[i][c], expected.visible[i][c], 1e-5f * expected.visible[i][c] + 1e-5f);
    }
}

TEST_P(Resume, StoppedAnywhereLosesNothing) {
    // The render is stopped while work that the driver ended early is traced again.
    const LoadedScene panes = manyPanes();
    const Film whole = render(device(), panes, {}).film;
    for (int after = 1; after < 6; ++after) {
        int calls = 0;
        RenderControl control;
        control.limits.maxPixelsPerDispatch = 300;
        control.onProgress = [&](const RenderProgress&) { return ++calls < after; };
        const RenderOutput stopped = render(device(), panes, control);
        const RenderState state{stopped.film, 0.0, 0.0, false};
        control.onProgress = nullptr;
        control.resume = &state;
        EXPECT_TRUE(sameBits(render(device(), panes, control).film, whole)) << after;
    }
}

TEST_P(Resume, KeepsNoGapsWhereTheDriverCutsShort) {
    const LoadedScene panes = manyPanes();
    const Film whole = render(device(), panes, {}).film;
    std::vector<RenderState> states;
    RenderControl keeping;
    keeping.limits.maxPixelsPerDispatch = 150;
    keeping.limits.maxSamplesPerDispatch = 4;
    keeping.checkpointSeconds = 0.0;
    keeping.onCheckpoint = [&](const Film& film, const RenderStatistics&) {
        states.push_back({film, 0.0, 0.0, false});
    };
    render(device(), panes, keeping);
    ASSERT_GT(states.size(), 3u);
    for (std::size_t i = 0; i < states.size(); i += 1 + states.size() / 8) {
        RenderControl control;
        control.resume = &states[i];
        EXPECT_TRUE(sameBits(render(device(), panes, control).film, whole)) << i;
    }
}

TEST_P(Resume, RangesAddUp) {
    const Film whole = render(device(), scene(), {}).film;
    Film sum(whole.width(), whole.height(), whole.quantum());
    const std::uint32_t bounds[] = {0, 1, 8, 15, 21};
    for (int i = 3; i >= 0; --i) {
        RenderControl control;
        control.samples = SampleRange{bounds[i], bounds[i + 1]};
        const RenderOutput part = render(device(), scene(), control);
        EXPECT_FALSE(part.statistics.stopped);
        sum.add(part.film);
    }
    EXPECT_TRUE(sameBits(sum, whole));
}

TEST_P(Resume, AFilmOfAnotherSizeIsRefused) {
    const LoadedScene box = scene(2);
    const RenderState state{render(device(), box).film};
    RenderControl control;
    control.resume = &state;
    RenderSettings settings = box.settings;
    ++settings.width;
    EXPECT_THROW(render(device(), box, settings, control), UsageError);
}

TEST_P(Resume, AnEmptyRangeIsRefused) {
    RenderControl control;
    control.samples = SampleRange{3, 3};
    EXPECT_THROW(render(device(), scene(), control), UsageError);
}

INSTANTIATE_TEST_SUITE_P(All, Resume, testing::Values(Integrator::kPathTracer, Integrator::kLightTracer),
                         [](const auto& test) {
                             return test.param == Integrator::kPathTracer ? "Path" : "Light";
                         });

}  // namespace

}  // namespace duolux::test

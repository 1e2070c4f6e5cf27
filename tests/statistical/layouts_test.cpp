#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <ostream>
#include <string>

#include "host/base/error.h"
#include "tests/statistical/films.h"
#include "tests/statistical/renders.h"
#include "tests/support/cornell.h"
#include "tests/support/device.h"
#include "tests/support/exact_case.h"
#include "tests/support/tunings.h"

// The image does not depend on the layout of the scene in device memory, nor on when lanes get new rays: it
// is bitwise identical with our own traversal, and equal up to rounding if the driver intersects triangles.

namespace duolux::test {

namespace {

struct LayoutCase {
    std::string name;
    LoadedScene scene;
};

/// For messages of the test framework.
void PrintTo(const LayoutCase& c, std::ostream* out) {
    *out << c.name;
}

std::vector<LayoutCase> layoutCases() {
    std::vector<LayoutCase> cases;
    const auto add = [&](const std::string& name, LoadedScene scene) {
        scene.settings.width = 19;
        scene.settings.height = 13;
        scene.settings.spp = 5;
        scene.settings.bounces = 4;
        cases.push_back({name + "Path", scene});
        cases.push_back({name + "Light", byLight(scene)});
    };
    for (const char* preset : {"global", "shadowless", "one-bounce", "local", "mixed"}) {
        const bool mixed = preset == std::string("mixed");
        LoadedScene scene = mixed ? mixedCornellBox() : cornellBox();
        if (!mixed) scene.reflectance = *presetReflectance(preset);
        add(preset == std::string("one-bounce") ? "oneBounce" : preset, scene);
    }
    // Rays that only search for emitters, in a tree of these, find much of the light.
    LoadedScene glowing = cornellBox();
    glowing.reflectance = *presetReflectance("shadowless");
    for (const CornellMaterial material : {kRed, kGreen, kShort, kTall})
        glowing.materials[material].emission = {glm::vec3(1.0f), glm::vec3(0.5f), Sides::kBoth};
    add("glowing", glowing);
    return cases;
}

RenderControl controlOf(const TuningChoice& choice) {
    RenderControl control;
    control.tuning = choice;
    return control;
}

const TuningChoice kByRayQuery{Layout::kRayQuery, {}};

class Layouts : public testing::TestWithParam<LayoutCase> {};

TEST_P(Layouts, OfOurOwnTreeGiveTheSameBits) {
    const LoadedScene& scene = GetParam().scene;
    const Film expected = render(device(), scene).film;
    for (const TuningChoice& choice : allTunings(device().info())) {
        if (choice.layout == Layout::kRayQuery) continue;
        const RenderOutput output = render(device(), scene, controlOf(choice));
        EXPECT_EQ(output.statistics.tuning.layout, choice.layout);
        EXPECT_EQ(output.statistics.tuning.kernel, choice.kernel);
        EXPECT_TRUE(sameBits(output.film, expected)) << nameOf(choice);
    }
}

/// Rounding of distances and barycentric coordinates changes a path only slightly. Paths differ only if a ray
/// passes an edge on the other side, and then by at most two samples: the means are equal.
TEST_P(Layouts, OfTheDriversTreeGiveTheSamePicture) {
    if (!device().info().rayQueries) {
        EXPECT_THROW(render(device(), GetParam().scene, controlOf(kByRayQuery)), UsageError);
        return;
    }
    LoadedScene scene = GetParam().scene;
    const bool lightPaths = scene.settings.integrator == Integrator::kLightTracer;
    const RenderOutput ours = render(device(), scene);
    const RenderOutput theirs = render(device(), scene, controlOf(kByRayQuery));
    EXPECT_EQ(theirs.statistics.tuning.layout, Layout::kRayQuery);
    const std::vector<glm::vec3> a = ours.film.resolve().visible;
    const std::vector<glm::vec3> b = theirs.film.resolve().visible;
    std::size_t alike = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        alike += glm::length(a[i] - b[i]) <= 1e-3f * glm::length(a[i]) ? 1 : 0;
    EXPECT_GE(static_cast<double>(alike), 0.95 * static_cast<double>(a.size()));
    const Renders renders = renderSeeds(scene, 16, 12, 1, controlOf(kByRayQuery));
    expectAgreement("RayQuery" + GetParam().name, renders, estimatesOf(renderSeeds(scene, 16, 12, 1000)),
                    {.lightPaths = lightPaths});
}

INSTANTIATE_TEST_SUITE_P(All, Layouts, testing::ValuesIn(layoutCases()),
                         [](const auto& test) { return test.param.name; });

/// Products of T in the order of crossings, including coincident surfaces, with emitters behind.
TEST(RayQuery, MatchesClosedFormsOfCrossings) {
    std::vector<ExactCase> cases = crossingCases();
    for (const auto& more : {blockerCases(), lambertCases()})
        cases.insert(cases.end(), more.begin(), more.end());
    if (!device().info().rayQueries) {
        EXPECT_THROW(render(device(), cases.front().scene, controlOf(kByRayQuery)), UsageError);
        return;
    }
    for (const ExactCase& exact : cases) {
        const Renders renders = renderSeeds(exact.scene, 64, 4, 1, controlOf(kByRayQuery));
        expectAgreement(exact.name + "RayQuery", renders, exact.expected, {.relative = exact.relative});
    }
}

}  // namespace

}  // namespace duolux::test

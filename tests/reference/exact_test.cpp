#include <gtest/gtest.h>

#include "tests/reference/estimates_image.h"
#include "tests/support/agreement.h"
#include "tests/support/exact_case.h"

// The reference itself against closed forms, because other tests rely on it.

namespace duolux::test {

namespace {

class ReferenceExact : public testing::TestWithParam<ExactCase> {};

TEST_P(ReferenceExact, MatchesClosedForm) {
    const ExactCase& exact = GetParam();
    reference::Settings settings;
    settings.width = exact.expected.width;
    settings.height = exact.expected.height;
    settings.bounces = exact.scene.settings.bounces;
    settings.search = exact.search;
    settings.samples = exact.search == reference::LightSearch::kArea ? 256 : 12;
    std::vector<RadianceImage> renders;
    for (settings.seed = 1; settings.seed <= 4; ++settings.seed) {
        renders.push_back(imageOf(reference::trace(exact.scene, settings)));
    }
    const Agreement agreement = judge(renders, exact.expected, {.relative = exact.relative});
    EXPECT_TRUE(agreement.agrees) << agreement.report;
}

INSTANTIATE_TEST_SUITE_P(All, ReferenceExact, testing::ValuesIn(exactCases()),
                         [](const auto& test) { return test.param.name; });

}  // namespace

}  // namespace duolux::test

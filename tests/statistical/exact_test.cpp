#include <gtest/gtest.h>

#include "tests/statistical/renders.h"
#include "tests/support/exact_case.h"

// The kernels against closed forms. What each family of cases catches is told where it is built.

namespace duolux::test {

namespace {

class Exact : public testing::TestWithParam<ExactCase> {};

TEST_P(Exact, MatchesClosedForm) {
    const ExactCase& exact = GetParam();
    expectAgreement(exact.name, renderSeeds(exact.scene, 128, 4), exact.expected,
                    {.relative = exact.relative});
}

INSTANTIATE_TEST_SUITE_P(All, Exact, testing::ValuesIn(exactCases()),
                         [](const auto& test) { return test.param.name; });

}  // namespace

/// For messages of the test framework.
void PrintTo(const ExactCase& exact, std::ostream* out) {
    *out << exact.name;
}

}  // namespace duolux::test

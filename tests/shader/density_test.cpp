#include "tests/shader/density.h"

#include <gmock/gmock.h>
#include <gtest/gtest-spi.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <numbers>
#include <random>

#include "tests/shader/oracles.h"

// The statistical tests for the shader library detect wrong densities.

namespace duolux::test {
namespace {

constexpr Rectangle kUnitSquare{{0, 0}, {1, 1}};

std::vector<glm::dvec2> rampSamples(std::size_t count) {
    std::mt19937 engine(5);
    std::uniform_real_distribution<double> uniform;
    std::vector<glm::dvec2> samples(count);
    for (glm::dvec2& s : samples)
        s = {std::sqrt(uniform(engine)), uniform(engine)};  // density 2x
    return samples;
}

TEST(ExpectDensity, IntegratesPolynomialsAndSmoothFunctions) {
    EXPECT_NEAR(integrate([](double x, double y) { return 9.0 * x * x * y * y; }, {{0, -1}, {1, 1}}, 1), 2.0,
                1e-14);
    EXPECT_NEAR(integrate([](double x, double y) { return std::sin(x) * std::exp(y); },
                          {{0, 0}, {std::numbers::pi, 1}}, 4),
                2.0 * (std::numbers::e - 1.0), 1e-12);
}

TEST(ExpectDensity, AcceptsSamplesOfTheDensity) {
    expectDensity(
        "ramp", rampSamples(100000), kUnitSquare, [](double x, double) { return 2.0 * x; }, 1e-4);
}

TEST(ExpectDensity, RefusesSamplesOfAnotherAndLeavesPictures) {
    const std::filesystem::path z = std::filesystem::path(DUOLUX_ARTEFACTS) / "wrong-ramp-z.pfm";
    std::filesystem::remove(z);
    static const std::vector<glm::dvec2> samples = rampSamples(100000);
    EXPECT_NONFATAL_FAILURE(
        expectDensity(
            "wrong-ramp", samples, kUnitSquare, [](double x, double) { return 1.9 * x + 0.05; }, 1e-4),
        "chi-square");
    EXPECT_TRUE(std::filesystem::exists(z));
    EXPECT_NONFATAL_FAILURE(
        expectDensity(
            "unnormalised", samples, kUnitSquare, [](double x, double) { return 2.002 * x; }, 1e-9),
        "integral");
}

TEST(Census, SaysOnceHowManyAreOffAndHowFar) {
    testing::TestPartResultArray failures;
    {
        const testing::ScopedFakeTestPartResultReporter reporter(&failures);
        Census census("a thing");
        for (std::size_t i = 0; i < 100; ++i)
            census.compare(i, glm::vec2(0.0f, i < 90 ? 0.5f : static_cast<float>(i)), glm::vec2(0.0f), 1.0);
    }
    ASSERT_EQ(failures.size(), 1);
    EXPECT_THAT(failures.GetTestPartResult(0).message(),
                testing::HasSubstr("a thing: 10 of 200 numbers are off, in 10 invocations\n"
                                   "  first: invocation 90, number 1: 90, expected 0, allowed 1\n"
                                   "  worst: invocation 99, number 1: 99, expected 0, allowed 1\n"
                                   "  off by\n    64 to 128 times what is allowed: 10"));
}

TEST(Census, OfNothingFails) {
    EXPECT_NONFATAL_FAILURE({ const Census census("a thing"); }, "nothing was compared");
}

TEST(ExpectOracles, FindsWhatIsBeyondTheBudget) {
    static const std::vector<float> inputs{1.0f, 2.0f, 3.0f};
    const auto half = [](auto x) { return x / 2; };
    static std::vector<float> device{0.5f, 1.0f, 1.5f};
    EXPECT_WITHIN_ORACLES("half", device, Budget{0, 0}, half, half, inputs);
    device[2] = std::nextafter(1.5f, 2.0f);
    EXPECT_WITHIN_ORACLES("half", device, Budget{1, 0}, half, half, inputs);
    // Both oracles report a failure; the macros require exactly one each.
    testing::TestPartResultArray failures;
    {
        const testing::ScopedFakeTestPartResultReporter reporter(&failures);
        EXPECT_WITHIN_ORACLES("half", device, Budget{0.9, 1e-8}, half, half, inputs);
        device[0] = NAN;
        EXPECT_WITHIN_ORACLES("half", device, Budget{1e6, 1e6}, half, half, inputs);
    }
    EXPECT_EQ(failures.size(), 4);
    EXPECT_NE(
        std::string(failures.GetTestPartResult(0).message()).find("1 of 3 numbers are off, in 1 invocations"),
        std::string::npos);
}

}  // namespace
}  // namespace duolux::test

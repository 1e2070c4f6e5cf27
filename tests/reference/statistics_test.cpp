#include "tests/support/statistics.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <random>

#include "tests/support/agreement.h"
#include "tests/support/closed_form.h"

namespace duolux::test {

namespace {

TEST(Statistics, StudentAgreesWithTables) {
    EXPECT_NEAR(studentTwoSided(1.0, 1.0), 0.5, 1e-12);  // Cauchy
    EXPECT_NEAR(studentTwoSided(2.0, 2.0), 1.0 - 2.0 / std::sqrt(6.0), 1e-12);
    EXPECT_NEAR(studentTwoSided(2.131449546, 15.0), 0.05, 1e-9);
    EXPECT_NEAR(studentTwoSided(6.0, 1e9) / 1.973175290e-9, 1.0, 1e-6);
    EXPECT_NEAR(studentTwoSided(6.0, 1e5) / studentTwoSided(6.0, 1e7), 1.0, 0.02);
}

TEST(Statistics, ChiSquareAgreesWithTables) {
    EXPECT_NEAR(chiSquareTail(2.0 * std::log(20.0), 2.0), 0.05, 1e-12);  // exp(-x/2)
    EXPECT_NEAR(chiSquareTail(3.841458821, 1.0), 0.05, 1e-9);
    EXPECT_NEAR(chiSquareTail(124.3421134, 100.0), 0.05, 1e-8);
    EXPECT_NEAR(chiSquareTail(67.32756330, 100.0), 0.995, 1e-8);
}

TEST(Statistics, ChiSquareMergesBinsOfLowExpectation) {
    const std::vector<double> expected{100.0, 2.0, 100.0, 3.0, 1.0};  // 1 + 2 + 3 make one bin
    const ChiSquare same = chiSquare(expected, expected);
    EXPECT_EQ(same.degrees, 2.0);
    EXPECT_EQ(same.p, 1.0);
    const ChiSquare off = chiSquare(std::vector<double>{120.0, 2.0, 80.0, 3.0, 1.0}, expected);
    EXPECT_NEAR(off.statistic, 8.0, 1e-12);
    EXPECT_NEAR(off.p, std::exp(-4.0), 1e-12);
    EXPECT_EQ(chiSquare(std::vector<double>{9.0, 1.0}, std::vector<double>{10.0, 0.0}).p, 0.0);
    // Two bins of 8; the remaining 4 are merged into the last bin.
    const ChiSquare rest =
        chiSquare(std::vector<double>{4.0, 4.0, 4.0, 0.0, 8.0}, std::vector<double>(5, 4.0));
    EXPECT_EQ(rest.degrees, 1.0);
    EXPECT_NEAR(rest.statistic, 0.0, 1e-12);
    EXPECT_EQ(chiSquare(std::vector<double>{0.0, 0.0, 9.0}, std::vector<double>(3, 1.0)).p, 0.0);
}

TEST(Statistics, SidakKeepsTheFamilyLevel) {
    EXPECT_NEAR(1.0 - std::pow(1.0 - sidakLevel(0.05, 20), 20.0), 0.05, 1e-12);
    EXPECT_NEAR(sidakLevel(1e-4, 6144), 1e-4 / 6144, 1e-11);
}

TEST(Statistics, WelchIgnoresWhatIsTolerated) {
    EXPECT_EQ(welch({1.0, 0.0, 1.0}, {1.01, 0.0, 1.0}, 0.02).p, 1.0);
    EXPECT_EQ(welch({1.0, 0.0, 1.0}, {1.01, 0.0, 1.0}, 0.005).p, 0.0);
    EXPECT_LT(welch({1.0, 1e-6, 15.0}, {1.1, 1e-6, 15.0}, 0.0).t, 0.0);
}

TEST(LambertPolygon, ClosedForms) {
    // Parallel unit squares at distance 1, from below a corner: half of
    // x/sqrt(1+x^2) atan(y/sqrt(1+x^2)) + y/sqrt(1+y^2) atan(x/sqrt(1+y^2)), x = y = 1.
    const std::array<Vec3, 4> square = {{{0, 1, 0}, {1, 1, 0}, {1, 1, 1}, {0, 1, 1}}};
    const double expected = std::atan(1.0 / std::sqrt(2.0)) / std::sqrt(2.0);
    EXPECT_NEAR(lambertPolygon(Vec3(0.0), {0, 1, 0}, square), expected, 1e-12);
    EXPECT_NEAR(lambertPolygon(Vec3(0.0), {0, -1, 0}, square), 0.0, 1e-12);
    // A polygon that covers nearly the whole hemisphere: pi. A vertical receiver, whose horizon cuts the
    // polygon, sees half of it.
    const std::array<Vec3, 4> sky = {{{-1e6, 1, -1e6}, {1e6, 1, -1e6}, {1e6, 1, 1e6}, {-1e6, 1, 1e6}}};
    EXPECT_NEAR(lambertPolygon(Vec3(0.0), {0, 1, 0}, sky), std::numbers::pi, 1e-5);
    EXPECT_NEAR(lambertPolygon(Vec3(0.0), {1, 0, 0}, sky), std::numbers::pi / 2, 1e-5);
}

/// Renders that consist of noise about `mean`, with a standard deviation that varies over the image.
std::vector<RadianceImage> noise(double bias, double ripple) {
    std::mt19937_64 random(7);
    std::exponential_distribution<double> unit;
    std::vector<RadianceImage> renders(16);
    for (RadianceImage& image : renders) {
        image = {16, 16, std::vector<glm::vec3>(256), std::vector<glm::vec3>(256)};
        for (std::size_t i = 0; i < 256; ++i) {
            const double sign = i % 2 == 0 ? 1.0 : -1.0;
            for (int c = 0; c < 3; ++c) {
                double sum = 0.0;
                for (int s = 0; s < 64; ++s)
                    sum += unit(random) - 1.0;
                const double spread = 0.05 * (1.0 + static_cast<double>(i % 16)) * sum / 64;
                image.visible[i][c] = static_cast<float>(1.0 + bias + sign * ripple + spread);
            }
        }
    }
    return renders;
}

TEST(Judge, AcceptsNoiseAndSeesBias) {
    const reference::Estimates one = uniformImage(16, 16, {{{0.0, 1.0}, {0.0, 1.0}, {0.0, 1.0}}});
    EXPECT_TRUE(judge(noise(0.0, 0.0), one).agrees) << judge(noise(0.0, 0.0), one).report;
    // The standard error of a pixel is between 0.0016 and 0.025, that of the image 0.0009.
    EXPECT_FALSE(judge(noise(0.01, 0.0), one).agrees);
    EXPECT_TRUE(judge(noise(0.01, 0.0), one, {.relative = 0.011}).agrees);
    // A bias too small for any pixel, which cancels in every block.
    const Agreement ripple = judge(noise(0.0, 0.006), one);
    EXPECT_FALSE(ripple.agrees) << ripple.report;
}

}  // namespace

}  // namespace duolux::test

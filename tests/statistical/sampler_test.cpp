#include <gtest/gtest.h>

#include <cmath>

#include "tests/reference/tracer.h"
#include "tests/statistical/renders.h"
#include "tests/support/cornell.h"
#include "tests/support/scene_builder.h"

// Both samplers must have the same mean; the low-discrepancy one earns its keep by less noise, and neither
// may correlate pixels, on which every test of blocks relies.

namespace duolux::test {

namespace {

constexpr std::uint32_t kSeeds = 16;

/// Direct and twice reflected light in an empty room: as smooth as a picture gets.
Scene smoothBox(Sampler sampler) {
    Scene scene = emptyCornellBox();
    scene.reflectance = preset("global");
    scene.render.width = scene.render.height = 24;
    scene.render.bounces = 3;
    scene.render.sampler = sampler;
    return scene;
}

/// Variances over the seeds of visible green, the brightest channel to the eye.
struct Spread {
    double pixel = 0.0;  ///< of a pixel, mean over pixels
    double image = 0.0;  ///< of the image's mean
};

Spread spreadOf(const Renders& renders) {
    const auto count = static_cast<double>(renders.images.size());
    const std::size_t pixels = renders.images.front().visible.size();
    const auto variance = [&](auto&& value) {
        double sum = 0.0, squares = 0.0;
        for (const RadianceImage& image : renders.images)
            sum += value(image);
        for (const RadianceImage& image : renders.images)
            squares += std::pow(value(image) - sum / count, 2);
        return squares / (count - 1.0);
    };
    Spread spread;
    for (std::size_t i = 0; i < pixels; ++i) {
        spread.pixel +=
            variance([&](const RadianceImage& image) { return static_cast<double>(image.visible[i].g); });
    }
    spread.pixel /= static_cast<double>(pixels);
    spread.image = variance([&](const RadianceImage& image) {
        double sum = 0.0;
        for (const glm::vec3& v : image.visible)
            sum += static_cast<double>(v.g);
        return sum / static_cast<double>(pixels);
    });
    return spread;
}

class BothSamplers : public testing::TestWithParam<Sampler> {};

TEST_P(BothSamplers, MeanIsThatOfTheReference) {
    reference::Settings settings;
    settings.width = settings.height = 24;
    settings.bounces = 3;
    settings.samples = 2048;
    const Scene scene = smoothBox(GetParam());
    const reference::Estimates expected = reference::trace(scene, settings);
    expectAgreement(GetParam() == Sampler::kSobol ? "SamplerSobol" : "SamplerIndependent",
                    renderSeeds(scene, 64, kSeeds), expected);
}

TEST_P(BothSamplers, PixelsAreNotCorrelated) {
    // If they are independent, N times the variance of the image's mean is the mean variance of a pixel. Over
    // 15 degrees of freedom the ratio stays below chi^2 = 44.3 / 15 with probability 0.9999. Negative
    // correlation, as of blue noise, would be welcome.
    const Spread spread = spreadOf(renderSeeds(smoothBox(GetParam()), 16, kSeeds));
    EXPECT_LT(spread.image * 24 * 24 / spread.pixel, 44.3 / 15);
}

INSTANTIATE_TEST_SUITE_P(All, BothSamplers, testing::Values(Sampler::kSobol, Sampler::kIndependent),
                         [](const auto& test) {
                             return test.param == Sampler::kSobol ? "Sobol" : "Independent";
                         });

TEST(Samplers, IndependentNoiseFallsAsTheRootOfTheSamples) {
    // Samples of a pixel that repeat or correlate would fall more slowly. 576 pixels of 15 degrees of freedom
    // each: the ratio is 16 within a few percent, the pixels' noise not being alike.
    const double few = spreadOf(renderSeeds(smoothBox(Sampler::kIndependent), 16, kSeeds)).pixel;
    const double many = spreadOf(renderSeeds(smoothBox(Sampler::kIndependent), 256, kSeeds)).pixel;
    EXPECT_NEAR(few / many, 16.0, 3.0);
}

TEST(Samplers, SobolIsLessNoisyThanIndependent) {
    // Root mean square error over pixels and seeds about the mean, at 256 samples. On a picture this smooth a
    // scrambled Sobol sequence should halve it; dimensions reused between bounces or lights, or a sequence
    // that is not stratified, would not. The ratio is known to about 2 %.
    const double independent = spreadOf(renderSeeds(smoothBox(Sampler::kIndependent), 256, kSeeds)).pixel;
    const double sobol = spreadOf(renderSeeds(smoothBox(Sampler::kSobol), 256, kSeeds)).pixel;
    EXPECT_LT(std::sqrt(sobol / independent), 0.8);
}

}  // namespace

}  // namespace duolux::test

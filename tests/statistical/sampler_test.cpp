#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <utility>
#include <vector>

#include "tests/reference/tracer.h"
#include "tests/statistical/renders.h"
#include "tests/support/cornell.h"
#include "tests/support/scene_builder.h"

// Both samplers must have the same mean, the low-discrepancy sampler must have less noise, and neither may
// correlate pixels, because all tests of blocks rely on that.

namespace duolux::test {

namespace {

constexpr std::uint32_t kSeeds = 16;

/// Direct and twice reflected light in an empty room: a very smooth image.
LoadedScene smoothBox(Sampler sampler) {
    LoadedScene scene = emptyCornellBox();
    scene.reflectance = preset("global");
    scene.settings.width = scene.settings.height = 24;
    scene.settings.bounces = 3;
    scene.settings.sampler = sampler;
    return scene;
}

/// Visible green, the brightest channel to the eye, of one pixel in all renders, minus its mean.
std::vector<double> deviations(const Renders& renders, std::size_t pixel) {
    std::vector<double> values;
    for (const RadianceImage& image : renders.images)
        values.push_back(static_cast<double>(image.visible[pixel].g));
    const double mean =
        std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
    for (double& v : values)
        v -= mean;
    return values;
}

double dot(const std::vector<double>& a, const std::vector<double>& b) {
    return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

/// Variance of a pixel over the seeds, averaged over pixels.
double pixelVariance(const Renders& renders) {
    const std::size_t pixels = renders.images.front().visible.size();
    double sum = 0.0;
    for (std::size_t i = 0; i < pixels; ++i) {
        const std::vector<double> d = deviations(renders, i);
        sum += dot(d, d) / static_cast<double>(d.size() - 1);
    }
    return sum / static_cast<double>(pixels);
}

/// Correlation over the seeds between pixels that are (dx, dy) apart: the mean over all such pairs, in
/// standard errors of that mean for independent pixels.
double correlation(const Renders& renders, std::uint32_t dx, std::uint32_t dy) {
    const std::uint32_t width = renders.images.front().width, height = renders.images.front().height;
    double sum = 0.0, pairs = 0.0;
    for (std::uint32_t y = 0; y + dy < height; ++y) {
        for (std::uint32_t x = 0; x + dx < width; ++x) {
            const std::vector<double> a = deviations(renders, std::size_t{y} * width + x),
                                      b = deviations(renders, std::size_t{y + dy} * width + x + dx);
            const double norms = dot(a, a) * dot(b, b);
            if (!(norms > 0.0)) continue;
            sum += dot(a, b) / std::sqrt(norms);
            ++pairs;
        }
    }
    // The coefficient of two independent sets of n deviations has the variance 1 / (n - 1).
    const double degrees = static_cast<double>(renders.images.size()) - 1.0;
    return sum / pairs * std::sqrt(pairs * degrees);
}

class BothSamplers : public testing::TestWithParam<Sampler> {};

TEST_P(BothSamplers, MeanIsThatOfTheReference) {
    reference::Settings settings;
    settings.width = settings.height = 24;
    settings.bounces = 3;
    settings.samples = 2048;
    const LoadedScene scene = smoothBox(GetParam());
    const reference::Estimates expected = reference::trace(scene, settings);
    expectAgreement(GetParam() == Sampler::kSobol ? "SamplerSobol" : "SamplerIndependent",
                    renderSeeds(scene, 64, kSeeds), expected);
}

TEST_P(BothSamplers, PixelsAreNotCorrelated) {
    // Negative correlation, as in blue noise, is allowed.
    const Renders renders = renderSeeds(smoothBox(GetParam()), 16, kSeeds);
    for (const auto& [dx, dy] :
         {std::pair(1u, 0u), std::pair(0u, 1u), std::pair(1u, 1u), std::pair(8u, 0u), std::pair(0u, 8u)}) {
        EXPECT_LT(correlation(renders, dx, dy), 5.0) << dx << ", " << dy;
    }
}

INSTANTIATE_TEST_SUITE_P(All, BothSamplers, testing::Values(Sampler::kSobol, Sampler::kIndependent),
                         [](const auto& test) {
                             return test.param == Sampler::kSobol ? "Sobol" : "Independent";
                         });

TEST(Samplers, IndependentNoiseFallsAsTheRootOfTheSamples) {
    // If samples of a pixel repeated or correlated, noise would decrease more slowly. 576 pixels with 15
    // degrees of freedom each: the ratio is 16 within a few percent, because the noise differs between
    // pixels.
    const double few = pixelVariance(renderSeeds(smoothBox(Sampler::kIndependent), 16, kSeeds));
    const double many = pixelVariance(renderSeeds(smoothBox(Sampler::kIndependent), 256, kSeeds));
    EXPECT_NEAR(few / many, 16.0, 3.0);
}

TEST(Samplers, SobolIsLessNoisyThanIndependent) {
    // Root mean square deviation from the mean over pixels and seeds, at 256 samples. For such a smooth
    // image, a scrambled Sobol sequence should halve it, but not if dimensions are reused between bounces or
    // lights, or the sequence is not stratified. The ratio is accurate to about 2 %.
    const double independent = pixelVariance(renderSeeds(smoothBox(Sampler::kIndependent), 256, kSeeds));
    const double sobol = pixelVariance(renderSeeds(smoothBox(Sampler::kSobol), 256, kSeeds));
    EXPECT_LT(std::sqrt(sobol / independent), 0.8);
}

}  // namespace

}  // namespace duolux::test

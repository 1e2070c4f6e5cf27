#include <gtest/gtest.h>

#include <cmath>

#include "tests/reference/tracer.h"
#include "tests/statistical/renders.h"
#include "tests/support/cornell.h"
#include "tests/support/scene_builder.h"

// Radiance does not depend on the unit of length or on the origin. A ray offset that is an absolute length,
// or too long for the scene, darkens corners and contacts at some scales and leaks light at others.

namespace duolux::test {

namespace {

constexpr std::uint32_t kSpp = 64;

LoadedScene box() {
    LoadedScene scene = cornellBox();
    scene.reflectance = preset("global");
    scene.settings.width = scene.settings.height = 48;
    scene.settings.bounces = 6;
    return scene;
}

/// Differences of two images relative to the mean of the first, over pixels, channels and components.
struct Difference {
    double absolute = 0.0, signedMean = 0.0;
};

Difference difference(const RadianceImage& a, const RadianceImage& b) {
    Difference d;
    double sum = 0.0;
    for (std::size_t i = 0; i < a.visible.size(); ++i) {
        for (int c = 0; c < 3; ++c) {
            for (const auto& [p, q] : {std::pair(a.visible[i][c], b.visible[i][c]),
                                       std::pair(a.invisible[i][c], b.invisible[i][c])}) {
                sum += static_cast<double>(p);
                d.absolute += std::abs(static_cast<double>(q - p));
                d.signedMean += static_cast<double>(q - p);
            }
        }
    }
    return {d.absolute / sum, d.signedMean / sum};
}

RadianceImage oneRender(const LoadedScene& scene) {
    return renderSeeds(scene, kSpp, 1).images.front();
}

class Scale : public testing::TestWithParam<float> {};

TEST_P(Scale, SameImageAtAnyScale) {
    // The same seeds give the same paths, except those that rounding sends past the other side of an edge: a
    // few in 10^5 bounces, at 64 samples per pixel. They differ by whole samples of either sign.
    const Difference d = difference(oneRender(box()), oneRender(transformed(box(), GetParam())));
    EXPECT_LT(d.absolute, 1e-3);
    EXPECT_LT(std::abs(d.signedMean), 1e-4);
}

INSTANTIATE_TEST_SUITE_P(All, Scale, testing::Values(1e-2f, 0.1f, 2.0f, 100.0f, 1e3f),
                         [](const auto& test) { return "Case" + std::to_string(test.index); });

TEST(Translation, SameImageFarFromTheOrigin) {
    // At 20 times its size from the origin, the box's coordinates keep 19 bits.
    const Difference d =
        difference(oneRender(box()), oneRender(transformed(box(), 1.0f, {8000, -9000, 11000})));
    EXPECT_LT(std::abs(d.signedMean), 1e-3);
}

/// The scaled images could all have the same error, so the extremes are also compared with the reference.
TEST(Translation, ExtremeScalesMatchReference) {
    reference::Settings settings;
    settings.width = settings.height = 48;
    settings.bounces = 6;
    settings.samples = 384;
    const reference::Estimates expected = reference::trace(box(), settings);
    expectAgreement("ScaleSmall", renderSeeds(transformed(box(), 1e-2f), 32, 12), expected);
    expectAgreement("ScaleLarge", renderSeeds(transformed(box(), 1e3f), 32, 12), expected);
}

}  // namespace

}  // namespace duolux::test

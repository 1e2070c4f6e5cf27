#include <gtest/gtest.h>

#include <cmath>

#include "host/base/srgb.h"
#include "host/tools/compare/compare.h"
#include "host/tools/compare/heat_map.h"

// Every metric against values calculated by hand.

namespace duolux {
namespace {

RadianceImage image(std::uint32_t width, std::vector<glm::vec3> visible) {
    const auto height = static_cast<std::uint32_t>(visible.size()) / width;
    return {width, height, std::vector<glm::vec3>(visible.size()), std::move(visible)};
}

const RadianceImage kImage = image(2, {{0.5f, 0.25f, 0.0f}, {1.0f, 1.0f, 1.0f}});
const RadianceImage kReference = image(2, {{0.25f, 0.25f, 0.0f}, {1.0f, 1.0f, 0.5f}});

TEST(Compare, TwoPixelsByHand) {
    CompareOptions options;
    options.transfer = Transfer::kLinear;
    const Comparison c = compare(kImage, kReference, options);
    EXPECT_EQ(c.pixels, 2u);
    EXPECT_NEAR(c.epsMean, (0.25 + 0.5) / 2 / std::sqrt(3.0), 1e-12);
    EXPECT_NEAR(c.epsMax, 0.5 / std::sqrt(3.0), 1e-12);
    EXPECT_EQ(c.epsAboveOneCode, 1.0);
    EXPECT_NEAR(c.averageColour, std::sqrt((0.125 * 0.125 + 0.25 * 0.25) / 3), 1e-12);
    EXPECT_NEAR(c.signedMean, 0.75 / 6, 1e-12);
    EXPECT_NEAR(c.rmse, std::sqrt((0.0625 + 0.25) / 6), 1e-12);
    EXPECT_NEAR(c.relativeMse, (0.0625 / 0.0725 + 0.25 / 0.26) / 6, 1e-12);
    EXPECT_NEAR(c.psnr, -10 * std::log10(0.3125 / 6), 1e-12);
}

TEST(Compare, ErrorsOfOppositeSignCancelInTheSignedMeanAndTheAverageColourAlone) {
    CompareOptions options;
    options.transfer = Transfer::kLinear;
    const Comparison c = compare(image(2, {glm::vec3(0.6f), glm::vec3(0.4f)}),
                                 image(2, {glm::vec3(0.5f), glm::vec3(0.5f)}), options);
    EXPECT_NEAR(c.signedMean, 0.0, 1e-7);
    EXPECT_NEAR(c.averageColour, 0.0, 1e-7);
    EXPECT_NEAR(c.epsMean, 0.1, 1e-7);
    EXPECT_NEAR(c.rmse, 0.1, 1e-7);
}

TEST(Compare, EqualImages) {
    const Comparison c = compare(kImage, kImage, {});
    for (const auto& [name, value] : c.metrics()) {
        if (name == "psnr") {
            EXPECT_TRUE(std::isinf(value));
        } else {
            EXPECT_EQ(value, 0.0) << name;
        }
    }
}

TEST(Compare, DisplayedValuesAreExposedClampedAndEncoded) {
    // Radiance 2 and 1 are displayed alike; the linear metrics see the difference.
    const Comparison bright = compare(image(1, {glm::vec3(2.0f)}), image(1, {glm::vec3(1.0f)}), {});
    EXPECT_EQ(bright.epsMax, 0.0);
    EXPECT_EQ(bright.rmse, 1.0);
    // Two neighbouring codes of a PNG.
    const auto code = [](std::uint8_t value) { return image(1, {glm::vec3(fromSrgb8(value))}); };
    const Comparison codes = compare(code(128), code(129), {});
    EXPECT_NEAR(codes.epsMean, 1.0 / 255, 1e-7);
    // A stop of exposure doubles the displayed value of a linear display.
    CompareOptions options;
    options.transfer = Transfer::kLinear;
    options.exposure = 1.0f;
    const Comparison exposed = compare(image(1, {glm::vec3(0.2f)}), image(1, {glm::vec3(0.1f)}), options);
    EXPECT_NEAR(exposed.epsMean, 0.2, 1e-7);
    EXPECT_NEAR(exposed.rmse, 0.1, 1e-7);
}

TEST(Compare, TheThresholdOfOneCodeIsExclusive) {
    CompareOptions options;
    options.transfer = Transfer::kLinear;
    const std::vector<glm::vec3> black(4, glm::vec3(0.0f));
    const Comparison c =
        compare(image(4, {glm::vec3(0.0f), glm::vec3(0.0039f), glm::vec3(0.00393f), glm::vec3(1.0f)}),
                image(4, black), options);
    EXPECT_EQ(c.epsAboveOneCode, 0.5);
}

TEST(Compare, MaskedPixelsDoNotCount) {
    CompareOptions options;
    options.transfer = Transfer::kLinear;
    options.mask = {true, false};
    const Comparison c = compare(kImage, kReference, options);
    EXPECT_EQ(c.pixels, 1u);
    EXPECT_NEAR(c.epsMax, 0.25 / std::sqrt(3.0), 1e-12);
    EXPECT_NEAR(c.signedMean, 0.25 / 3, 1e-12);
}

TEST(Compare, TheDisplayRowChoosesComponents) {
    RadianceImage a = image(1, {glm::vec3(0.25f)});
    a.invisible[0] = glm::vec3(0.5f);
    CompareOptions options;
    options.transfer = Transfer::kLinear;
    options.display = {1.0f, 1.0f};
    EXPECT_NEAR(compare(a, image(1, {glm::vec3(0.25f)}), options).epsMean, 0.5, 1e-7);
}

TEST(Compare, PixelsThatAreNotFiniteLeaveNoMetric) {
    for (const float bad : {std::nanf(""), INFINITY, -INFINITY}) {
        const RadianceImage broken = image(2, {glm::vec3(0.5f), {0.5f, bad, 0.5f}});
        const RadianceImage fine = image(2, {glm::vec3(0.5f), glm::vec3(0.5f)});
        for (const Comparison& c :
             {compare(broken, fine, {}), compare(fine, broken, {}), compare(broken, broken, {})}) {
            EXPECT_EQ(c.nonFinite, 1u);
            for (const auto& [name, value] : c.metrics())
                EXPECT_TRUE(std::isnan(value)) << name;
        }
        CompareOptions masked;
        masked.mask = {true, false};
        EXPECT_EQ(compare(broken, fine, masked).nonFinite, 0u);
    }
}

TEST(HeatMap, GrowsFromBlackToWhite) {
    const RadianceImage map = heatMap({0.0f, 0.01f, 0.02f, 0.03f, 0.04f, 0.05f, 7.0f}, 7, 1, 0.05f);
    EXPECT_EQ(map.visible.front(), glm::vec3(0.0f));
    EXPECT_EQ(map.visible.back(), map.visible[5]);
    EXPECT_NEAR(map.visible.back().x, 1.0f, 1e-6f);
    const auto luminance = [](glm::vec3 c) { return 0.2126f * c.x + 0.7152f * c.y + 0.0722f * c.z; };
    for (std::size_t i = 1; i < 6; ++i)
        EXPECT_GT(luminance(map.visible[i]), luminance(map.visible[i - 1])) << i;
}

}  // namespace
}  // namespace duolux

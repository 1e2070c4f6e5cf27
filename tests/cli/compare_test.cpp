#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "host/base/srgb.h"
#include "host/film/image.h"
#include "tests/cli/run_duolux.h"

namespace duolux::test {
namespace {

using testing::HasSubstr;

/// Two PNG files of 3 x 2 pixels: grey code 100, but 102 in the first pixel of image.png; and masks.
class CompareCommand : public testing::Test {
  protected:
    CompareCommand() {
        write("reference.png", std::vector<std::uint8_t>(6, 100));
        write("image.png", {102, 100, 100, 100, 100, 100});
        write("first.png", {255, 0, 0, 0, 0, 0});
        write("others.png", {0, 255, 255, 255, 255, 255});
        write("none.png", std::vector<std::uint8_t>(6, 0));
        write("narrow.png", std::vector<std::uint8_t>(2, 100));
    }

    void write(const std::string& name, const std::vector<std::uint8_t>& codes) const {
        RadianceImage image{static_cast<std::uint32_t>(codes.size() / 2), 2, {}, {}};
        image.invisible.resize(codes.size());
        for (const std::uint8_t code : codes)
            image.visible.emplace_back(fromSrgb8(code));
        writeImage(folder_ / name, image, {});
    }

    ProgramResult compare(std::vector<std::string> arguments) const {
        arguments.insert(arguments.begin(), "compare");
        return runDuolux(folder_.path(), std::move(arguments));
    }

    nlohmann::json json(std::vector<std::string> arguments) const {
        arguments.emplace_back("--json");
        const ProgramResult result = compare(std::move(arguments));
        EXPECT_EQ(result.status, 0) << result.err;
        return nlohmann::json::parse(result.out);
    }

    TemporaryFolder folder_;
};

TEST_F(CompareCommand, PrintsForPeopleAndForScripts) {
    const ProgramResult text = compare({"image.png", "reference.png"});
    EXPECT_EQ(text.status, 0) << text.err;
    for (const char* word : {"eps, mean                 0.1307 %", "RMSE", "relative MSE", "PSNR", "FLIP"})
        EXPECT_THAT(text.out, HasSubstr(word));
    const nlohmann::json report = json({"image.png", "reference.png"});
    EXPECT_EQ(report["version"], 1);
    EXPECT_EQ(report["pixels"], 6);
    EXPECT_NEAR(report["eps_mean"].get<double>(), 2.0 / 255 / 6, 1e-7);
    EXPECT_NEAR(report["eps_max"].get<double>(), 2.0 / 255, 1e-7);
    EXPECT_NEAR(report["eps_above_1_255"].get<double>(), 1.0 / 6, 1e-7);
    EXPECT_GT(report["signed_mean"].get<double>(), 0.0);
    EXPECT_TRUE(json({"image.png", "image.png"})["psnr"].is_null());
}

TEST_F(CompareCommand, MasksChooseThePixels) {
    EXPECT_NEAR(json({"image.png", "reference.png", "--mask", "first.png"})["eps_mean"].get<double>(),
                2.0 / 255, 1e-7);
    EXPECT_EQ(json({"image.png", "reference.png", "--mask", "others.png"})["eps_max"], 0.0);
    const ProgramResult nothing = compare({"image.png", "reference.png", "--mask", "none.png"});
    EXPECT_EQ(nothing.status, 3);
    EXPECT_THAT(nothing.err, HasSubstr("none.png"));
}

TEST_F(CompareCommand, LimitsSetTheExitStatus) {
    EXPECT_EQ(compare({"image.png", "reference.png", "--fail-above", "eps_max=0.008"}).status, 0);
    const ProgramResult failed = compare(
        {"image.png", "reference.png", "--fail-above", "eps_mean=0.5", "--fail-above", "eps_max=0.0078"});
    EXPECT_EQ(failed.status, 1);
    EXPECT_THAT(failed.err, HasSubstr("image.png: eps_max is 0.0078"));
    EXPECT_THAT(failed.out, HasSubstr("PSNR")) << "the figures are printed all the same";
    // A signed metric is judged by its size.
    EXPECT_EQ(compare({"reference.png", "image.png", "--fail-above", "signed_mean=0"}).status, 1);
}

TEST_F(CompareCommand, TheHeatMapShowsWhereItDiffers) {
    ASSERT_EQ(
        compare({"image.png", "reference.png", "--heatmap", "map.png", "--heatmap-range", "0.007"}).status,
        0);
    const RadianceImage map = readImage(folder_ / "map.png");
    EXPECT_EQ(map.visible[0], glm::vec3(1.0f));
    for (std::size_t i = 1; i < 6; ++i)
        EXPECT_EQ(map.visible[i], glm::vec3(0.0f));
}

TEST_F(CompareCommand, PixelsThatAreNotFiniteFailEveryLimit) {
    RadianceImage image{3, 2, std::vector<glm::vec3>(6), std::vector<glm::vec3>(6, glm::vec3(0.1f))};
    image.visible[4].y = NAN;
    writeImage(folder_ / "nan.pfm", image, {});
    const ProgramResult result = compare({"nan.pfm", "reference.png", "--fail-above", "eps_max=1"});
    EXPECT_EQ(result.status, 1);
    EXPECT_THAT(result.out, HasSubstr("pixels not finite         1"));
}

TEST_F(CompareCommand, AnExrIsComparedAsDisplayed) {
    RadianceImage image{3, 2, std::vector<glm::vec3>(6, glm::vec3(0.5f)),
                        std::vector<glm::vec3>(6, glm::vec3(0.1f))};
    ImageOptions options;
    options.display = {1.0f, 0.0f};
    writeImage(folder_ / "a.exr", image, options);
    writeImage(folder_ / "a.pfm", image, options);
    EXPECT_EQ(json({"a.exr", "a.pfm"})["eps_max"], 0.0);
    EXPECT_EQ(json({"a.exr", "a.pfm", "--transfer", "linear", "--exposure", "1"})["eps_max"], 0.0);
}

TEST_F(CompareCommand, ImagesOfTwoSizesAreRefused) {
    const ProgramResult result = compare({"image.png", "narrow.png"});
    EXPECT_EQ(result.status, 3);
    EXPECT_THAT(result.err, HasSubstr("narrow.png: is 1 x 2 pixels; expected 3 x 2"));
}

}  // namespace
}  // namespace duolux::test

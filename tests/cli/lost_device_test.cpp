// If the device fails during a render, the samples so far are kept.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "host/film/image.h"
#include "tests/cli/run_duolux.h"

namespace duolux::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class LostDevice : public testing::Test {
  protected:
    /// Renders the Cornell box on a device with a fault, as specified for tests/support/fault_layer.
    ProgramResult render(const std::string& fault, std::vector<std::string> arguments) {
        const std::vector<std::string> common{
            "render", DUOLUX_ASSETS "/cornell/cornell.json", "--device", "cpu", "--size", "64x48", "--spp",
            "64"};
        arguments.insert(arguments.begin(), common.begin(), common.end());
        return runProgram(
            DUOLUX_EXECUTABLE, folder_.path(), arguments, std::nullopt, std::chrono::seconds(60),
            {"VK_LAYER_PATH=" DUOLUX_FAULT_LAYER, "VK_INSTANCE_LAYERS=VK_LAYER_DUOLUX_fault", fault});
    }

    TemporaryFolder folder_;
};

TEST_F(LostDevice, LeavesAPictureAndACheckpointToGoOnFrom) {
    for (const char* integrator : {"path", "light"}) {
        ASSERT_EQ(render("", {"--integrator", integrator, "-o", "whole.pfm"}).status, 0);
        // Fails after the first look at the image, which takes more submissions with the light tracer.
        const ProgramResult result =
            render(integrator == std::string("path") ? "DUOLUX_FAULT_LOST=5" : "DUOLUX_FAULT_LOST=7",
                   {"--integrator", integrator, "-o", "part.exr", "-o", "part.png", "--checkpoint", "a.part",
                    "--report", "a.json"});
        EXPECT_EQ(result.status, 1);
        EXPECT_THAT(result.err, AllOf(HasSubstr("failed on llvmpipe"), HasSubstr("ErrorDeviceLost"),
                                      HasSubstr("; wrote the result so far, "), HasSubstr(" of 196608 ")));
        EXPECT_EQ(readImage(folder_ / "part.exr").width, 64u);
        EXPECT_EQ(readImage(folder_ / "part.png").height, 48u);
        const nlohmann::json report = nlohmann::json::parse(contentsOf(folder_ / "a.json"));
        EXPECT_GT(report["samples"]["taken"], 0);
        EXPECT_EQ(report["samples"]["complete"], false);
        EXPECT_THAT(report["warnings"].dump(), HasSubstr("ErrorDeviceLost"));
        // The checkpoint counts only completed samples: the resumed render gives the same bits.
        ASSERT_EQ(render("", {"--integrator", integrator, "--resume", "a.part", "-o", "rest.pfm"}).status, 0);
        EXPECT_TRUE(contentsOf(folder_ / "rest.pfm") == contentsOf(folder_ / "whole.pfm")) << integrator;
    }
}

TEST_F(LostDevice, BeforeAnySampleWritesNothing) {
    const ProgramResult result = render("DUOLUX_FAULT_LOST=0", {"-o", "a.exr", "--checkpoint", "a.part"});
    EXPECT_EQ(result.status, 1);
    EXPECT_THAT(result.err, AllOf(HasSubstr("ErrorDeviceLost"), Not(HasSubstr("wrote"))));
    EXPECT_FALSE(std::filesystem::exists(folder_ / "a.exr"));
    EXPECT_FALSE(std::filesystem::exists(folder_ / "a.part"));
}

TEST_F(LostDevice, WithAResumedCheckpointWritesThat) {
    ASSERT_EQ(render("", {"--sample-range", "0:8", "-o", "a.pfm", "--checkpoint", "a.part"}).status, 0);
    const ProgramResult result = render("DUOLUX_FAULT_LOST=0", {"--resume", "a.part", "-o", "b.pfm"});
    EXPECT_EQ(result.status, 1);
    EXPECT_TRUE(contentsOf(folder_ / "a.pfm") == contentsOf(folder_ / "b.pfm"));
}

TEST_F(LostDevice, OutOfMemoryNamesWhatDidNotFit) {
    const ProgramResult result = render("DUOLUX_FAULT_MEMORY=1", {"-o", "a.exr"});
    EXPECT_EQ(result.status, 1);
    EXPECT_THAT(result.err, AllOf(HasSubstr("allocating "), HasSubstr(" bytes for triangles failed on "),
                                  HasSubstr("ErrorOutOfDeviceMemory")));
}

}  // namespace
}  // namespace duolux::test

// --aov on the command line: layers in EXR files and checkpoints.
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/cli/run_duolux.h"

namespace duolux::test {
namespace {

using testing::HasSubstr;

class Layers : public testing::Test {
  protected:
    ProgramResult render(std::vector<std::string> arguments, const char* spp = "20") {
        arguments.insert(arguments.begin(), {"render", DUOLUX_ASSETS "/cornell/cornell.json", "--quiet",
                                             "--device", "cpu", "--size", "48x32", "--spp", spp});
        return runDuolux(folder_.path(), arguments);
    }
    ProgramResult run(const std::vector<std::string>& arguments) {
        return runDuolux(folder_.path(), arguments);
    }
    std::string bytes(const std::string& name) { return contentsOf(folder_.path() / name); }
    void expectRefused(const ProgramResult& result, int status, const std::string& words) {
        EXPECT_EQ(result.status, status);
        EXPECT_THAT(result.err, HasSubstr(words));
        EXPECT_EQ(std::ranges::count(result.err, '\n'), 1) << result.err;
    }

    TemporaryFolder folder_;
};

TEST_F(Layers, NormalsAreInTheExr) {
    const ProgramResult result =
        render({"--aov", "normal", "--report", "-", "-o", "a.exr", "-o", "a.png", "-o", "a.pfm"});
    ASSERT_EQ(result.status, 0) << result.err;
    EXPECT_EQ(nlohmann::json::parse(result.out)["settings"]["layers"], nlohmann::json({"normal"}));

    Imf::InputFile file((folder_ / "a.exr").c_str());
    std::vector<float> normals(3 * 48 * 32);
    Imf::FrameBuffer frame;
    int channel = 0;
    for (const char* name : {"normal.X", "normal.Y", "normal.Z"}) {
        ASSERT_NE(file.header().channels().findChannel(name), nullptr);
        frame.insert(
            name, Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(normals.data() + channel++), 12, 12 * 48));
    }
    file.setFrameBuffer(frame);
    file.readPixels(0, 31);
    // The back wall faces the camera, which looks along +z; the ceiling is above it and the floor below.
    const auto normalAt = [&](int x, int y) {
        const float* n = &normals[3 * (48 * y + x)];
        return std::vector<float>(n, n + 3);
    };
    const auto isNear = [](float x, float y, float z) {
        return testing::Pointwise(testing::FloatNear(1e-3f), std::vector<float>{x, y, z});
    };
    EXPECT_THAT(normalAt(24, 12), isNear(0, 0, -1));
    EXPECT_THAT(normalAt(24, 1), isNear(0, -1, 0));
    EXPECT_THAT(normalAt(24, 30), isNear(0, 1, 0));
    EXPECT_THAT(normalAt(0, 16), isNear(0, 0, 0)) << "beside the box";

    // The other files do not change.
    ASSERT_EQ(render({"-o", "b.exr", "-o", "b.png", "-o", "b.pfm"}).status, 0);
    EXPECT_EQ(bytes("a.png"), bytes("b.png"));
    EXPECT_EQ(bytes("a.pfm"), bytes("b.pfm"));
    EXPECT_EQ(Imf::InputFile((folder_ / "b.exr").c_str()).header().channels().findChannel("normal.X"),
              nullptr);
    EXPECT_EQ(run({"compare", "a.exr", "b.exr", "--fail-above", "rmse=0"}).status, 0);
}

TEST_F(Layers, PartsOfARenderGiveTheSameFile) {
    ASSERT_EQ(render({"--aov", "normal", "-o", "whole.exr"}).status, 0);
    for (const char* range : {"0:3", "3:20"}) {
        ASSERT_EQ(render({"--aov", "normal", "--sample-range", range, "--checkpoint",
                          std::string(range).substr(0, 1), "-o", "part.png"})
                      .status,
                  0);
    }
    ASSERT_EQ(run({"merge", "-o", "sum.exr", "3", "0"}).status, 0);
    EXPECT_EQ(bytes("sum.exr"), bytes("whole.exr"));
    ASSERT_EQ(render({"--aov", "normal", "--resume", "0", "-o", "resumed.exr"}).status, 0);
    EXPECT_EQ(bytes("resumed.exr"), bytes("whole.exr"));

    // Checkpoints with other layers are refused.
    expectRefused(render({"--resume", "0", "-o", "none.exr"}), 3,
                  "0: layers: is normal, but none in this render");
    ASSERT_EQ(render({"--sample-range", "3:20", "--checkpoint", "plain", "-o", "part.png"}).status, 0);
    expectRefused(run({"merge", "-o", "none.exr", "0", "plain"}), 3,
                  "plain: layers: is none, but normal in 0");
    expectRefused(
        render({"--aov", "normal", "--sample-range", "3:20", "--resume", "plain", "-o", "none.exr"}), 3,
        "plain: layers: is none, but normal in this render");
    EXPECT_FALSE(std::filesystem::exists(folder_ / "none.exr"));
}

TEST_F(Layers, AreRefusedWhereTheyWouldBeLost) {
    // These renders would take hours.
    const char* many = "16777216";
    expectRefused(render({"--aov", "normals", "-o", "a.exr"}, many), 2,
                  R"(--aov normals: there is no layer "normals"; did you mean "normal"?)");
    expectRefused(render({"--aov", "normal,", "-o", "a.exr"}, many), 2,
                  R"(--aov normal,: there is no layer "")");
    expectRefused(render({"--aov", "normal", "-o", "a.png"}, many), 2,
                  "--aov normal: only EXR files and checkpoints hold layers; expected -o FILE.exr");
    expectRefused(render({"--aov", "normal", "--integrator", "light", "-o", "a.exr"}, many), 2,
                  "--aov normal: the light tracer traces no camera rays; expected --integrator path");
    EXPECT_EQ(render({"--aov", "normal,normal", "-o", "a.exr"}, "1").status, 0);
}

}  // namespace
}  // namespace duolux::test

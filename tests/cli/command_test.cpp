#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include "tests/cli/run_duolux.h"
#include "tests/support/address_space.h"

namespace duolux::test {
namespace {

using testing::ContainsRegex;
using testing::HasSubstr;
using testing::StartsWith;

class Command : public testing::Test {
  protected:
    ProgramResult run(std::vector<std::string> arguments) {
        return runDuolux(folder_.path(), std::move(arguments));
    }
    TemporaryFolder folder_;
};

TEST_F(Command, HelpNamesEveryCommand) {
    const ProgramResult result = run({"--help"});
    EXPECT_EQ(result.status, 0);
    for (const char* command : {"render", "compare", "devices", "info", "make-scene", "sheet"}) {
        EXPECT_THAT(result.out, HasSubstr(command));
        const ProgramResult help = run({command, "--help"});
        EXPECT_EQ(help.status, 0) << command;
        EXPECT_THAT(help.out, HasSubstr(command));
    }
}

TEST_F(Command, VersionIsOneLine) {
    const ProgramResult result = run({"--version"});
    EXPECT_EQ(result.status, 0);
    EXPECT_THAT(result.out, StartsWith("duolux "));
    EXPECT_EQ(result.out.find('\n'), result.out.size() - 1);
}

TEST_F(Command, StandardOutputThatCannotBeWrittenIsAnError) {
    const ProgramResult result =
        runProgram("/bin/sh", folder_.path(), {"-c", "exec \"$0\" devices > /dev/full", DUOLUX_EXECUTABLE});
    EXPECT_EQ(result.status, 1);
    EXPECT_EQ(result.err, "duolux: standard output: cannot write: No space left on device\n");
}

/// Wherever an allocation fails, also while memory is freed, there is one line and an exit status.
TEST_F(Command, TooLittleMemoryForASceneIsOneLine) {
    if (kAddressSanitizer) return;  // needs more than any limit
    std::ofstream scene(folder_.path() / "large.json");
    scene << R"({"duolux": 1, "objects": [[])";
    for (int i = 0; i < 600000; ++i)
        scene << ", [0, 1]";
    scene << "]}";
    scene.close();
    const ProgramResult enough = run({"info", "large.json"});
    ASSERT_EQ(enough.status, 3) << enough.err;  // it is no scene
    int failed = 0;
    for (int mebibytes = 50; mebibytes <= 140; mebibytes += 5) {
        const ProgramResult result = runProgram(
            "/bin/sh", folder_.path(),
            {"-c", "ulimit -v " + std::to_string(mebibytes * 1024) + "; exec \"$0\" info large.json",
             DUOLUX_EXECUTABLE});
        if (result.status == 3) continue;
        ++failed;
        EXPECT_EQ(result.status, 1) << mebibytes << " " << result.err;
        EXPECT_THAT(result.err, HasSubstr("out of memory")) << mebibytes;
        EXPECT_EQ(result.err.find('\n'), result.err.size() - 1) << mebibytes;
    }
    EXPECT_GT(failed, 3);
}

TEST_F(Command, DevicesShowsTheSoftwareDriverAndTheChoice) {
    const ProgramResult result = run({"devices"});
    EXPECT_EQ(result.status, 0) << result.err;
    EXPECT_THAT(result.out, HasSubstr("llvmpipe"));
    EXPECT_THAT(result.out, HasSubstr("subgroup size"));
    EXPECT_THAT(result.out, HasSubstr("ray queries"));
    EXPECT_THAT(result.out, HasSubstr("* "));
}

TEST_F(Command, InfoCountsWhatTheFileHoldsWithoutTheAddedLamp) {
    std::ofstream(folder_.path() / "q.obj") << "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nf 1 2 3 4\n";
    const ProgramResult result = run({"info", "q.obj"});
    EXPECT_EQ(result.status, 0) << result.err;
    EXPECT_THAT(result.out, ContainsRegex("triangles +2\n"));
    EXPECT_THAT(result.out, ContainsRegex("vertices +4\n"));
    EXPECT_THAT(result.out, ContainsRegex("bounds +-1, -1, 0  to  1, 1, 0\n"));
    EXPECT_THAT(result.out, ContainsRegex("mean albedo 0.8 by area\n"));
    EXPECT_THAT(result.out, HasSubstr("warning      nothing emits light")) << "but rendering adds one";
}

TEST_F(Command, InfoGivesCoordinatesAsInTheFile) {
    std::ofstream(folder_.path() / "utm.obj") << "v 512345.67 4612345.67 120.5\nv 512346.87 4612345.67 "
                                                 "120.5\nv 512346.87 4612346.57 120.5\nf 1 2 3\n";
    const ProgramResult result = run({"info", "utm.obj"});
    EXPECT_THAT(result.out, HasSubstr("512345.67, 4612345.67, 120.5  to  512346.87, 4612346.57, 120.5\n"));
    EXPECT_THAT(result.out, ContainsRegex("camera +..position.: .51234[0-9.]+, 461234[0-9.]+, 1[12]"));
}

TEST_F(Command, InfoShowsNamesOfMaterialsWithoutTheirControlCharacters) {
    std::ofstream(folder_.path() / "a.obj")
        << "usemtl \x1b[31mX" << std::string(1000, 'y') << "\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    const ProgramResult result = run({"info", "a.obj"});
    EXPECT_EQ(result.out.find('\x1b'), std::string::npos);
    EXPECT_THAT(result.out, HasSubstr("\n  \\x1b[31mXyyyyy"));
    EXPECT_LT(result.out.size(), 2000u);
}

TEST_F(Command, InfoTellsWhatWasLoaded) {
    const ProgramResult result = run({"info", DUOLUX_ASSETS "/cornell/cornell.json"});
    EXPECT_EQ(result.status, 0) << result.err;
    for (const char* text : {"triangles", "white", "tall", "lights", "bounds", "energy"}) {
        EXPECT_THAT(result.out, HasSubstr(text));
    }
}

TEST_F(Command, MakeSceneWritesASceneThatRenders) {
    const ProgramResult made = run({"make-scene", "two-spheres", "--triangles", "2000", "-o", "scene"});
    ASSERT_EQ(made.status, 0) << made.err;
    const ProgramResult rendered = run(
        {"render", "scene/two_spheres.json", "--size", "32x32", "--spp", "2", "--quiet", "-o", "out.png"});
    EXPECT_EQ(rendered.status, 0) << rendered.err;
    EXPECT_TRUE(std::filesystem::exists(folder_.path() / "out.png"));
}

}  // namespace
}  // namespace duolux::test

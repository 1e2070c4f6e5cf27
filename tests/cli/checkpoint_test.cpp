#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <fstream>

#include "tests/cli/run_duolux.h"

// Partial renders from the command line give files that are bitwise identical to those of a single render.

namespace duolux::test {
namespace {

using testing::HasSubstr;

class CheckpointCommands : public testing::TestWithParam<const char*> {
  protected:
    ProgramResult render(std::vector<std::string> arguments,
                         std::optional<ProgramSignal> signal = std::nullopt) {
        arguments.insert(arguments.begin(),
                         {"render", DUOLUX_ASSETS "/cornell/cornell.json", "--quiet", "--device", "cpu",
                          "--size", "48x32", "--integrator", GetParam()});
        return runDuolux(folder_.path(), arguments, signal);
    }
    ProgramResult run(const std::vector<std::string>& arguments) {
        return runDuolux(folder_.path(), arguments);
    }
    std::string bytes(const std::string& name) { return contentsOf(folder_.path() / name); }
    bool exists(const std::string& name) { return std::filesystem::exists(folder_.path() / name); }

    TemporaryFolder folder_;
};

TEST_P(CheckpointCommands, MergeOfPartsIsTheWhole) {
    ASSERT_EQ(render({"--spp", "20", "-o", "whole.exr"}).status, 0);
    for (const char* range : {"0:3", "3:4", "4:20"}) {
        const ProgramResult part = render({"--spp", "20", "--sample-range", range, "--checkpoint",
                                           std::string(range).substr(0, 1), "-o", "part.exr"});
        ASSERT_EQ(part.status, 0) << part.err;
        EXPECT_NE(bytes("part.exr"), bytes("whole.exr"));
    }
    const ProgramResult merged = run({"merge", "-o", "sum.exr", "4", "0", "3"});
    ASSERT_EQ(merged.status, 0) << merged.err;
    EXPECT_EQ(bytes("sum.exr"), bytes("whole.exr"));

    const ProgramResult overlap = run({"merge", "-o", "none.exr", "4", "4"});
    EXPECT_EQ(overlap.status, 3);
    EXPECT_THAT(overlap.err, HasSubstr("4: has samples 4 to 19, which 4 also has"));
    const ProgramResult image = run({"merge", "-o", "none.exr", "whole.exr"});
    EXPECT_EQ(image.status, 3);
    EXPECT_THAT(image.err, HasSubstr("whole.exr: is no checkpoint"));
    EXPECT_FALSE(exists("none.exr"));
}

TEST_P(CheckpointCommands, OtherFilesAreNotReplaced) {
    std::ofstream(folder_.path() / "mine.txt") << "notes";
    const ProgramResult result = render({"--spp", "1", "--checkpoint", "mine.txt", "-o", "a.png"});
    EXPECT_EQ(result.status, 2);
    EXPECT_THAT(result.err, HasSubstr("--checkpoint mine.txt: is another kind of file"));
    EXPECT_EQ(std::filesystem::file_size(folder_.path() / "mine.txt"), 5u);
    EXPECT_FALSE(exists("a.png"));
}

TEST_P(CheckpointCommands, AnInterruptedRenderGoesOnAsIfNothingHadHappened) {
    ProgramResult interruptedRender;
    // Doubles the delay until there are samples: on a busy machine, the first ones take seconds.
    for (auto delay = std::chrono::milliseconds(700); !exists("state") && delay < std::chrono::seconds(60);
         delay *= 2) {
        interruptedRender = render({"--spp", "100000", "--checkpoint", "state", "-o", "some.png"},
                                   ProgramSignal{SIGINT, delay});
        ASSERT_EQ(interruptedRender.status, 130) << interruptedRender.err;
    }
    ASSERT_TRUE(exists("state"));
    // A few more samples, with a checkpoint that replaces the resumed one.
    const std::size_t taken =
        std::stoul(interruptedRender.err.substr(interruptedRender.err.find("result so far, ") + 15));
    const std::string spp = std::to_string(taken / (48 * 32) + 40);
    const ProgramResult resumed =
        render({"--spp", spp, "--resume", "state", "--checkpoint", "state", "-o", "resumed.exr"});
    ASSERT_EQ(resumed.status, 0) << resumed.err;
    const ProgramResult again = render({"--spp", spp, "--resume", "state", "-o", "again.exr"});
    ASSERT_EQ(again.status, 0) << again.err;
    ASSERT_EQ(render({"--spp", spp, "-o", "whole.exr"}).status, 0);
    EXPECT_EQ(bytes("resumed.exr"), bytes("whole.exr"));
    EXPECT_EQ(bytes("again.exr"), bytes("whole.exr"));
}

TEST_P(CheckpointCommands, TheRangeOfACheckpointIsTrue) {
    // Fewer samples than the checkpoint holds: all are kept, with a warning.
    ASSERT_EQ(render({"--spp", "10", "--checkpoint", "ten", "-o", "ten.exr"}).status, 0);
    ASSERT_EQ(render({"--spp", "5", "--resume", "ten", "--checkpoint", "five", "-o", "five.exr"}).status, 0);
    EXPECT_EQ(bytes("five.exr"), bytes("ten.exr"));
    ASSERT_EQ(render({"--spp", "10", "--sample-range", "5:10", "--checkpoint", "half", "-o", "h.exr"}).status,
              0);
    EXPECT_THAT(run({"merge", "-o", "none.exr", "five", "half"}).err, HasSubstr("has samples 5 to 9"));
    // Without --spp, the render continues to the end of the checkpoint's range.
    ASSERT_EQ(render({"--spp", "10", "--sample-range", "5:7", "--checkpoint", "part", "-o", "a.exr"}).status,
              0);
    ASSERT_EQ(render({"--resume", "part", "-o", "b.exr"}).status, 0);
    EXPECT_EQ(bytes("a.exr"), bytes("b.exr"));
    ASSERT_EQ(render({"--spp", "10", "--resume", "part", "-o", "c.exr"}).status, 0);
    EXPECT_EQ(bytes("c.exr"), bytes("h.exr"));
    EXPECT_EQ(render({"--spp", "5", "--resume", "part", "-o", "c.exr"}).status, 2);
}

TEST_P(CheckpointCommands, WhatCannotBeKeptDoesNotCostThePicture) {
    const ProgramResult result = render({"--spp", "4", "--checkpoint", "/dev/full", "-o", "a.png"});
    EXPECT_EQ(result.status, 1);
    EXPECT_THAT(result.err, HasSubstr("/dev/full: cannot write: No space left on device"));
    EXPECT_TRUE(exists("a.png"));
}

TEST_P(CheckpointCommands, ACheckpointOfSomethingElseIsRefusedAndKept) {
    ASSERT_EQ(render({"--spp", "2", "--checkpoint", "state", "-o", "a.png"}).status, 0);
    const std::string before = bytes("state");
    const auto refused = [&](std::vector<std::string> changes, const char* word) {
        changes.insert(changes.end(),
                       {"--spp", "2", "--resume", "state", "--checkpoint", "state", "-o", "b.png"});
        const ProgramResult result = render(changes);
        EXPECT_EQ(result.status, 3) << word;
        EXPECT_THAT(result.err, HasSubstr(std::string("state: ") + word));
    };
    refused({"--seed", "9"}, "seed: is 1, but 9 in this render");
    refused({"--bounces", "3"}, "bounces: is 16, but 3 in this render");
    refused({"--preset", "local"}, "reflectance: is global, but local in this render");
    refused({"--sampler", "independent"}, "sampler: is sobol, but independent in this render");
    refused({"--sample-range", "1:2"}, "first sample: is 0, but 1 in this render");
    EXPECT_EQ(bytes("state"), before);
    EXPECT_FALSE(exists("b.png"));
}

INSTANTIATE_TEST_SUITE_P(All, CheckpointCommands, testing::Values("path", "light"),
                         [](const auto& test) { return std::string(test.param); });

}  // namespace
}  // namespace duolux::test

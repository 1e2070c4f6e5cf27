// Standard streams that are closed, full or without a reader, and signals: the image is still written, and
// the exit status is correct.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <chrono>
#include <csignal>
#include <fstream>

#include "host/film/image.h"
#include "tests/cli/run_duolux.h"

namespace duolux::test {
namespace {

using testing::HasSubstr;
using namespace std::chrono_literals;

class Streams : public testing::Test {
  protected:
    void SetUp() override {
        // There is no emitter, which causes a warning.
        std::ofstream(folder_ / "q.obj") << "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n";
    }

    /// Runs a command of bash, in which $D is the program and $R a short render.
    ProgramResult shell(const std::string& command) const {
        return runProgram(
            "/bin/bash", folder_.path(), {"-c", command}, std::nullopt, 60s,
            {"D=" DUOLUX_EXECUTABLE,
             "R=" DUOLUX_EXECUTABLE " render q.obj --device cpu --size 16x16 --spp 1 -o a.png"});
    }
    bool isPicture(const std::string& name) const { return readImage(folder_ / name).width > 0; }

    TemporaryFolder folder_;
};

TEST_F(Streams, MessagesThatNobodyCanReadCostNothing) {
    for (const char* streams : {"2>&-", "2>/dev/full", "0>&- 1>&- 2>&-", "2> >(exit)"}) {
        SCOPED_TRACE(streams);
        const ProgramResult result = shell(std::string("trap '' PIPE; $R ") + streams);
        EXPECT_EQ(result.status, 0);
        EXPECT_TRUE(isPicture("a.png"));
        std::filesystem::remove(folder_ / "a.png");
    }
    EXPECT_EQ(shell("$D info none.obj 2>&-").status, 3);
    EXPECT_EQ(shell("$D render q.obj --spp none 2>/dev/full").status, 2);
}

TEST_F(Streams, ResultsThatNobodyCanReadAreAnError) {
    const std::string nobody = "exec 3> >(exit); wait $!; ";  // the reader of file 3 has left
    for (const char* streams : {">&-", ">/dev/full", ">&3"}) {
        SCOPED_TRACE(streams);
        const ProgramResult result = shell(nobody + "$R --report - " + streams);
        EXPECT_EQ(result.status, 1);
        EXPECT_THAT(result.err, HasSubstr("duolux: standard output: cannot write: "));
        EXPECT_TRUE(isPicture("a.png"));
    }
    const ProgramResult help = shell(nobody + "$D render --help >&3; echo $?");
    EXPECT_EQ(help.out, "0\n");
    EXPECT_EQ(help.err, "");
    EXPECT_EQ(shell("$D render --help >/dev/full").status, 1);
    const ProgramResult left = shell(nobody + "$D info q.obj >&3; echo $?");
    EXPECT_EQ(left.out, "1\n");
    EXPECT_EQ(left.err, "duolux: standard output: cannot write: Broken pipe\n");
}

class Signals : public Streams {
  protected:
    ProgramResult render(const std::string& scene, std::vector<std::string> arguments, int signal,
                         std::chrono::milliseconds after) {
        arguments.insert(arguments.begin(),
                         {"render", scene, "--device", "cpu", "--quiet", "--size", "32x32"});
        return runDuolux(folder_.path(), std::move(arguments), ProgramSignal{signal, after});
    }
};

TEST_F(Signals, ActWhileASceneIsLoaded) {
    std::ofstream mesh(folder_ / "long.obj");
    mesh << "v 0 0 0\nv 1 0 0\nv 1 1 0\n";
    for (int i = 0; i < 4'000'000; ++i)
        mesh << "f 1 2 3\n";
    mesh.close();
    for (const auto& [signal, status] : {std::pair(SIGINT, 130), {SIGHUP, 130}, {SIGTERM, 143}}) {
        const ProgramResult result = render("long.obj", {"-o", "a.png"}, signal, 200ms);
        EXPECT_EQ(result.status, status);
        EXPECT_EQ(result.err, status == 130 ? "duolux: interrupted\n" : "duolux: terminated\n");
    }
}

TEST_F(Signals, KeepTheWorkOfARender) {
    for (const auto& [signal, status] : {std::pair(SIGHUP, 130), {SIGTERM, 143}, {SIGXCPU, 143}}) {
        SCOPED_TRACE(signal);
        const ProgramResult result =
            render("q.obj", {"--spp", "10000000", "-o", "a.png", "--checkpoint", "a.part"}, signal, 2500ms);
        EXPECT_EQ(result.status, status);
        EXPECT_THAT(result.err, HasSubstr(status == 130 ? "interrupted: wrote" : "terminated: wrote"));
        EXPECT_TRUE(isPicture("a.png"));
        EXPECT_TRUE(std::filesystem::remove(folder_ / "a.part"));
        std::filesystem::remove(folder_ / "a.png");
    }
}

/// Like timeout(1), which signals the process and then its group.
TEST_F(Signals, TwiceAtOnceIsOnce) {
    const ProgramResult result = shell(
        "$R --spp 10000000 --time-limit 60 & sleep 4; kill -TERM $!; kill -TERM $!; sleep 0.01; kill -TERM "
        "$!; wait $!");
    EXPECT_EQ(result.status, 143) << result.err;
    EXPECT_THAT(result.err, HasSubstr("terminated: wrote"));
}

TEST_F(Signals, AHangUpThatWasIgnoredIsIgnored) {
    const ProgramResult result =
        shell("trap '' HUP; $R --time-limit 2 --spp 10000000 & sleep 1; kill -HUP $!; wait $!");
    EXPECT_EQ(result.status, 0) << result.err;
    EXPECT_THAT(result.err, HasSubstr("time limit"));
}

/// With one sample, the signal comes while the pipe waits for its reader. With many, it comes during the
/// render, and nothing interrupts open() or write() afterwards.
TEST_F(Signals, APipeWithoutAReaderIsNotAwaitedAfterAStop) {
    ASSERT_EQ(::mkfifo((folder_ / "f.png").c_str(), 0600), 0);
    for (const auto& [spp, message] : {std::pair("1", ""), {"10000000", "terminated: wrote"}}) {
        SCOPED_TRACE(spp);
        const ProgramResult result =
            render("q.obj", {"--spp", spp, "-o", "f.png", "-o", "a.exr"}, SIGTERM, 2500ms);
        EXPECT_EQ(result.status, 143);
        EXPECT_THAT(result.err, HasSubstr("f.png: cannot write: Interrupted"));
        EXPECT_THAT(result.err, HasSubstr(message));
        EXPECT_TRUE(isPicture("a.exr"));
        EXPECT_TRUE(std::filesystem::remove(folder_ / "a.exr"));
        EXPECT_TRUE(std::filesystem::is_fifo(folder_ / "f.png"));
    }
}

TEST_F(Signals, AReaderThatReadsNothingIsNotAwaitedAfterAStop) {
    ASSERT_EQ(::mkfifo((folder_ / "f.exr").c_str(), 0600), 0);
    const ProgramResult result = shell(
        "sleep 60 <>f.exr & S=$!; $R --spp 10000000 --size 256x256 -o f.exr & sleep 3; kill -TERM $!; "
        "wait $!; STATUS=$?; kill $S; exit $STATUS");
    EXPECT_EQ(result.status, 143);
    EXPECT_THAT(result.err, HasSubstr("f.exr: cannot write: Interrupted"));
    EXPECT_TRUE(isPicture("a.png"));
}

TEST_F(Signals, AReaderGetsThePictureAfterAStop) {
    ASSERT_EQ(::mkfifo((folder_ / "f.exr").c_str(), 0600), 0);
    const ProgramResult result = shell(
        "(sleep 0.3; exec cat) <f.exr >got.exr & C=$!; $R --spp 10000000 --size 256x256 -o f.exr & sleep 3; "
        "kill -TERM $!; wait $!; STATUS=$?; wait $C; exit $STATUS");
    EXPECT_EQ(result.status, 143);
    EXPECT_THAT(result.err, HasSubstr("terminated: wrote"));
    EXPECT_TRUE(isPicture("got.exr"));
    EXPECT_TRUE(isPicture("a.png"));
}

TEST_F(Streams, PipesAreWrittenAfterFiles) {
    ASSERT_EQ(::mkfifo((folder_ / "f.png").c_str(), 0600), 0);
    const ProgramResult result = shell(
        "$D render q.obj --device cpu --size 16x16 --spp 1 -o f.png -o b.png & "
        "for i in $(seq 300); do [ -e b.png ] && break; sleep 0.1; done; cat f.png >got.png; wait $!");
    EXPECT_EQ(result.status, 0) << result.err;
    EXPECT_TRUE(isPicture("b.png"));
    EXPECT_TRUE(isPicture("got.png"));
}

TEST_F(Signals, TheSecondEndsTheProgramAtOnce) {
    ASSERT_EQ(::mkfifo((folder_ / "f.exr").c_str(), 0600), 0);
    // A slow reader.
    const ProgramResult result = shell(
        "(while [ $(dd bs=4k count=1 status=none | wc -c) -gt 0 ]; do sleep 0.1; done) <f.exr & "
        "$R -o f.exr --size 512x512 --spp 10000000 & sleep 3; kill -TERM $!; sleep 2; kill -INT $!; "
        "wait $!");
    EXPECT_EQ(result.status, 130);
    EXPECT_THAT(result.err, HasSubstr("duolux: interrupted\n"));
    EXPECT_TRUE(isPicture("a.png"));
}

}  // namespace
}  // namespace duolux::test

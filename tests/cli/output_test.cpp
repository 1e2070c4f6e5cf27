// The files that commands write: foreseeable problems are reported before the work, and a file that cannot be
// written afterwards does not affect the others.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "host/film/image.h"
#include "tests/cli/run_duolux.h"

namespace duolux::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class Outputs : public testing::Test {
  protected:
    void SetUp() override {
        write("q.obj", "mtllib q.mtl\nusemtl m\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
        write("q.mtl", "newmtl m\nKd 1 1 1\nKe 1 1 1\n");
        write("s.json", R"({"duolux": 1, "objects": [{"mesh": "q.obj"}]})");
    }
    void write(const std::string& name, const std::string& text) const {
        std::ofstream(folder_ / name, std::ios::binary) << text;
    }
    std::string bytes(const std::string& name) const { return contentsOf(folder_ / name); }
    ProgramResult run(std::vector<std::string> arguments) const {
        return runDuolux(folder_.path(), std::move(arguments));
    }
    /// A render that would take hours, unless the arguments say otherwise.
    ProgramResult render(std::vector<std::string> arguments, const std::string& spp = "16777216") const {
        arguments.insert(arguments.begin(),
                         {"render", "--device", "cpu", "--quiet", "--size", "64x64", "--spp", spp});
        return run(std::move(arguments));
    }
    void expectRefused(std::vector<std::string> arguments, const std::string& words) const {
        const ProgramResult result = render(std::move(arguments));
        EXPECT_EQ(result.status, 2);
        EXPECT_THAT(result.err, HasSubstr(words));
    }
    /// The only file whose name starts with `begin`.
    fs::path fileNamed(const std::string& begin) const {
        for (const auto& entry : fs::directory_iterator(folder_.path())) {
            if (entry.path().filename().string().starts_with(begin)) return entry.path();
        }
        return {};
    }

    TemporaryFolder folder_;
};

TEST_F(Outputs, AnImageInPlaceOfTheSceneIsNamed) {
    const ProgramResult alone = run({"render", "a.png"});
    EXPECT_EQ(alone.status, 3);
    EXPECT_THAT(alone.err, HasSubstr("a.png: has no extension of a scene file"));
    const ProgramResult withOutput = run({"render", "a.png", "-o", "b.png"});
    EXPECT_EQ(withOutput.status, 2);
    EXPECT_THAT(withOutput.err, HasSubstr("render: a.png is an image; expected a SCENE"));
}

TEST_F(Outputs, MayNotTakeThePlaceOfAnythingThatIsRead) {
    fs::create_symlink("q.mtl", folder_ / "link.part");
    fs::create_hard_link(folder_ / "q.obj", folder_ / "hard.png");
    fs::create_directory(folder_ / "sub");
    const std::vector<std::vector<std::string>> cases{
        {"--report", "s.json"},        {"--report", "q.obj"},
        {"--checkpoint", "q.mtl"},     {"--report", "./q.obj"},
        {"--report", "sub/../q.mtl"},  {"--report", (folder_ / "q.obj").string()},
        {"--checkpoint", "link.part"}, {"-o", "hard.png"}};
    for (std::vector<std::string> options : cases) {
        SCOPED_TRACE(options[1]);
        options.insert(options.begin(), "s.json");
        expectRefused(options, options[1] + " " + options[2] + ": is read by this command");
    }
    expectRefused({"q.obj", "--report", "q.mtl"}, "--report q.mtl: is read by this command");
    const ProgramResult bench = run({"bench", "s.json", "--device", "cpu", "--only", "-", "--json", "q.mtl"});
    EXPECT_EQ(bench.status, 2);
    EXPECT_THAT(bench.err, HasSubstr("--json q.mtl: is read by this command"));
    EXPECT_THAT(bytes("q.obj"), HasSubstr("mtllib"));
    EXPECT_THAT(bytes("q.mtl"), HasSubstr("newmtl"));
}

TEST_F(Outputs, MayNotTakeThePlaceOfOneAnother) {
    fs::create_symlink("a.png", folder_ / "link.png");  // to a file that does not exist yet
    expectRefused({"q.obj", "-o", "a.png", "-o", "link.png"}, "-o link.png: is also written by -o");
    expectRefused({"q.obj", "-o", "a.png", "--report", "./a.png"}, "--report ./a.png: is also written by -o");
}

TEST_F(Outputs, ThatCannotBeWrittenAreToldBeforeTheWork) {
    write("protected.png", "old");
    ASSERT_EQ(::chmod((folder_ / "protected.png").c_str(), 0444), 0);
    expectRefused({"q.obj", "-o", "protected.png"},
                  "protected.png: cannot write: the file is write-protected");
    EXPECT_EQ(bytes("protected.png"), "old");
    expectRefused({"q.obj", "-o", std::string(252, 'x') + ".png"}, "File name too long");
    expectRefused({"q.obj", "-o", "/proc/a.png"}, "-o /proc/a.png: cannot write: ");
    fs::create_symlink("missing/a.png", folder_ / "link.png");
    expectRefused({"q.obj", "-o", "link.png"},
                  "link.png (a link to missing/a.png): cannot write: No such file");
}

TEST_F(Outputs, OneThatFailsIsWrittenElsewhereAndCostsNoOther) {
    const ProgramResult result =
        render({"q.obj", "--checkpoint", "/dev/full", "--report", "/dev/full", "-o", "a.png"}, "1");
    EXPECT_EQ(result.status, 2) << "two outputs to one file";
    const ProgramResult full = render({"q.obj", "--report", "/dev/full", "-o", "a.png"}, "1");
    EXPECT_EQ(full.status, 1);
    EXPECT_THAT(full.err,
                HasSubstr("duolux: /dev/full: cannot write: No space left on device; it is in ./full-"));
    EXPECT_EQ(nlohmann::json::parse(contentsOf(fileNamed("full-rescued-")))["version"], 1);
    EXPECT_EQ(readImage(folder_ / "a.png").width, 64u);
}

TEST_F(Outputs, AFolderThatVanishesDoesNotCostThePicture) {
    const ProgramResult result = runProgram(
        "/bin/bash", folder_.path(),
        {"-c", "mkdir d; " DUOLUX_EXECUTABLE
               " render q.obj --device cpu --size 64x64 --spp 16777216 --time-limit 2 -o d/a.png -o d/b.exr"
               " -o c.pfm & sleep 1; rm -r d; wait $!"});
    EXPECT_EQ(result.status, 1);
    for (const char* name : {"a", "b"}) {
        SCOPED_TRACE(name);
        EXPECT_THAT(result.err, HasSubstr(std::string("d/") + name));
        EXPECT_THAT(result.err, HasSubstr(std::string("it is in ./") + name + "-rescued-"));
        EXPECT_EQ(readImage(fileNamed(std::string(name) + "-rescued-")).width, 64u);
    }
    EXPECT_EQ(readImage(folder_ / "c.pfm").width, 64u);
}

TEST_F(Outputs, SeveralImagesFollowOneOption) {
    for (const std::vector<std::string>& words : {std::vector<std::string>{"q.obj", "-o", "a.png", "a.exr"},
                                                  {"-o", "a.png", "a.exr", "q.obj"},
                                                  {"-o", "a.png", "q.obj", "a.exr"}}) {
        const ProgramResult result = render(words, "1");
        EXPECT_EQ(result.status, 0) << result.err;
        EXPECT_TRUE(fs::remove(folder_ / "a.png"));
        EXPECT_TRUE(fs::remove(folder_ / "a.exr"));
    }
    expectRefused({"q.obj", "a.png"}, "a.png");
    expectRefused({"q.obj", "s.json", "-o", "a.png"}, "s.json");
    expectRefused({"-o", "a.png", "a.exr"}, "SCENE");
}

TEST_F(Outputs, TwoDashesEndTheOptions) {
    for (const std::vector<std::string>& words :
         {std::vector<std::string>{"-o", "a.png", "--", "q.obj"}, {"-o", "a.png", "--", "q.obj", "a.exr"}}) {
        const ProgramResult result = render(words, "1");
        EXPECT_EQ(result.status, 0) << result.err;
        EXPECT_TRUE(fs::remove(folder_ / "a.png"));
    }
    EXPECT_TRUE(fs::exists(folder_ / "a.exr"));
    fs::copy_file(folder_ / "q.obj", folder_ / "-q.obj");
    EXPECT_EQ(run({"info", "--", "-q.obj"}).status, 0);
    EXPECT_EQ(render({"-o", "a.png", "--", "-q.obj"}, "1").status, 0);
    expectRefused({"--", "q.obj", "--spp"}, "--spp");
    expectRefused({"-o", "a.png", "--"}, "SCENE");
}

TEST_F(Outputs, OfARepeatedOptionTheLastCounts) {
    const ProgramResult result =
        render({"q.obj", "--spp",   "3",  "--seed", "1",  "--size",   "8x8",         "--size",
                "16x16", "--seed",  "2",  "--spp",  "2",  "--report", "none/r.json", "--report",
                "-",     "--quiet", "-o", "a.png",  "-o", "b.png"},
               "many");
    ASSERT_EQ(result.status, 2) << "each value is checked";
    const ProgramResult good = render({"q.obj", "--spp", "2", "--size", "16x16", "--report", "none/r.json",
                                       "--report", "-", "--quiet", "-o", "a.png", "-o", "b.png"});
    ASSERT_EQ(good.status, 0) << good.err;
    const nlohmann::json report = nlohmann::json::parse(good.out);
    EXPECT_EQ(report["settings"]["spp"], 2);
    EXPECT_EQ(report["settings"]["width"], 16);
    EXPECT_TRUE(fs::exists(folder_ / "a.png") && fs::exists(folder_ / "b.png"));
    const ProgramResult compared =
        run({"compare", "a.png", "b.png", "--exposure", "1", "--exposure", "2", "--fail-above", "rmse=1",
             "--fail-above", "rmse=0", "--json", "--json"});
    EXPECT_EQ(compared.status, 0) << compared.err;
}

}  // namespace
}  // namespace duolux::test

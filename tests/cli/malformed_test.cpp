// Invalid input to the real executable: exit status, one line on standard error that names the problem, and
// no files left behind.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <set>
#include <vector>

#include "tests/cli/malformed_cases.h"
#include "tests/cli/run_duolux.h"

namespace duolux::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class Malformed : public testing::Test {
  protected:
    void write(const std::string& name, const std::string& text) const {
        std::ofstream(folder_ / name, std::ios::binary) << text;
    }

    std::set<std::string> filesInFolder() const {
        std::set<std::string> names;
        for (const auto& entry : fs::directory_iterator(folder_))
            names.insert(entry.path().filename().string());
        return names;
    }

    ProgramResult run(const std::vector<std::string>& arguments) const {
        return runDuolux(folder_, arguments);
    }

    void expectFailure(const std::vector<std::string>& arguments, int status,
                       const std::vector<std::string>& words) {
        const std::set<std::string> before = filesInFolder();
        const ProgramResult result = run(arguments);
        EXPECT_EQ(result.status, status) << result.err;
        EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
        EXPECT_THAT(result.err, testing::StartsWith("duolux: "));
        EXPECT_THAT(result.err, testing::EndsWith("\n"));
        for (const std::string& word : words)
            EXPECT_THAT(result.err, HasSubstr(word));
        EXPECT_EQ(filesInFolder(), before) << "something was left behind";
    }

    TemporaryFolder temporary_;
    fs::path folder_ = temporary_.path();
};

class MalformedSceneTest : public Malformed, public testing::WithParamInterface<MalformedScene> {};

TEST_P(MalformedSceneTest, IsRefused) {
    const MalformedScene& scene = GetParam();
    for (const auto& [name, content] : scene.files) {
        if (name != "none.obj") write(name, content);
    }
    constexpr int kBadInput = 3;
    const std::string& file = scene.files.front().first;
    std::vector<std::string> info{"info", file};
    std::vector<std::string> render{"render", file, "--size",  "8x8", "--spp",
                                    "1",      "-o", "out.png", "-o",  "out.exr"};
    if (scene.onlyIfStrict) {
        const ProgramResult lenient = run(info);
        EXPECT_EQ(lenient.status, 0) << lenient.err;
        EXPECT_THAT(lenient.out, HasSubstr("warning"));
        info.emplace_back("--strict");
        render.emplace_back("--strict");
    }
    expectFailure(info, kBadInput, scene.words);
    expectFailure(render, kBadInput, scene.words);
}

class WrongUsageTest : public Malformed, public testing::WithParamInterface<WrongUsage> {};

TEST_P(WrongUsageTest, IsRefused) {
    write("good.mtl", "newmtl lamp\nKd 0.5 0.5 0.5\nKe 1 1 1\n");
    write("good.obj", "mtllib good.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl lamp\nf 1 2 3\n");
    constexpr int kUsage = 2;
    expectFailure(GetParam().arguments, kUsage, GetParam().words);
}

class GoodSceneTest : public Malformed {};

TEST_F(GoodSceneTest, TheSceneOfTheWrongUsagesIsRight) {
    write("good.mtl", "newmtl lamp\nKd 0.5 0.5 0.5\nKe 1 1 1\n");
    write("good.obj", "mtllib good.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl lamp\nf 1 2 3\n");
    const ProgramResult result = run({"info", "good.obj"});
    EXPECT_EQ(result.status, 0);
    EXPECT_EQ(result.err, "");
    EXPECT_THAT(result.out, HasSubstr("1 emitting triangle"));
}

constexpr auto kNameOf = [](const auto& info) { return std::string(info.param.name); };
INSTANTIATE_TEST_SUITE_P(Obj, MalformedSceneTest, testing::ValuesIn(malformedObjs()), kNameOf);
INSTANTIATE_TEST_SUITE_P(Mtl, MalformedSceneTest, testing::ValuesIn(malformedMtls()), kNameOf);
INSTANTIATE_TEST_SUITE_P(Gltf, MalformedSceneTest, testing::ValuesIn(malformedGltfs()), kNameOf);
INSTANTIATE_TEST_SUITE_P(Json, MalformedSceneTest, testing::ValuesIn(malformedJsons()), kNameOf);
INSTANTIATE_TEST_SUITE_P(Options, WrongUsageTest, testing::ValuesIn(wrongUsages()), kNameOf);

}  // namespace
}  // namespace duolux::test

// Wrong input against the real executable: exit status, one line on standard error that names what is wrong,
// and no file left behind.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <stdexcept>
#include <vector>

#include "tests/cli/malformed_cases.h"

namespace duolux::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

struct Result {
    int status = -1;  ///< exit status, or -1 if it did not exit by itself
    std::string errors;
};

std::string contentOf(const fs::path& path) {
    std::ostringstream text;
    text << std::ifstream(path).rdbuf();
    return text.str();
}

class Malformed : public testing::Test {
  protected:
    Malformed() {
        std::string name = (fs::temp_directory_path() / "duolux-malformed-XXXXXX").string();
        if (::mkdtemp(name.data()) == nullptr) throw std::runtime_error("mkdtemp");
        root_ = name;
        folder_ = root_ / "work";
        fs::create_directory(folder_);
    }
    ~Malformed() override { fs::remove_all(root_); }

    void write(const std::string& name, const std::string& text) const {
        std::ofstream(folder_ / name, std::ios::binary) << text;
    }

    std::set<std::string> filesInFolder() const {
        std::set<std::string> names;
        for (const auto& entry : fs::directory_iterator(folder_))
            names.insert(entry.path().filename().string());
        return names;
    }

    /// Runs the program in the folder.
    Result run(const std::vector<std::string>& arguments) const {
        const fs::path errors = root_ / "stderr", output = root_ / "stdout";
        const pid_t child = ::fork();
        if (child == 0) {
            std::vector<char*> argv{const_cast<char*>(DUOLUX_EXECUTABLE)};
            for (const std::string& argument : arguments)
                argv.push_back(const_cast<char*>(argument.c_str()));
            argv.push_back(nullptr);
            const bool ready = std::freopen(errors.c_str(), "w", stderr) != nullptr &&
                               std::freopen(output.c_str(), "w", stdout) != nullptr &&
                               ::chdir(folder_.c_str()) == 0;
            constexpr unsigned kPatience = 60;  // seconds
            ::alarm(kPatience);
            if (ready) ::execv(argv[0], argv.data());
            ::_exit(127);
        }
        int status = 0;
        if (child < 0 || ::waitpid(child, &status, 0) != child)
            throw std::runtime_error("cannot run the program");
        return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, contentOf(errors)};
    }

    void expectFailure(const std::vector<std::string>& arguments, int status,
                       const std::vector<std::string>& words) {
        const std::set<std::string> before = filesInFolder();
        const Result result = run(arguments);
        EXPECT_EQ(result.status, status) << result.errors;
        EXPECT_EQ(std::count(result.errors.begin(), result.errors.end(), '\n'), 1) << result.errors;
        EXPECT_THAT(result.errors, testing::StartsWith("duolux: "));
        EXPECT_THAT(result.errors, testing::EndsWith("\n"));
        for (const std::string& word : words)
            EXPECT_THAT(result.errors, HasSubstr(word));
        EXPECT_EQ(filesInFolder(), before) << "something was left behind";
    }

    fs::path root_, folder_;
};

class MalformedSceneTest : public Malformed, public testing::WithParamInterface<MalformedScene> {};

TEST_P(MalformedSceneTest, IsRefused) {
    const MalformedScene& scene = GetParam();
    for (const auto& [name, content] : scene.files) {
        if (name != "none.obj") write(name, content);
    }
    constexpr int kBadInput = 3;
    const std::string& file = scene.files.front().first;
    expectFailure({"info", file}, kBadInput, scene.words);
    expectFailure({"render", file, "--size", "8x8", "--spp", "1", "-o", "out.png", "-o", "out.exr"},
                  kBadInput, scene.words);
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
    const Result result = run({"info", "good.obj"});
    EXPECT_EQ(result.status, 0);
    EXPECT_EQ(result.errors, "");
    EXPECT_THAT(contentOf(root_ / "stdout"), HasSubstr("1 emitting triangle"));
}

constexpr auto kNameOf = [](const auto& info) { return std::string(info.param.name); };
INSTANTIATE_TEST_SUITE_P(Obj, MalformedSceneTest, testing::ValuesIn(malformedObjs()), kNameOf);
INSTANTIATE_TEST_SUITE_P(Mtl, MalformedSceneTest, testing::ValuesIn(malformedMtls()), kNameOf);
INSTANTIATE_TEST_SUITE_P(Json, MalformedSceneTest, testing::ValuesIn(malformedJsons()), kNameOf);
INSTANTIATE_TEST_SUITE_P(Options, WrongUsageTest, testing::ValuesIn(wrongUsages()), kNameOf);

}  // namespace
}  // namespace duolux::test

// The program's messages if no Vulkan driver can be loaded, and the number of threads that it starts.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/cli/run_duolux.h"

namespace duolux::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

/// Runs `duolux devices` with a Vulkan loader that looks for drivers only in this manifest.
ProgramResult devicesWith(const TemporaryFolder& folder, const std::string& manifest) {
    return runProgram(DUOLUX_EXECUTABLE, folder.path(), {"devices"}, std::nullopt, std::chrono::seconds(60),
                      {"VK_DRIVER_FILES=" + manifest, "VK_ICD_FILENAMES=" + manifest});
}

void writeText(const std::filesystem::path& file, const std::string& text) {
    std::ofstream(file) << text;
}

TEST(NoDriver, NamesTheManifestOrTheLibraryThatIsMissing) {
    const TemporaryFolder folder;
    writeText(folder / "broken.json", "{");
    writeText(folder / "library.json",
              R"({"file_format_version": "1.0.0",
                  "ICD": {"library_path": "/no/such/library.so", "api_version": "1.2.0"}})");
    for (const auto& [manifest, culprit] :
         std::vector<std::pair<std::string, std::string>>{{"missing.json", "missing.json"},
                                                          {"broken.json", "broken.json"},
                                                          {"library.json", "/no/such/library.so: cannot"}}) {
        const ProgramResult result = devicesWith(folder, manifest);
        EXPECT_EQ(result.status, 1) << manifest;
        EXPECT_THAT(result.err,
                    AllOf(HasSubstr("duolux: no Vulkan driver can be loaded ("), HasSubstr(culprit),
                          HasSubstr("; VK_DRIVER_FILES is set to '" + manifest + "'")));
        EXPECT_EQ(std::ranges::count(result.err, '\n'), 1) << result.err;
    }
}

TEST(NoDriver, SaysWhatToInstallWhereThereIsNone) {
    const TemporaryFolder folder;
    const ProgramResult result = devicesWith(folder, "/dev/null");
    EXPECT_EQ(result.status, 1);
    EXPECT_THAT(result.err, HasSubstr("duolux: no Vulkan driver found; install one (Debian: "
                                      "mesa-vulkan-drivers, "));
}

// AddressSanitizer reserves more address space than this limit allows.
#ifndef __SANITIZE_ADDRESS__
TEST(NoDriver, TooLittleAddressSpaceIsCalledSo) {
    const TemporaryFolder folder;
    const ProgramResult result =
        runProgram("/bin/sh", folder.path(), {"-c", "ulimit -v 120000 && " DUOLUX_EXECUTABLE " devices"});
    EXPECT_EQ(result.status, 1);
    EXPECT_THAT(result.err, AllOf(HasSubstr("; this process may use only 117 MiB of address space"),
                                  HasSubstr("'ulimit -v'"), Not(HasSubstr("install"))));
    EXPECT_EQ(std::ranges::count(result.err, '\n'), 1) << result.err;
}

/// Lavapipe compiles kernels in this process, and crashes if an allocation fails there.
TEST(TooLittleAddressSpace, IsOneLineWhereverItEnds) {
    const TemporaryFolder folder;
    writeText(folder / "m.mtl", "newmtl m\nKd 0.5 0.5 0.5\nPr 0.3\nPm 0.5\nPc 0.5\n");
    writeText(folder / "m.obj", "mtllib m.mtl\nusemtl m\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    const auto render = [&](int mebibytes, const std::string& scene, const std::string& options) {
        return runProgram(
            "/bin/sh", folder.path(),
            {"-c", "ulimit -v " + std::to_string(mebibytes * 1024) + "; exec " DUOLUX_EXECUTABLE " render " +
                       scene + " --device cpu --quiet --size 16x16 --spp 1 -o a.pfm " + options});
    };
    int failed = 0;
    for (const auto& [scene, options] : {std::pair(DUOLUX_ASSETS "/cornell/cornell.json", ""),
                                         std::pair("m.obj", "--integrator light --lamp")}) {
        for (int mebibytes = 300; mebibytes <= 1000; mebibytes += 20) {
            const ProgramResult result = render(mebibytes, scene, options);
            if (result.status == 0) break;
            ++failed;
            EXPECT_EQ(result.status, 1) << mebibytes << " " << result.err;
            const std::string last = result.err.substr(result.err.find("duolux: "));
            EXPECT_THAT(last, HasSubstr("'ulimit -v'")) << mebibytes;
            EXPECT_LE(std::ranges::count(last, '\n'), 2) << last;  // one may be a warning
        }
        EXPECT_EQ(render(2000, scene, options).status, 0);
    }
    EXPECT_GT(failed, 10);
}
#endif

TEST(Threads, AnyNumberGivesTheSameBits) {
    const TemporaryFolder folder;
    std::string picture;
    for (const char* threads : {"0", "1", "2", "5"}) {
        const ProgramResult result =
            runDuolux(folder.path(), {"render", DUOLUX_ASSETS "/cornell/cornell.json", "--device", "cpu",
                                      "--size", "16x16", "--spp", "2", "--threads", threads, "-o", "a.pfm"});
        ASSERT_EQ(result.status, 0) << result.err;
        if (picture.empty()) picture = contentsOf(folder / "a.pfm");
        EXPECT_TRUE(contentsOf(folder / "a.pfm") == picture) << threads;
    }
}

TEST(Threads, AreAsManyAsAskedFor) {
    const TemporaryFolder folder;
    const ProgramResult result =
        runDuolux(folder.path(), {"bench", "two-spheres-1000", "--only", "/build", "--repeat", "1",
                                  "--device", "cpu", "--quiet", "--threads", "3", "--json", "-"});
    ASSERT_EQ(result.status, 0) << result.err;
    EXPECT_THAT(nlohmann::json::parse(result.out).dump(), HasSubstr("3 x "));
}

TEST(Threads, RefusesWhatIsNoNumber) {
    const TemporaryFolder folder;
    for (const char* threads : {"-1", "two", "1025"}) {
        const ProgramResult result = runDuolux(folder.path(), {"info", "a.obj", "--threads", threads});
        EXPECT_EQ(result.status, 2);
        EXPECT_THAT(result.err, HasSubstr("--threads: expected a whole number from 0 to 1024"));
    }
}

}  // namespace
}  // namespace duolux::test

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <fstream>
#include <nlohmann/json.hpp>

#include "host/film/image.h"
#include "tests/cli/run_duolux.h"

namespace duolux::test {
namespace {

using testing::HasSubstr;
using testing::Not;

class RenderCommand : public testing::Test {
  protected:
    /// `duolux render` of a scene with further arguments.
    ProgramResult render(std::vector<std::string> arguments,
                         const std::string& scene = DUOLUX_ASSETS "/cornell/cornell.json",
                         std::optional<ProgramSignal> signal = std::nullopt) {
        arguments.insert(arguments.begin(), {"render", scene});
        const bool choosesDevice = std::ranges::find(arguments, "--device") != arguments.end();
        if (!choosesDevice) arguments.insert(arguments.end(), {"--device", "cpu"});
        return runDuolux(folder_.path(), arguments, signal);
    }
    RadianceImage image(const std::string& name) { return readImage(folder_.path() / name); }

    /// Number of files in the folder.
    std::size_t files() const {
        const std::filesystem::directory_iterator begin(folder_.path());
        return static_cast<std::size_t>(std::distance(begin, std::filesystem::directory_iterator()));
    }

    TemporaryFolder folder_;
};

TEST_F(RenderCommand, WritesSeveralFilesOfOneRender) {
    const ProgramResult result =
        render({"--size", "24x16", "--spp", "4", "-o", "a.exr", "-o", "a.pfm", "-o", "a.png"});
    ASSERT_EQ(result.status, 0) << result.err;
    EXPECT_EQ(files(), 3u);
    const RadianceImage exr = image("a.exr");
    const RadianceImage pfm = image("a.pfm");
    EXPECT_EQ(exr.width, 24u);
    EXPECT_EQ(exr.height, 16u);
    EXPECT_EQ(exr.visible, pfm.visible);  // the displayed row is the visible one
    EXPECT_EQ(image("a.png").width, 24u);
}

TEST_F(RenderCommand, SameSettingsGiveTheSameFile) {
    for (const char* name : {"a.pfm", "b.pfm"}) {
        ASSERT_EQ(render({"--size", "32x32", "--spp", "5", "-o", name}).status, 0);
    }
    ASSERT_EQ(render({"--size", "32x32", "--spp", "5", "--seed", "2", "-o", "c.pfm"}).status, 0);
    EXPECT_EQ(contentsOf(folder_.path() / "a.pfm"), contentsOf(folder_.path() / "b.pfm"));
    EXPECT_NE(contentsOf(folder_.path() / "a.pfm"), contentsOf(folder_.path() / "c.pfm"));
}

TEST_F(RenderCommand, PresetsAreCornersOfBlend) {
    const std::vector<std::pair<std::string, std::string>> corners{
        {"local", "1,0"}, {"global", "0,1"}, {"shadowless", "1,1"}, {"one-bounce", "0,0"}};
    std::vector<std::string> pictures;
    for (const auto& [preset, blend] : corners) {
        ASSERT_EQ(
            render({"--size", "16x16", "--spp", "2", "--bounces", "3", "--preset", preset, "-o", "a.pfm"})
                .status,
            0);
        ASSERT_EQ(render({"--size", "16x16", "--spp", "2", "--bounces", "3", "--blend", blend, "-o", "b.pfm"})
                      .status,
                  0);
        EXPECT_EQ(contentsOf(folder_.path() / "a.pfm"), contentsOf(folder_.path() / "b.pfm")) << preset;
        for (const std::string& other : pictures)
            EXPECT_NE(contentsOf(folder_.path() / "a.pfm"), other) << preset;
        pictures.push_back(contentsOf(folder_.path() / "a.pfm"));
    }
}

TEST_F(RenderCommand, ReportHasWhatTheContractAsksFor) {
    const ProgramResult result =
        render({"--size", "32x24", "--spp", "3", "--seed", "7", "--quiet", "-o", "a.png", "--report", "-"});
    ASSERT_EQ(result.status, 0) << result.err;
    EXPECT_EQ(result.err, "");
    const nlohmann::json report = nlohmann::json::parse(result.out);
    EXPECT_EQ(report["version"], 1);
    EXPECT_THAT(report["scene"]["file"].get<std::string>(), HasSubstr("cornell.json"));
    EXPECT_GT(report["scene"]["triangles"], 30);
    EXPECT_EQ(report["settings"]["width"], 32);
    EXPECT_EQ(report["settings"]["height"], 24);
    EXPECT_EQ(report["settings"]["spp"], 3);
    EXPECT_EQ(report["settings"]["seed"], 7);
    EXPECT_EQ(report["settings"]["integrator"], "path");
    EXPECT_EQ(report["settings"]["reflectance"], "global");
    EXPECT_THAT(report["device"]["name"].get<std::string>(), Not(HasSubstr("\n")));
    EXPECT_THAT(report["device"]["driver"].get<std::string>(), HasSubstr("Mesa"));
    for (const char* stage : {"load", "build", "pipeline", "render", "write"}) {
        EXPECT_GE(report["seconds"][stage].get<double>(), 0.0) << stage;
    }
    EXPECT_GT(report["device_seconds"]["path"], 0.0);
    EXPECT_EQ(report["samples"]["taken"], 32 * 24 * 3);
    EXPECT_EQ(report["rays"]["camera"], 32 * 24 * 3);
    EXPECT_GT(report["rays"]["shadow"], 0);
    EXPECT_GT(report["Mrays_per_second"], 0.0);
    EXPECT_GT(report["Msamples_per_second"], 0.0);
    EXPECT_GT(report["peak_bytes"]["host"], 1 << 20);
    EXPECT_GT(report["peak_bytes"]["device"], 0);
    EXPECT_FALSE(report["program"]["commit"].get<std::string>().empty());
}

TEST_F(RenderCommand, LayoutAndKernelAreThoseAskedFor) {
    const auto tuning = [&](std::vector<std::string> options) {
        options.insert(options.end(),
                       {"--size", "8x8", "--spp", "1", "--quiet", "-o", "a.pfm", "--report", "-"});
        const ProgramResult result = render(options);
        EXPECT_EQ(result.status, 0) << result.err;
        return nlohmann::json::parse(result.out)["tuning"];
    };
    const nlohmann::json chosen = tuning({});
    EXPECT_EQ(chosen["layout"], "texel");
    EXPECT_EQ(chosen["kernel"], "refilling");
    EXPECT_GT(chosen["lane_paths"], 1);
    const nlohmann::json other = tuning({"--layout", "storage", "--kernel", "plain"});
    EXPECT_EQ(other["layout"], "storage");
    EXPECT_EQ(other["kernel"], "plain");
}

TEST_F(RenderCommand, RayQueriesAreForDevicesThatHaveThem) {
    const std::vector<std::string> byRayQuery{"--layout", "ray-query", "--size", "8x8",  "--spp",
                                              "1",        "--quiet",   "-o",     "a.pfm"};
    const bool there =
        runDuolux(folder_.path(), {"devices"}).out.find("ray queries            yes") != std::string::npos;
    ProgramResult result = render(byRayQuery);
    EXPECT_EQ(result.status, there ? 0 : 2);
    if (!there) {
        EXPECT_THAT(result.err, HasSubstr("duolux: layout ray-query: llvmpipe"));
        EXPECT_THAT(result.err, HasSubstr("has no ray queries; expected texel or storage"));
        EXPECT_FALSE(std::filesystem::exists(folder_ / "a.pfm"));
        return;
    }
    std::vector<std::string> refilling = byRayQuery;
    refilling.insert(refilling.end(), {"--kernel", "refilling"});
    result = render(refilling);
    EXPECT_EQ(result.status, 2);
    EXPECT_THAT(result.err, HasSubstr("expected kernel plain"));
}

TEST_F(RenderCommand, ReportOfLightPaths) {
    const ProgramResult result = render({"--integrator", "light", "--size", "32x24", "--spp", "3", "--quiet",
                                         "-o", "a.exr", "--report", "-"});
    ASSERT_EQ(result.status, 0) << result.err;
    const nlohmann::json report = nlohmann::json::parse(result.out);
    EXPECT_EQ(report["settings"]["integrator"], "light");
    EXPECT_GT(report["device_seconds"]["light"], 0.0);
    EXPECT_EQ(report["samples"]["taken"], 32 * 24 * 3);
    EXPECT_EQ(report["rays"]["light"], 32 * 24 * 3);
    EXPECT_EQ(report["rays"]["camera"], 0);
    EXPECT_GT(report["rays"]["shadow"], 0);
    EXPECT_GT(report["radiance"]["mean"], 0.0);
    const std::string metadata = contentsOf(folder_.path() / "a.exr").substr(0, 2000);
    EXPECT_THAT(metadata, HasSubstr("integrator"));
}

// Light paths cannot connect a mirror to the camera, so its reflections are missing, which needs a warning.
TEST_F(RenderCommand, SaysThatLightPathsDoNotShowMirrors) {
    const auto sceneWith = [&](const char* roughness) {
        const std::filesystem::path scene = folder_.path() / "scene.json";
        std::ofstream(scene)
            << R"({"duolux": 1, "objects": [{"mesh": ")" DUOLUX_ASSETS
               R"(/cornell/cornell.obj"}], "materials": {"white": {"metallic": 1, "roughness": )"
            << roughness << "}}}";
        return scene.string();
    };
    const std::string warning = "material \"white\": light paths do not show what a smooth surface reflects";
    const std::vector<std::string> small{"--size", "4x4", "--spp", "1", "-o", "a.png"};
    std::vector<std::string> byLight = small;
    byLight.insert(byLight.end(), {"--integrator", "light"});
    EXPECT_THAT(render(byLight, sceneWith("0.02")).err, HasSubstr(warning));
    EXPECT_THAT(render(byLight, sceneWith("0.05")).err, Not(HasSubstr(warning)));
    EXPECT_THAT(render(small, sceneWith("0.02")).err, Not(HasSubstr(warning)));
}

TEST_F(RenderCommand, SaysThatFewLightPathsStartAtADimLamp) {
    const auto warningWith = [&](const char* other) {
        std::ofstream(folder_.path() / "s.json")
            << R"({"duolux": 1, "objects": [{"mesh": ")" DUOLUX_ASSETS R"(/cornell/cornell.obj"}], "lights": [
                {"type": "rectangle", "origin": [9000, 0, 0], "edge1": [100, 0, 0], "edge2": [0, 100, 0],
                 "emission": {"invisible": )"
            << other << "}}]}";
        return render({"--size", "16x16", "--spp", "4", "-o", "a.png", "--integrator", "light"},
                      (folder_.path() / "s.json").string())
            .err;
    };
    EXPECT_THAT(warningWith("1e8"), HasSubstr("material \"light\" emits "));
    EXPECT_THAT(warningWith("1e8"), HasSubstr("of 1024 light paths about "));
    EXPECT_THAT(warningWith("1"), Not(HasSubstr("light paths about")));
}

TEST_F(RenderCommand, LocalSendsNoShadowRays) {
    const ProgramResult result =
        render({"--preset", "local", "--size", "16x16", "--spp", "2", "--report", "-", "-o", "a.png"});
    ASSERT_EQ(result.status, 0);
    const nlohmann::json report = nlohmann::json::parse(result.out);
    EXPECT_EQ(report["rays"]["shadow"], 0);
    EXPECT_EQ(report["settings"]["effective_bounces"], 1);
}

TEST_F(RenderCommand, SaysSoWhenTheBounceLimitCutsAGrowingSeries) {
    const auto settings =
        std::vector<std::string>{"--size", "32x32", "--spp", "16", "--quiet", "-o", "a.png"};
    auto growing = settings;
    growing.insert(growing.end(), {"--preset", "shadowless", "--bounces", "4"});
    EXPECT_THAT(render(growing).err, HasSubstr("the limit of 4 bounces cuts light off"));
    auto converged = settings;
    converged.insert(converged.end(), {"--preset", "global", "--bounces", "16"});
    EXPECT_EQ(render(converged).err, "");
    auto single = settings;
    single.insert(single.end(), {"--preset", "one-bounce", "--bounces", "4"});
    EXPECT_EQ(render(single).err, "");
    // There is no light beyond the first bounce.
    for (const char* preset : {"one-bounce", "local"}) {
        auto first = settings;
        first.insert(first.end(), {"--preset", preset, "--bounces", "1"});
        EXPECT_EQ(render(first).err, "") << preset;
    }
}

TEST_F(RenderCommand, SeesGrowthWhereOnlyEveryOtherBounceReachesTheCamera) {
    // The camera looks down at a floor, with six quads and a lamp above it. All light comes from above, so a
    // path receives direct light only at vertices reached from above: the first, third, fifth, and so on.
    std::ofstream obj(folder_ / "stack.obj");
    obj << "mtllib stack.mtl\n";
    for (const double y : {-1.0, 0.0, 0.05, 0.1, 0.15, 0.2, 0.25, 3.0}) {
        for (const auto& [x, z] : {std::pair(-3, -3), {-3, 3}, {3, 3}, {3, -3}})
            obj << "v " << x << " " << y << " " << z << "\n";
        obj << (y == 3.0 ? "usemtl lamp\nf -1 -2 -3 -4\n" : "usemtl grey\nf -4 -3 -2 -1\n");
    }
    obj.close();
    std::ofstream(folder_ / "stack.mtl") << "newmtl grey\nKd 0.9 0.9 0.9\nnewmtl lamp\nKd 0 0 0\nKe 5 5 5\n";
    std::ofstream(folder_ / "stack.json")
        << R"({"duolux": 1, "camera": {"position": [0, -0.5, 0], "target": [0, -1, 0], "up": [0, 0, -1], "vfov": 30},)"
           R"( "objects": [{"mesh": "stack.obj"}]})";
    for (const char* bounces : {"7", "8"}) {
        const ProgramResult result = runDuolux(
            folder_.path(), {"render", "stack.json", "--preset", "shadowless", "--bounces", bounces, "--size",
                             "16x16", "--spp", "64", "--quiet", "-o", "stack.png", "--report", "stack.rep"});
        EXPECT_THAT(result.err, HasSubstr("cuts light off")) << bounces << contentsOf(folder_ / "stack.rep");
    }
}

TEST_F(RenderCommand, SaysWhatMakesASinglePathTooLong) {
    std::ofstream mesh(folder_.path() / "stack.obj");
    mesh << "mtllib stack.mtl\nusemtl e\n";
    for (int i = 0; i < 8000; ++i) {
        for (const char* corner : {"-1 -1", "1 -1", "1 1", "-1 1"})
            mesh << "v " << corner << " " << -0.001 * i << "\n";
        mesh << "f -4 -3 -2 -1\n";
    }
    mesh.close();
    std::ofstream(folder_.path() / "stack.mtl") << "newmtl e\nKd 0.5 0.5 0.5\nKe 1 1 1\n";
    for (const char* integrator : {"path", "light"}) {
        const ProgramResult result =
            render({"--preset", "local", "--bounces", "2", "--size", "8x8", "--spp", "1", "--integrator",
                    integrator, "--camera-position", "0,0,3", "--look-at", "0,0,0"},
                   "stack.obj");
        if (result.status == 0) continue;  // a driver without the limit
        EXPECT_EQ(result.status, 1);
        EXPECT_THAT(result.err, HasSubstr("the driver ended the loops of a single path, which are too long; "
                                          "expected fewer bounces than 2, fewer surfaces that overlap"));
    }
}

TEST_F(RenderCommand, TimeLimitStopsCleanly) {
    const ProgramResult result = render({"--size", "128x128", "--spp", "1000000", "--time-limit", "1",
                                         "--quiet", "-o", "a.pfm", "--report", "r.json"});
    ASSERT_EQ(result.status, 0) << result.err;
    EXPECT_THAT(result.err, HasSubstr("stopped at the time limit"));
    const nlohmann::json report = nlohmann::json::parse(contentsOf(folder_.path() / "r.json"));
    EXPECT_THAT(report["warnings"].dump(), HasSubstr("stopped at the time limit"));
    EXPECT_FALSE(report["samples"]["complete"]);
    EXPECT_GE(report["samples"]["taken"], 128 * 128);  // every pixel has at least one
    // Pixels may have different numbers of samples, but neither half of the image is black.
    const RadianceImage picture = image("a.pfm");
    double lower = 0.0;
    double upper = 0.0;
    for (std::size_t i = 0; i < picture.visible.size(); ++i) {
        (i < picture.visible.size() / 2 ? upper : lower) += static_cast<double>(picture.visible[i].x);
    }
    EXPECT_GT(upper, 0.0);
    EXPECT_GT(lower, 0.0);
}

TEST_F(RenderCommand, InterruptWritesWhatThereIsAndExits130) {
    const ProgramResult result =
        render({"--size", "64x64", "--spp", "10000000", "--quiet", "-o", "a.pfm"},
               DUOLUX_ASSETS "/cornell/cornell.json", ProgramSignal{SIGINT, std::chrono::milliseconds(3000)});
    EXPECT_EQ(result.status, 130);
    EXPECT_THAT(result.err, HasSubstr("interrupted: wrote the result so far"));
    EXPECT_EQ(files(), 1u);
    EXPECT_EQ(image("a.pfm").width, 64u);
}

TEST_F(RenderCommand, AMissingFolderIsSaidBeforeTheRender) {
    const ProgramResult result = render({"--size", "16x16", "--spp", "1", "-o", "missing/a.png"});
    EXPECT_EQ(result.status, 2);
    EXPECT_THAT(result.err, HasSubstr("the folder missing does not exist"));
    EXPECT_EQ(files(), 0u);
}

TEST_F(RenderCommand, UnknownDeviceIsNamedWithThoseThereAre) {
    const ProgramResult result = render({"--device", "voodoo", "-o", "a.png"});
    EXPECT_EQ(result.status, 2);
    EXPECT_THAT(result.err, HasSubstr("voodoo"));
    EXPECT_THAT(result.err, HasSubstr("llvmpipe"));
    EXPECT_EQ(files(), 0u);
}

TEST_F(RenderCommand, DevicesAreChosenByKindIndexAndName) {
    for (const char* selector : {"cpu", "0", "LLVM"}) {
        EXPECT_EQ(render({"--size", "8x8", "--spp", "1", "--device", selector, "-o", "a.png"}).status, 0)
            << selector;
    }
}

}  // namespace
}  // namespace duolux::test

// duolux-gl, and the experiment that compares with it (duolux-paper), from the command line.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "host/film/image.h"
#include "host/tools/compare/compare.h"
#include "tests/cli/run_duolux.h"

namespace duolux::test {
namespace {

using testing::HasSubstr;

class OpenGl : public testing::Test {
  protected:
    OpenGl() {
        EXPECT_EQ(runDuolux(folder_.path(), {"make-scene", "two-spheres", "--triangles", "20000", "-o", "."})
                      .status,
                  0);
    }

    ProgramResult draw(const std::string& output, std::vector<std::string> options) const {
        options.insert(options.begin(), {"two_spheres.json", "-o", output, "--size", "128x128"});
        return runProgram(DUOLUX_GL_EXECUTABLE, folder_.path(), std::move(options));
    }

    RadianceImage drawn(std::vector<std::string> options) const {
        const ProgramResult result = draw("gl.exr", std::move(options));
        EXPECT_EQ(result.status, 0) << result.err;
        return readImage(folder_ / "gl.exr");
    }

    RadianceImage local(const std::string& spp) const {
        const ProgramResult result =
            runDuolux(folder_.path(), {"render", "two_spheres.json", "--preset", "local", "--device", "cpu",
                                       "--size", "128x128", "--spp", spp, "-o", "local.exr"});
        EXPECT_EQ(result.status, 0) << result.err;
        return readImage(folder_ / "local.exr");
    }

    TemporaryFolder folder_;
};

// With the few vertices of this scene, five lights agree within 0.5 %. With lighting per fragment and many
// lights, only silhouettes differ, where the 64 passes and the 64 samples have different positions.
TEST_F(OpenGl, LocalReproducesIt) {
    const RadianceImage transport = local("64");
    EXPECT_LT(compare(drawn({"--lights", "5"}), transport, {}).epsMean, 0.005);
    const Comparison five = compare(drawn({"--lights", "5", "--lighting", "per-fragment"}), transport, {});
    const Comparison many =
        compare(drawn({"--lights", "16x16", "--lighting", "per-fragment"}), transport, {});
    EXPECT_LT(five.epsMean, 0.0015);
    EXPECT_LT(many.epsMean, 0.0005);
    EXPECT_LT(many.averageColour, 0.0002);
    EXPECT_LT(many.epsMean, five.epsMean);
}

// OpenGL has eight lights, so 8x8 lights are drawn in batches.
TEST_F(OpenGl, BatchesOfLightsAddUp) {
    const RadianceImage fixed = drawn({"--lights", "8x8", "--passes", "4"});
    const RadianceImage fragment = drawn({"--lights", "8x8", "--passes", "4", "--lighting", "per-fragment"});
    const Comparison c = compare(fixed, fragment, {});
    EXPECT_LT(c.epsMean, 0.005);
    EXPECT_LT(c.averageColour, 0.002);
}

// Emission is added once, not with each batch; only one of two coincident surfaces is drawn.
TEST_F(OpenGl, BatchesAddNothingTwice) {
    std::string text = contentsOf(folder_ / "two_spheres.json");
    const std::string dark = "\"visible\": [0, 0, 0]";
    text.replace(text.find(dark), dark.size(), "\"visible\": [0.25, 0.25, 0.25]");
    std::ofstream(folder_ / "two_spheres.json") << text;
    const RadianceImage one = drawn({"--lights", "2x4", "--passes", "1"});
    const RadianceImage two = drawn({"--lights", "4x4", "--passes", "1"});
    EXPECT_NEAR(two.visible[18 * 128 + 64].y, 0.25f, 1e-3f) << "the luminaire";

    std::string obj = contentsOf(folder_ / "two_spheres.obj");
    const std::size_t floor = obj.find("o floor");
    const std::string again = obj.substr(floor, obj.find("o ceiling") - floor);
    std::string faces;
    std::istringstream lines(again);
    for (std::string line; std::getline(lines, line);) {
        if (line.starts_with("f ") || line.starts_with("usemtl")) faces += line + "\n";
    }
    std::ofstream(folder_ / "two_spheres.obj", std::ios::app) << faces;
    const Comparison c = compare(drawn({"--lights", "4x4", "--passes", "1"}), two, {});
    EXPECT_LT(c.epsMax, 1e-5);
    EXPECT_GT(compare(one, two, {}).epsMax, 0.0);
}

TEST_F(OpenGl, ReportsWhatItRanOn) {
    ASSERT_EQ(draw("gl.png", {"--lights", "3x3", "--passes", "2", "--report", "r.json"}).status, 0);
    const nlohmann::json report = nlohmann::json::parse(contentsOf(folder_ / "r.json"));
    EXPECT_EQ(report["settings"]["lights"], 9);
    const int atOnce = report["opengl"]["lights_at_once"];
    EXPECT_GE(atOnce, 8);
    EXPECT_EQ(report["opengl"]["scene_drawings"], atOnce < 9 ? 4 : 2);
    EXPECT_GT(report["seconds"]["draw"], 0.0);
    EXPECT_NE(report["opengl"]["version"], "");
}

TEST_F(OpenGl, WireframeShowsEdges) {
    const RadianceImage edges =
        drawn({"--lighting", "wireframe", "--passes", "4", "--window", "0.3,0.6,0.05,0.05"});
    std::size_t dark = 0;
    std::size_t bright = 0;
    for (const glm::vec3& p : edges.visible) {
        dark += p.x == 0.0f ? 1 : 0;
        bright += p.x > 0.5f ? 1 : 0;
    }
    EXPECT_GT(dark, 128 * 128 / 4);
    EXPECT_GT(bright, 300);
}

TEST_F(OpenGl, BadArgumentsAreRefused) {
    for (const std::vector<std::string>& options :
         std::vector<std::vector<std::string>>{{"--lights", "7"},
                                               {"--passes", "0"},
                                               {"--lighting", "phong"},
                                               {"--window", "0,0,2,1"},
                                               {"--window", "0,0,0,1"},
                                               {"--window", "0.5,0,0.6,1"},
                                               {"--report", "two_spheres.json"}}) {
        const ProgramResult result = draw("gl.png", options);
        EXPECT_EQ(result.status, 2) << options[0];
        EXPECT_THAT(result.err, HasSubstr(options[0]));
        EXPECT_FALSE(std::filesystem::exists(folder_ / "gl.png"));
    }
    EXPECT_EQ(runProgram(DUOLUX_GL_EXECUTABLE, folder_.path(), {"missing.obj", "-o", "gl.png"}).status, 3);
}

TEST_F(OpenGl, WhatItDoesNotDrawIsRefused) {
    const auto refusal = [&](const std::string& more) {
        std::ofstream(folder_ / "scene.json")
            << R"({"duolux": 1, "objects": [{"mesh": "mesh.ply"}], )" << more << "}";
        const ProgramResult result =
            runProgram(DUOLUX_GL_EXECUTABLE, folder_.path(), {"scene.json", "-o", "gl.png"});
        EXPECT_EQ(result.status, 3) << result.err;
        EXPECT_FALSE(std::filesystem::exists(folder_ / "gl.png"));
        return result.err;
    };
    const auto writeMesh = [&](const std::string& properties, const std::string& values) {
        std::ofstream file(folder_ / "mesh.ply");
        file << "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float "
                "z\n"
             << properties << "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
        for (const char* place : {"0 0 0", "1 0 0", "0 1 0"})
            file << place << values << "\n";
        file << "3 0 1 2\n";
    };
    writeMesh("", "");
    EXPECT_THAT(refusal(R"("display": [1, 1])"), HasSubstr("display: is not what OpenGL draws"));
    EXPECT_THAT(
        refusal(R"("lights": [{"type": "point", "position": [0, 0, 1], "emission": {"visible": 1}}])"),
        HasSubstr("lights: contains point lights"));
    EXPECT_THAT(refusal(R"("materials": {"default": {"metallic": 1}})"), HasSubstr("is not diffuse, or has images"));
    writeMesh("property uchar red\nproperty uchar green\nproperty uchar blue\n", " 255 0 0");
    EXPECT_THAT(refusal(R"("lights": [])"), HasSubstr("has colours of vertices"));
}

TEST_F(OpenGl, TheExperimentWritesItsReport) {
    const ProgramResult result =
        runProgram(DUOLUX_PAPER_EXECUTABLE, folder_.path(),
                   {"-o", "paper", "--quick", "--size", "96", "--triangles", "5000", "--duolux",
                    DUOLUX_EXECUTABLE, "--duolux-gl", DUOLUX_GL_EXECUTABLE});
    ASSERT_EQ(result.status, 0) << result.err;
    EXPECT_THAT(result.out, HasSubstr("paper/index.html"));
    const std::string page = contentsOf(folder_ / "paper/index.html");
    std::size_t pictures = 0;
    for (std::size_t at = page.find("src=\""); at != std::string::npos;
         at = page.find("src=\"", at + 1), ++pictures) {
        const std::string name = page.substr(at + 5, page.find('"', at + 5) - at - 5);
        EXPECT_TRUE(std::filesystem::exists(folder_ / ("paper/" + name))) << name;
    }
    EXPECT_EQ(pictures, 6u);
    const nlohmann::json results = nlohmann::json::parse(contentsOf(folder_ / "paper/results.json"));
    EXPECT_EQ(results["cells"].size(), 2u * 2u * 4u);
    EXPECT_EQ(results["races"].size(), 2u);
    for (const char* words : {"largest eps", "do not add up", "OpenGL / closed form"})
        EXPECT_THAT(contentsOf(folder_ / "paper/tables.md"), HasSubstr(words));
    for (const auto& cell : results["cells"]) {
        if (cell["estimator"] != "closed-form" || cell["lighting"] != "per-fragment") continue;
        EXPECT_LT(cell["smooth"]["eps_mean"].get<double>(), cell["silhouettes"]["eps_mean"].get<double>());
    }
}

}  // namespace
}  // namespace duolux::test

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/cli/run_duolux.h"

namespace duolux::test {
namespace {

using testing::HasSubstr;
using testing::Not;

constexpr const char* kMtl =
    "newmtl white\nKd .8 .8 .8\nnewmtl lamp\nKd .8 .8 .8\nKe 20 20 20\nnewmtl dim\nKe 1e-4 1e-4 1e-4\n";
/// A floor of 4 x 4 that faces up.
constexpr const char* kFloor = "usemtl white\nv -2 0 -2\nv -2 0 2\nv 2 0 2\nv 2 0 -2\nf -4 -3 -2 -1\n";
/// A square above it that faces down, or up.
constexpr const char* kDown = "v -.5 1 -.5\nv .5 1 -.5\nv .5 1 .5\nv -.5 1 .5\nf -4 -3 -2 -1\n";
constexpr const char* kUp = "v -.5 1 -.5\nv .5 1 -.5\nv .5 1 .5\nv -.5 1 .5\nf -1 -2 -3 -4\n";

/// A box that faces inwards.
std::string box(const std::string& x, const std::string& low, const std::string& high) {
    std::string text = "usemtl white\n";
    for (const std::string& y : {low, high}) {
        for (const char* corner : {"-# Y -#", "# Y -#", "# Y #", "-# Y #"}) {
            text += "v ";
            for (const char* c = corner; *c != '\0'; ++c)
                text += *c == '#' ? x : (*c == 'Y' ? y : std::string(1, *c));
            text += "\n";
        }
    }
    return text +
           "f -8 -5 -6 -7\nf -4 -3 -2 -1\nf -8 -7 -3 -4\nf -6 -5 -1 -2\nf -7 -6 -2 -3\nf -5 -8 -4 -1\n";
}

class ViewCommand : public testing::Test {
  protected:
    ViewCommand() { std::ofstream(folder_.path() / "m.mtl") << kMtl; }

    ProgramResult render(const std::string& obj, std::vector<std::string> options) {
        std::ofstream(folder_.path() / "m.obj") << "mtllib m.mtl\n" << obj;
        std::vector<std::string> arguments{"render", "m.obj", "--quiet", "--device", "cpu",    "--size",
                                           "16x16",  "--spp", "4",       "-o",       "out.png"};
        arguments.insert(arguments.end(), options.begin(), options.end());
        return runDuolux(folder_.path(), std::move(arguments));
    }

    TemporaryFolder folder_;
};

TEST_F(ViewCommand, PicturesThatAreFineBringNoWarning) {
    const std::string lit = std::string(kFloor) + "usemtl lamp\n" + kDown;
    EXPECT_EQ(render(lit, {}).err, "");
    // In a closed room the lamp is too bright for a PNG without an exposure.
    EXPECT_EQ(render(box("2", "0", "2") + "usemtl lamp\n" + kDown, {"--exposure", "-2"}).err, "");
}

TEST_F(ViewCommand, DarkPicturesNameTheirCause) {
    const std::string lit = std::string(kFloor) + "usemtl lamp\n" + kDown;
    const std::string room = box("2", "0", "2") + "usemtl lamp\n" + kDown;
    EXPECT_THAT(render(lit, {"--camera-position", "0,1,9", "--look-at", "0,1,20"}).err,
                HasSubstr("less than 1 % of the picture is lit: the camera looks past the scene"));
    EXPECT_THAT(render(room, {"--camera-position", "0,1,9", "--look-at", "0,1,0"}).err,
                testing::AllOf(HasSubstr("behind a wall or inside of an object"),
                               HasSubstr("material \"white\""), HasSubstr("--camera-position ")));
    EXPECT_THAT(render(std::string(kFloor) + "usemtl lamp\n" + kUp,
                       {"--no-lamp", "--camera-position", "3,0.5,0", "--look-at", "1.5,0,0", "--vfov", "20"})
                    .err,
                testing::AllOf(HasSubstr("material \"lamp\") face away"), HasSubstr("counter-clockwise"),
                               Not(HasSubstr("1 %"))))
        << "said once";
    EXPECT_THAT(render(kFloor + box("0.9", "0.8", "1.2") + "usemtl lamp\n" + kDown,
                       {"--no-lamp", "--camera-position", "0,9,1", "--look-at", "1.6,0,0", "--vfov", "2"})
                    .err,
                HasSubstr("no light reaches what the camera sees"));
    EXPECT_THAT(render(std::string(kFloor) + "usemtl dim\n" + kDown, {"--no-lamp"}).err,
                HasSubstr("very dark; try --exposure 1"));
    EXPECT_THAT(render(lit, {"--preset", "global", "--bounces", "0", "--camera-position", "0,9,1",
                             "--look-at", "1.6,0,0", "--vfov", "2"})
                    .err,
                HasSubstr("try more --bounces"));
    std::ofstream(folder_.path() / "mirror.mtl") << "newmtl mirror\nPm 1\nPr 0\nKd 1 1 1\n";
    EXPECT_THAT(
        render("mtllib mirror.mtl\nv 0 0 0\nv 1 0 0\nv 1 0 1\nv 0 0 1\nusemtl mirror\nf 1 4 3 2\n", {}).err,
        testing::AllOf(HasSubstr("material \"mirror\") are metal or glass"), Not(HasSubstr("--lamp"))));
    const ProgramResult dark = render(kFloor, {"--no-lamp"});
    EXPECT_EQ(dark.err, "duolux: warning: nothing emits light: the picture will be black\n");
}

TEST_F(ViewCommand, OverexposedPicturesNameTheExposure) {
    const std::string bright = "mtllib b.mtl\n" + std::string(kFloor) + "usemtl bright\n" + kDown;
    std::ofstream(folder_.path() / "b.mtl") << "newmtl bright\nKe 5000 5000 5000\n";
    const std::string err = render(bright, {}).err;
    EXPECT_THAT(err,
                testing::MatchesRegex("duolux: warning: [0-9]+ % of what is lit in the picture is brighter "
                                      "than white and clipped; try --exposure -[0-9.]+\n"));
    const std::string exposure = err.substr(err.rfind(' ') + 1, err.size() - err.rfind(' ') - 2);
    EXPECT_EQ(render(bright, {"--exposure", exposure}).err, "");
    EXPECT_THAT(render(bright, {"--exposure", "-40"}).err,
                HasSubstr("all of it is very dark; try --exposure -"));
    const ProgramResult exr = runDuolux(folder_.path(), {"render", "m.obj", "--quiet", "--device", "cpu",
                                                         "--size", "16x16", "--spp", "4", "-o", "out.exr"});
    EXPECT_EQ(exr.err, "") << "nothing is clipped there";
    EXPECT_THAT(render(std::string(kFloor) + "usemtl lamp\n" + kUp, {"--no-lamp"}).err,
                Not(HasSubstr("clipped")))
        << "only the lamp itself is bright";
}

TEST_F(ViewCommand, AnEmitterThatIsNotVisibleIsBlackByDesign) {
    std::ofstream(folder_.path() / "scene.json") << R"({"duolux": 1, "lights": [{"type": "rectangle",
        "origin": [0, 0, 0], "edge1": [1, 0, 0], "edge2": [0, 1, 0], "emission": {"invisible": 1}}]})";
    const ProgramResult result = runDuolux(folder_.path(), {"render", "scene.json", "--device", "cpu",
                                                            "--size", "8x8", "--spp", "1", "-o", "a.png"});
    EXPECT_EQ(result.status, 0);
    EXPECT_THAT(result.err, HasSubstr("sees only emitters, and they emit no visible light"));
}

TEST_F(ViewCommand, InfoShowsTheCameraAsASceneFileGivesIt) {
    std::ofstream(folder_.path() / "m.obj") << "mtllib m.mtl\n" << kFloor;
    const ProgramResult text = runDuolux(folder_.path(), {"info", "m.obj", "--vfov", "25", "--up", "y"});
    ASSERT_EQ(text.status, 0) << text.err;
    const std::size_t begin = text.out.find('{');
    ASSERT_NE(begin, std::string::npos) << text.out;
    const std::string line = text.out.substr(begin, text.out.find('\n', begin) - begin);
    const nlohmann::json camera = nlohmann::json::parse(line);
    EXPECT_EQ(camera["vfov"], 25);
    std::ofstream(folder_.path() / "s.json")
        << R"({"duolux": 1, "objects": [{"mesh": "m.obj"}], "camera": )" << line << "}";
    const ProgramResult pasted = runDuolux(folder_.path(), {"info", "s.json", "--json"});
    ASSERT_EQ(pasted.status, 0) << pasted.err;
    const nlohmann::json info = nlohmann::json::parse(pasted.out);
    EXPECT_EQ(info["camera"], camera);
    EXPECT_EQ(info["version"], 1);
    for (const char* key :
         {"scene", "hash", "triangles", "vertices", "smooth_triangles", "bounds", "origin", "geometry_bytes",
          "film", "render", "display", "reflectance", "lights", "materials", "energy", "warnings"}) {
        EXPECT_TRUE(info.contains(key)) << key;
    }
    EXPECT_EQ(info["materials"][0]["name"], "white");
    EXPECT_EQ(info["materials"][0]["base_color"][0], 0.8);
}

TEST_F(ViewCommand, VectorsMayBeThreeWords) {
    std::ofstream(folder_.path() / "m.obj") << "mtllib m.mtl\n" << kFloor;
    const auto cameraOf = [&](std::vector<std::string> arguments) {
        arguments.insert(arguments.begin(), {"info", "--json"});
        arguments.emplace_back("m.obj");
        return nlohmann::json::parse(runDuolux(folder_.path(), std::move(arguments)).out)["camera"];
    };
    const nlohmann::json camera =
        cameraOf({"--camera-position", "-1,.5,3", "--look-at", "0,1e-1,0", "--up", "0,0,1"});
    EXPECT_EQ(camera["position"], nlohmann::json::parse("[-1.0, 0.5, 3.0]"));
    EXPECT_EQ(cameraOf({"--camera-position", "-1", ".5", "3", "--look-at", "0,", "1e-1,", "0", "--up", "0",
                        "0", "1"}),
              camera);
}

TEST_F(ViewCommand, InfoShowsTheLampThatRenderAdds) {
    for (const std::string& obj : {std::string(kFloor), box("2", "0", "2")}) {
        ASSERT_EQ(render(obj, {"-o", "a.exr"}).status, 0);
        const ProgramResult result = runDuolux(folder_.path(), {"info", "m.obj", "--json"});
        ASSERT_EQ(result.status, 0) << result.err;
        const nlohmann::json info = nlohmann::json::parse(result.out);
        EXPECT_EQ(info["lights"]["triangles"], 0) << "the file has none";
        EXPECT_THAT(runDuolux(folder_.path(), {"info", "m.obj"}).out,
                    HasSubstr("added lamp   {\"type\": \"rectangle\", "));
        nlohmann::json scene = {{"duolux", 1}, {"objects", {{{"mesh", "m.obj"}}}}};
        scene["camera"] = info["camera"];
        scene["lights"] = {info["added_lamp"]};
        std::ofstream(folder_.path() / "s.json") << scene;
        const ProgramResult pasted =
            runDuolux(folder_.path(), {"render", "s.json", "--quiet", "--device", "cpu", "--size", "16x16",
                                       "--spp", "4", "-o", "b.exr"});
        EXPECT_EQ(pasted.status, 0);
        EXPECT_EQ(pasted.err, "");
        const ProgramResult compared =
            runDuolux(folder_.path(), {"compare", "a.exr", "b.exr", "--fail-above", "rmse=1e-3"});
        EXPECT_EQ(compared.status, 0) << compared.out;
    }
    render(std::string(kFloor) + "usemtl lamp\n" + kDown, {});
    const ProgramResult lit = runDuolux(folder_.path(), {"info", "m.obj", "--json"});
    EXPECT_TRUE(nlohmann::json::parse(lit.out)["added_lamp"].is_null());
}

TEST_F(ViewCommand, FarFromTheOriginACameraCanStillBePasted) {
    std::ofstream(folder_.path() / "m.obj") << "v 1000000000000 5 1000000002000.25\nv 1000000000003.5 5 "
                                               "1000000002000\nv 1000000000000 8 1000000002000\nf 1 2 3\n";
    const ProgramResult text = runDuolux(folder_.path(), {"info", "m.obj"});
    ASSERT_EQ(text.status, 0) << text.err;
    EXPECT_THAT(text.out,
                HasSubstr("1000000000000, 5, 1000000002000  to  1000000000003.5, 8, 1000000002000.25"));
    EXPECT_THAT(text.out, HasSubstr("origin       1000000000002, 7, 1000000002000\n"));
    const std::size_t begin = text.out.find('{');
    const std::string line = text.out.substr(begin, text.out.find('\n', begin) - begin);
    std::ofstream(folder_.path() / "s.json")
        << R"({"duolux": 1, "objects": [{"mesh": "m.obj"}], "camera": )" << line << "}";
    const ProgramResult pasted = runDuolux(folder_.path(), {"info", "s.json", "--json"});
    ASSERT_EQ(pasted.status, 0) << pasted.err;
    const nlohmann::json info = nlohmann::json::parse(pasted.out);
    EXPECT_EQ(info["camera"], nlohmann::json::parse(line));
    EXPECT_NE(info["camera"]["position"], info["camera"]["target"]);
    EXPECT_EQ(info["origin"], nlohmann::json::parse("[1000000000002.0, 7.0, 1000000002000.0]"));
    const ProgramResult rendered =
        runDuolux(folder_.path(), {"render", "s.json", "--device", "cpu", "--size", "8x8", "--spp", "1", "-o",
                                   "a.png", "--quiet", "--report", "-"});
    ASSERT_EQ(rendered.status, 0) << rendered.err;
    EXPECT_EQ(nlohmann::json::parse(rendered.out)["scene"]["origin"], info["origin"]);
}

TEST_F(ViewCommand, DevicesCanBeReadByScripts) {
    const ProgramResult result = runDuolux(folder_.path(), {"devices", "--json"});
    ASSERT_EQ(result.status, 0) << result.err;
    const nlohmann::json devices = nlohmann::json::parse(result.out);
    EXPECT_EQ(devices["version"], 1);
    const nlohmann::json& first = devices["devices"][0];
    for (const char* key :
         {"index", "chosen", "name", "driver", "kind", "vulkan", "subgroup_size", "memory_bytes",
          "storage_buffer_bytes", "texel_buffer_texels", "most_triangle_pairs", "ray_queries", "lacks"}) {
        EXPECT_TRUE(first.contains(key)) << key;
    }
}

TEST_F(ViewCommand, ShadowlessHasFewBouncesUnlessItIsSaidHowMany) {
    const std::string room = box("2", "0", "2") + "usemtl lamp\n" + kDown;
    EXPECT_THAT(render(room, {"--preset", "shadowless", "--report", "r.json"}).err,
                HasSubstr("is not specified: using 4"));
    EXPECT_EQ(nlohmann::json::parse(contentsOf(folder_.path() / "r.json"))["settings"]["bounces"], 4);
    EXPECT_THAT(render(room, {"--preset", "shadowless", "--bounces", "6"}).err,
                testing::AllOf(Not(HasSubstr("using 4")), HasSubstr("the limit of 6 bounces")));
    // A checkpoint with the default number of bounces resumes with the default.
    ASSERT_EQ(render(room, {"--blend", "1,1", "--checkpoint", "c.part"}).status, 0);
    EXPECT_EQ(render(room, {"--blend", "1,1", "--resume", "c.part"}).status, 0);
    EXPECT_EQ(render(room, {"--blend", "1,1", "--resume", "c.part", "--bounces", "16"}).status, 3);
}

}  // namespace
}  // namespace duolux::test

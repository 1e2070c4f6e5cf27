#include <sys/stat.h>

#include "tests/unit/json_files.h"

namespace duolux::test {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

TEST_F(JsonTest, UnknownKeysSuggestTheNearest) {
    EXPECT_EQ(errorWith(R"("camera": {"position": [0,0,1], "target": [0,0,0], "vfow": 40})"),
              "scene.json: camera.vfow: unknown key; did you mean \"vfov\"?");
    EXPECT_EQ(errorWith(R"("flim": {})"), "scene.json: flim: unknown key; did you mean \"film\"?");
    EXPECT_EQ(errorWith(R"("film": {"colour": 3})"),
              "scene.json: film.colour: unknown key; expected one of \"width\", \"height\"");
    EXPECT_EQ(errorWith(R"("materials": {"white": {"emision": {}}})"),
              "scene.json: materials.white.emision: unknown key; did you mean \"emission\"?");
    EXPECT_EQ(errorWith(R"("materials": {"wihte": {}})"),
              "scene.json: materials.wihte: no mesh has a material of this name; did you mean \"white\"?");
    EXPECT_EQ(errorWith(R"("reflectance": {"preset": "globl"})"),
              "scene.json: reflectance.preset: is \"globl\"; did you mean \"global\"?");
}

TEST_F(JsonTest, SyntaxErrorsGiveLineAndColumn) {
    EXPECT_THAT(
        errorOfJson("{\n  \"duolux\": 1,\n  \"film\": {,}\n}\n"),
        StartsWith("scene.json: line 3, column 12: syntax error while parsing object key - unexpected ','"));
    EXPECT_THAT(errorOfJson(""), StartsWith("scene.json: line 1, column 1: syntax error"));
    EXPECT_THAT(errorOfJson("{\"duolux\": 1"), StartsWith("scene.json: line 1, column 13: syntax error"));
    EXPECT_THAT(errorOfJson("{\"duolux\": 1e999}"), HasSubstr("duolux: is 1e999"));
    EXPECT_THAT(errorOfJson("{\"duolux\": \"\xff\"}"),
                StartsWith("scene.json: line 1, column 13: syntax error"));
}

TEST_F(JsonTest, DuplicateKeysAreErrors) {
    EXPECT_EQ(errorWith(R"("film": {"width": 3, "height": 3, "width": 4})"),
              "scene.json: film.width: the key appears twice; expected it once");
    EXPECT_EQ(errorWith(R"("lights": [{}, {"type": 1, "type": 1}])"),
              "scene.json: lights[1].type: the key appears twice; expected it once");
    EXPECT_THAT(errorWith(R"("objects": [])"), HasSubstr("objects: the key appears twice"));
}

TEST_F(JsonTest, Version) {
    EXPECT_EQ(errorOfJson("{}"),
              "scene.json: \"duolux\" is missing; expected \"duolux\": 1, the version of the format");
    EXPECT_THAT(errorOfJson(R"({"duolux": 2})"), HasSubstr("duolux: is 2; expected 1"));
    EXPECT_THAT(errorOfJson("[1]"), HasSubstr("is an array of 1; expected an object"));
}

TEST_F(JsonTest, CameraIsChecked) {
    const auto error = [&](const std::string& keys) { return errorWith("\"camera\": {" + keys + "}"); };
    const std::string at = R"("position": [0, 0, 5], "target": [0, 0, 0])";
    EXPECT_THAT(error(at + R"(, "up": [0, 0, 3])"),
                HasSubstr("camera: up is parallel to the view direction; expected a vector"));
    EXPECT_THAT(error(at + R"(, "up": [0, 0, 0])"), HasSubstr("camera: up has no direction"));
    EXPECT_THAT(error(R"("position": [1, 1, 1], "target": [1, 1, 1])"),
                HasSubstr("camera: position and target are the same"));
    EXPECT_THAT(error(at + R"(, "vfov": 180)"),
                HasSubstr("camera.vfov: is 180; expected the full vertical angle"));
    EXPECT_THAT(error(at + R"(, "type": "fisheye")"), HasSubstr("camera.type: is \"fisheye\""));
    EXPECT_THAT(error(at + R"(, "height": 2)"), HasSubstr("a perspective camera has no height"));
    EXPECT_THAT(error(at + R"(, "type": "orthographic", "height": 0)"),
                HasSubstr("camera.height: is 0; expected the height of the image"));
    EXPECT_THAT(error(at + R"(, "type": "orthographic", "vfov": 30)"),
                HasSubstr("camera: an orthographic camera has no angle of view; expected \"height\""));
    EXPECT_THAT(error(at + R"(, "vfov": 0)"), HasSubstr("camera.vfov: is 0"));
    EXPECT_THAT(error(at + R"(, "vfov": "wide")"), HasSubstr("camera.vfov: is \"wide\""));
    EXPECT_THAT(error(R"("position": [1, 1], "target": [0, 0, 0])"),
                HasSubstr("camera.position: is an array of 2; expected [x, y, z]"));
    EXPECT_THAT(error(R"("position": [1, null, 1], "target": [0, 0, 0])"),
                HasSubstr("camera.position[1]: is null"));
    EXPECT_THAT(error(R"("position": [1e30, 0, 1], "target": [0, 0, 0])"),
                HasSubstr("camera.position[0]: is 1e+30; expected [x, y, z], at most 1e+18"));
}

TEST_F(JsonTest, NumbersAreChecked) {
    EXPECT_THAT(errorWith(R"("film": {"width": 0})"),
                HasSubstr("film.width: is 0; expected a whole number from 1 to 16384"));
    EXPECT_THAT(errorWith(R"("film": {"width": 16385})"), HasSubstr("film.width: is 16385"));
    EXPECT_THAT(errorWith(R"("film": {"height": 1.5})"), HasSubstr("film.height: is 1.5"));
    EXPECT_THAT(errorWith(R"("film": [])"), HasSubstr("film: is an array of 0; expected an object"));
    EXPECT_THAT(errorWith(R"("render": {"spp": -1})"), HasSubstr("render.spp: is -1"));
    EXPECT_THAT(errorWith(R"("render": {"spp": 16777217})"), HasSubstr("render.spp: is 16777217"));
    EXPECT_THAT(errorWith(R"("render": {"bounces": 65536})"), HasSubstr("render.bounces: is 65536"));
    EXPECT_THAT(errorWith(R"("render": {"seed": 4294967296})"), HasSubstr("render.seed: is 4294967296"));
    EXPECT_THAT(errorWith(R"("render": {"spp": true})"), HasSubstr("render.spp: is true"));
    EXPECT_THAT(errorWith(R"("render": {"sampler": "halton"})"),
                HasSubstr("render.sampler: is \"halton\"; expected one of \"sobol\", \"independent\""));
    EXPECT_THAT(
        errorWith(R"("display": [0, 0])"),
        HasSubstr("display: is [0, 0], which makes every picture black; expected [invisible, visible]"));
    EXPECT_THAT(errorWith(R"("display": [1, -0.5])"),
                HasSubstr("display[1]: is -0.5; expected [invisible, visible]"));
    EXPECT_THAT(errorWith(R"("display": [1])"),
                HasSubstr("display: is an array of 1; expected [invisible, visible]"));
}

TEST_F(JsonTest, ReflectancesAreChecked) {
    const auto error = [&](const std::string& value) { return errorWith("\"reflectance\": " + value); };
    EXPECT_THAT(error("{}"), HasSubstr("reflectance: is empty; expected {\"preset\": name}"));
    EXPECT_THAT(error(R"({"preset": "local", "blend": [0, 0]})"),
                HasSubstr("reflectance: mixes several kinds"));
    EXPECT_THAT(error(R"({"opaque": [[1, 0], [0, 0]]})"),
                HasSubstr("reflectance: \"transparent\" is missing"));
    EXPECT_THAT(error(R"({"blend": [0.5]})"), HasSubstr("reflectance.blend: is an array of 1"));
    EXPECT_THAT(error(R"({"blend": [-0.5, 1]})"), HasSubstr("reflectance.blend[0]: is -0.5"));
    EXPECT_THAT(error(R"({"opaque": [[1, 0], [-1, 0]], "transparent": [[0, 0], [0, 0]]})"),
                HasSubstr("reflectance.opaque[1][0]: is -1; expected a number or [r, g, b]"));
    EXPECT_THAT(error(R"({"opaque": [[1, 0, 0], [1, 0]], "transparent": [[0, 0], [0, 0]]})"),
                HasSubstr("reflectance.opaque[0]: is an array of 3; expected [[m00, m01], [m10, m11]]"));
    EXPECT_THAT(error(R"({"opaque": [[[1, 1], 0], [1, 0]], "transparent": [[0, 0], [0, 0]]})"),
                HasSubstr("reflectance.opaque[0][0]: is an array of 2"));
    EXPECT_THAT(error("\"local\""), HasSubstr("reflectance: is \"local\"; expected an object"));
}

TEST_F(JsonTest, MaterialsAreChecked) {
    const auto error = [&](const std::string& keys) {
        return errorWith("\"materials\": {\"white\": {" + keys + "}}");
    };
    EXPECT_THAT(error(R"("diffuse": [1, 1.1, 1])"),
                HasSubstr("materials.white.diffuse[1]: is 1.1; expected an albedo"));
    EXPECT_THAT(error(R"("base_color": 2)"),
                HasSubstr("materials.white.base_color: is 2; expected an albedo"));
    EXPECT_THAT(error(R"("base_color": 1, "diffuse": 1)"),
                HasSubstr("materials.white.diffuse: is another name of base_color; expected one of the two"));
    EXPECT_THAT(error(R"("metallic": 1.5)"),
                HasSubstr("materials.white.metallic: is 1.5; expected a number from 0 to 1"));
    EXPECT_THAT(error(R"("roughness": "smooth")"), HasSubstr("materials.white.roughness: is \"smooth\""));
    EXPECT_THAT(error(R"("diffuse": "red")"), HasSubstr("materials.white.diffuse: is \"red\""));
    EXPECT_THAT(error(R"("emission": {"invisible": -1})"),
                HasSubstr("materials.white.emission.invisible: is -1"));
    EXPECT_THAT(error(R"("emission": 5)"), HasSubstr("materials.white.emission: is 5; expected an object"));
    EXPECT_THAT(error(R"("sides": "back")"),
                HasSubstr("materials.white.sides: is \"back\"; expected one of \"front\""));
}

TEST_F(JsonTest, EveryFieldOfAMaterialIsChecked) {
    forEachField(Material{}, [&]<typename T>(const std::string& key, const T&) {
        if (key == "textures") return;  // are values of the other keys
        constexpr bool kIsObject = std::is_same_v<T, Emission> || std::is_same_v<T, Alpha> ||
                                   std::is_same_v<T, std::optional<Reflectance>>;
        const std::string wrong = kIsObject ? "5" : R"({"nonsense": 0})";
        EXPECT_THAT(
            errorWith(R"("materials": {"white": {")" + key + "\": " + wrong + "}}"),
            HasSubstr("materials.white." + key + ": is " + (kIsObject ? "5" : "an object") + "; expected"));
    });
}

TEST_F(JsonTest, ObjectsAreChecked) {
    const auto error = [&](const std::string& objects) {
        return errorOfJson("{\"duolux\": 1, \"objects\": " + objects + "}");
    };
    EXPECT_THAT(error("[]"), HasSubstr("scene.json: has no triangles"));
    EXPECT_THAT(error("{}"), HasSubstr("objects: is an object; expected an array"));
    EXPECT_THAT(error("[{}]"), HasSubstr("objects[0]: \"mesh\" is missing"));
    EXPECT_THAT(error(R"([{"mesh": "none.obj"}])"), HasSubstr("objects[0].mesh: there is no file none.obj"));
    ASSERT_EQ(::mkfifo((folder_ / "pipe.obj").c_str(), 0600), 0);
    EXPECT_THAT(error(R"([{"mesh": "pipe.obj"}])"),
                HasSubstr("objects[0].mesh: pipe.obj is a pipe or a device"));
    std::filesystem::create_directory(folder_ / "folder.obj");
    EXPECT_THAT(error(R"([{"mesh": "folder.obj"}])"), HasSubstr("objects[0].mesh: folder.obj is a folder"));
    EXPECT_THAT(error(R"([{"mesh": "mesh.fbx"}])"),
                HasSubstr("objects[0].mesh: is \"mesh.fbx\"; expected the path of an .obj"));
    const auto transform = [&](const std::string& numbers) {
        return error(R"([{"mesh": "mesh.obj", "transform": [)" + numbers + "]}]");
    };
    EXPECT_THAT(transform("1,0,0,0"),
                HasSubstr("objects[0].transform: is an array of 4; expected 16 numbers"));
    EXPECT_THAT(transform("1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,2"), HasSubstr("the last row is not 0, 0, 0, 1"));
    EXPECT_THAT(transform("1,0,0,0, 0,1,0,0, 1,1,0,0, 0,0,0,1"),
                HasSubstr("objects[0].transform: is singular"));
    EXPECT_THAT(transform("0,0,0,0, 0,0,0,0, 0,0,0,0, 0,0,0,1"), HasSubstr("is singular"));
    EXPECT_THAT(transform("1e9,0,0,1e9, 0,1,0,0, 0,0,1,0, 0,0,0,1"),
                HasSubstr("moves the mesh out of range"));
}

TEST_F(JsonTest, NumbersThatOverflowAreNamed) {
    EXPECT_THAT(errorWith(R"("lights": [{"type": "rectangle"}, {"emission": {"visible": [1, -1e999, 1]}}])"),
                HasSubstr("scene.json: lights[1].emission.visible[1]: is -1e999; expected a number"));
    EXPECT_THAT(errorWith(R"("camera": {"vfov": 1e400})"), HasSubstr("scene.json: camera.vfov: is 1e400"));
}

TEST_F(JsonTest, LightsAreChecked) {
    const auto error = [&](const std::string& light) { return errorWith("\"lights\": [" + light + "]"); };
    EXPECT_THAT(error(R"({"type": "sphere"})"),
                HasSubstr("lights[0].type: is \"sphere\"; expected one of \"point\", \"rectangle\""));
    EXPECT_THAT(error(R"({"type": "point", "emission": {}})"),
                HasSubstr("lights[0]: \"position\" is missing"));
    EXPECT_THAT(error(R"({"type": "rectangle", "origin": [0,0,0]})"),
                HasSubstr("lights[0]: \"edge1\" is missing"));
    EXPECT_THAT(
        error(
            R"({"type": "rectangle", "origin": [0,0,0], "edge1": [1,0,0], "edge2": [2,0,0], "emission": {}})"),
        HasSubstr("lights[0]: edge1 and edge2 span no area"));
    EXPECT_THAT(error(R"({"type": "rectangle", "origin": [0,0,0], "edge1": [1,0,0], "edge2": [0,1,0]})"),
                HasSubstr("lights[0]: \"emission\" is missing"));
    EXPECT_THAT(errorWith(R"("lights": 3)"), HasSubstr("lights: is 3; expected an array"));
}

TEST_F(JsonTest, ErrorsInMeshesNameTheMesh) {
    write("mesh.obj", "v 0 0\n");
    EXPECT_EQ(errorWith(""), "mesh.obj: line 1: 2 numbers; expected \"v x y z\"");
}

TEST_F(JsonTest, NamesWithControlCharactersStayOneLine) {
    const std::string error = errorWith(R"("a\nb\u001b[31m": 1)");
    EXPECT_THAT(error, StartsWith("scene.json: a\\x0ab\\x1b[31m: unknown key"));
}

TEST_F(JsonTest, LongKeysAndValuesAreShortened) {
    EXPECT_LT(errorWith("\"" + std::string(1'000'000, 'k') + "\": 1").size(), 300u);
    EXPECT_LT(errorOfJson(R"({"duolux": 1, "objects": [{"mesh": ")" + std::string(100'000, 'm') + ".obj\"}]}")
                  .size(),
              500u);
}

TEST_F(JsonTest, PathsWithAZeroByteAreRefused) {
    write("secret", kTriangleObj);
    EXPECT_THAT(errorOfJson(R"({"duolux": 1, "objects": [{"mesh": "secret\u0000.obj"}]})"),
                HasSubstr("objects[0].mesh: is \"secret\\x00.obj\"; expected the path"));
}

TEST_F(JsonTest, DeepNestingIsAnErrorLikeAnyOther) {
    std::string text = "{\"duolux\": ";
    for (int i = 0; i < 100'000; ++i)
        text += '[';
    EXPECT_THAT(errorOfJson(text), HasSubstr("syntax error"));
    for (int i = 0; i < 100'000; ++i)
        text += ']';
    EXPECT_THAT(errorOfJson(text + "}"), HasSubstr("duolux: is an array of 1"));
}

}  // namespace
}  // namespace duolux::test

#include <string>
#include <utility>
#include <vector>

#include "tests/cli/malformed_cases.h"

namespace duolux::test {

namespace {

MalformedScene json(const char* name, const std::string& text, std::vector<std::string> words) {
    return {name,
            {{"scene.json", text}, {"mesh.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl white\nf 1 2 3\n"}},
            std::move(words)};
}

/// A valid scene, except for the given keys.
MalformedScene keys(const char* name, const std::string& more, std::vector<std::string> words) {
    return json(name, R"({"duolux": 1, "objects": [{"mesh": "mesh.obj"}], )" + more + "}", std::move(words));
}

MalformedScene camera(const char* name, const std::string& more, std::vector<std::string> words) {
    return keys(name, "\"camera\": {" + more + "}", std::move(words));
}

MalformedScene transform(const char* name, const std::string& numbers, std::vector<std::string> words) {
    return json(name, R"({"duolux": 1, "objects": [{"mesh": "mesh.obj", "transform": [)" + numbers + "]}]}",
                std::move(words));
}

}  // namespace

std::vector<MalformedScene> malformedJsons() {
    const std::string view = R"("position": [0, 0, 5], "target": [0, 0, 0])";
    return {
        json("Empty", "", {"scene.json: line 1, column 1: ", "syntax error"}),
        json("Truncated", "{\n \"duolux\": 1,\n", {"scene.json: line 3, column 1: ", "syntax error"}),
        json("StrayComma", "{\"duolux\": 1,\n}", {"scene.json: line 2, column 1: ", "unexpected '}'"}),
        json("NotUtf8", "{\"duolux\": \"\xc3(\"}", {"scene.json: line 1", "syntax error"}),
        json("NotAnObject", "[]", {"scene.json: ", "is an array of 0", "expected an object"}),
        json("NoVersion", R"({"objects": [{"mesh": "mesh.obj"}]})",
             {"scene.json: ", "\"duolux\" is missing"}),
        json("OtherVersion", R"({"duolux": 7})", {"scene.json: duolux: ", "is 7"}),
        json("NoTriangles", R"({"duolux": 1})", {"scene.json: ", "no triangles", "\"objects\""}),
        keys("UnknownKey", R"("refelctance": {})",
             {"scene.json: refelctance: ", "did you mean \"reflectance\"?"}),
        keys("DuplicateKey", R"("film": {"width": 1, "width": 2})", {"scene.json: film.width: ", "twice"}),
        camera("UnknownCameraKey", view + R"(, "vfow": 40)",
               {"scene.json: camera.vfow: ", "did you mean \"vfov\"?"}),
        camera("TargetAtPosition", R"("position": [1, 2, 3], "target": [1, 2, 3])",
               {"scene.json: camera: ", "the same"}),
        camera("UpAlongView", view + R"(, "up": [0, 0, -2])",
               {"scene.json: camera: ", "up is parallel to the view direction"}),
        camera("FlatAngle", view + R"(, "vfov": 180)",
               {"scene.json: camera.vfov: ", "is 180", "between 0 and 180"}),
        camera("AngleAsText", view + R"(, "vfov": "40")",
               {"scene.json: camera.vfov: ", "is \"40\"", "degrees"}),
        camera("PointOfTwo", R"("position": [1, 2], "target": [0, 0, 0])",
               {"scene.json: camera.position: ", "[x, y, z]"}),
        keys("WidthZero", R"("film": {"width": 0})", {"scene.json: film.width: ", "is 0", "1 to 16384"}),
        keys("SamplesFraction", R"("render": {"spp": 1.5})",
             {"scene.json: render.spp: ", "is 1.5", "whole number"}),
        keys("BouncesNegative", R"("render": {"bounces": -1})",
             {"scene.json: render.bounces: ", "is -1", "0 to 65535"}),
        keys("SamplerUnknown", R"("render": {"sampler": "soobl"})",
             {"scene.json: render.sampler: ", "\"sobol\"?"}),
        keys("DisplayOfThree", R"("display": [0, 1, 0])", {"scene.json: display: ", "[invisible, visible]"}),
        keys("PresetUnknown", R"("reflectance": {"preset": "locale"})",
             {"scene.json: reflectance.preset: ", "is \"locale\"", "did you mean \"local\"?"}),
        keys("BlendNegative", R"("reflectance": {"blend": [-1, 0]})",
             {"scene.json: reflectance.blend[0]: ", "is -1"}),
        keys("MatrixNegative",
             R"("reflectance": {"opaque": [[0, 0], [1, -2]], "transparent": [[0, 0], [0, 0]]})",
             {"scene.json: reflectance.opaque[1][1]: ", "is -2", "[r, g, b]"}),
        keys("MatrixOfThreeRows",
             R"("reflectance": {"opaque": [[0, 0], [1, 0], [0, 0]], "transparent": [[0, 0], [0, 0]]})",
             {"scene.json: reflectance.opaque: ", "is an array of 3", "[[m00, m01], [m10, m11]]"}),
        keys("MatrixAlone", R"("reflectance": {"opaque": [[0, 0], [1, 0]]})",
             {"scene.json: reflectance: ", "\"transparent\""}),
        keys("TwoReflectances", R"("reflectance": {"preset": "local", "blend": [1, 1]})",
             {"scene.json: reflectance: ", "several kinds"}),
        keys("MaterialUnknown", R"("materials": {"whit": {}})",
             {"scene.json: materials.whit: ", "no mesh", "did you mean \"white\"?"}),
        keys("AlbedoAboveOne", R"("materials": {"white": {"diffuse": [1, 1, 1.01]}})",
             {"scene.json: materials.white.diffuse[2]: ", "is 1.01", "0 to 1"}),
        keys("EmissionNegative", R"("materials": {"white": {"emission": {"visible": [0, -1, 0]}}})",
             {"scene.json: materials.white.emission.visible[1]: ", "is -1"}),
        keys("SidesUnknown", R"("materials": {"white": {"sides": "bth"}})",
             {"scene.json: materials.white.sides: ", "did you mean \"both\"?"}),
        keys("ImageMissing", R"("materials": {"white": {"roughness": {"image": "none.png"}}})",
             {"scene.json: materials.white.roughness.image: ", "no file none.png", "relative to the scene"}),
        keys("ImageChannelUnknown",
             R"("materials": {"white": {"roughness": {"image": "mesh.obj", "channel": "red"}}})",
             {"scene.json: materials.white.roughness.channel: ", "is \"red\"", "\"r\""}),
        keys("ImageWrapUnknown",
             R"("materials": {"white": {"diffuse": {"image": "mesh.obj", "wrap": "tile"}}})",
             {"scene.json: materials.white.diffuse.wrap: ", "is \"tile\"", "\"repeat\""}),
        keys("NormalAsNumber", R"("materials": {"white": {"normal": 1}})",
             {"scene.json: materials.white.normal: ", "is 1", "\"image\""}),
        keys("AlphaModeUnknown", R"("materials": {"white": {"alpha": {"mode": "blended"}}})",
             {"scene.json: materials.white.alpha.mode: ", "did you mean \"blend\"?"}),
        keys("EmissionBesideImage",
             R"("materials": {"white": {"emission": {"invisible": 1, "visible": {"image": "mesh.obj"}}}})",
             {"scene.json: materials.white.emission.invisible: ", "beside an image", "or 0"}),
        keys("LightUnknown", R"("lights": [{"type": "spt"}])",
             {"scene.json: lights[0].type: ", "\"rectangle\""}),
        keys(
            "PointWithSides",
            R"("lights": [{"type": "point", "position": [0, 1, 0], "emission": {"invisible": 1, "sides": "both"}}])",
            {"scene.json: lights[0].emission.sides: "}),
        keys("PointWithoutPosition", R"("lights": [{"type": "point", "emission": {"invisible": 1}}])",
             {"scene.json: lights[0]: ", "\"position\""}),
        keys("PointNegative",
             R"("lights": [{"type": "point", "position": [0, 1, 0], "emission": {"visible": [1, -1, 1]}}])",
             {"scene.json: lights[0].emission.visible[1]: ", "is -1", "radiant intensity"}),
        keys("LightWithoutArea",
             R"("lights": [{"type": "rectangle", "origin": [0, 0, 0], "edge1": [1, 1, 0], "edge2": [2, 2, 0],
                "emission": {"invisible": 1}}])",
             {"scene.json: lights[0]: ", "span no area"}),
        json("MeshMissing", R"({"duolux": 1, "objects": [{"mesh": "nowhere.obj"}]})",
             {"scene.json: objects[0].mesh: ", "no file nowhere.obj", ".obj, .ply, .stl, .gltf or .glb file"}),
        json("MeshOfOtherKind", R"({"duolux": 1, "objects": [{"mesh": "mesh.ply"}]})",
             {"scene.json: objects[0].mesh: "}),
        {"MeshMalformed",
         {{"scene.json", R"({"duolux": 1, "objects": [{"mesh": "bad.obj"}]})"}, {"bad.obj", "v 1\n"}},
         {"bad.obj: line 1: ", "1 numbers"}},
        transform("TransformTooShort", "1, 0, 0", {"scene.json: objects[0].transform: ", "16 numbers"}),
        transform("TransformProjective", "1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,1,1",
                  {"scene.json: objects[0].transform: ", "last row"}),
        transform("TransformSingular", "1,0,0,0, 0,1,0,0, 0,0,0,0, 0,0,0,1",
                  {"scene.json: objects[0].transform: ", "singular"}),
    };
}

}  // namespace duolux::test

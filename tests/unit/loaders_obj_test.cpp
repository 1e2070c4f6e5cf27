#include <fmt/format.h>

#include <algorithm>

#include "tests/unit/scene_files.h"

namespace duolux::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

class ObjTest : public SceneFiles {
  protected:
    /// Removes the lamp, which comes last.
    Geometry load(std::string_view text) const {
        Geometry geometry = loadObj(text).geometry;
        geometry.triangles.resize(geometry.triangles.size() - 2);
        geometry.materials.resize(geometry.materials.size() - 2);
        if (!geometry.normalIndices.empty()) geometry.normalIndices.resize(geometry.triangles.size());
        return geometry;
    }
};

TEST_F(ObjTest, ReadsVerticesAndTriangles) {
    const Geometry geometry = load("# a comment\nv 0.5 -1.25e1 +3.\nv .5 2E-2 1\nv 1 0 0 1.0\n\nf 1 2 3\n");
    EXPECT_EQ(geometry.positions[0], glm::vec3(0.5f, -12.5f, 3.0f));
    EXPECT_EQ(geometry.positions[1], glm::vec3(0.5f, 0.02f, 1.0f));
    EXPECT_EQ(geometry.positions[2], glm::vec3(1.0f, 0.0f, 0.0f));
    EXPECT_THAT(geometry.triangles, ElementsAre(glm::uvec3(0, 1, 2)));
    EXPECT_TRUE(geometry.normals.empty());
}

TEST_F(ObjTest, ReadsEveryFormOfACorner) {
    const std::string head = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nvn 0 0 1\n";
    for (const char* face : {"f 1 2 3", "f 1/1 2/2 3/3", "f 1//1 2//1 3//1", "f 1/1/1 2/2/1 3/3/1",
                             "f -3 -2 -1", "f -3/-3/-1 -2/-2/-1 -1/-1/-1", "  f\t1  2\t 3  # no more"}) {
        EXPECT_THAT(load(head + face).triangles, ElementsAre(glm::uvec3(0, 1, 2))) << face;
    }
}

TEST_F(ObjTest, RelativeIndicesCountFromTheirLine) {
    const Geometry geometry =
        load("v 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\nv 0 0 1\nv 1 0 1\nv 0 1 1\nf -3 -2 -1\n");
    EXPECT_THAT(geometry.triangles, ElementsAre(glm::uvec3(0, 1, 2), glm::uvec3(3, 4, 5)));
}

TEST_F(ObjTest, VerticesMayFollowTheFaces) {
    EXPECT_THAT(load("f 1 2 3\nv 0 0 0\nv 1 0 0\nv 0 1 0\n").triangles, ElementsAre(glm::uvec3(0, 1, 2)));
}

TEST_F(ObjTest, LineEndsOfEverySystem) {
    std::string crlf, cr;
    for (const char c : kTriangleObj) {
        crlf += c == '\n' ? "\r\n" : std::string(1, c);
        cr += c == '\n' ? '\r' : c;
    }
    for (const std::string& text : {crlf, cr, "\xEF\xBB\xBF" + std::string(kTriangleObj),
                                    std::string("v 0 0 0\nv 1 0 \\\n0\nv 0 1 0\nf 1 \\\r\n2 3")}) {
        const Geometry geometry = load(text);
        EXPECT_EQ(geometry.positions[1], glm::vec3(1.0f, 0.0f, 0.0f));
        EXPECT_THAT(geometry.triangles, ElementsAre(glm::uvec3(0, 1, 2)));
    }
}

TEST_F(ObjTest, ObjectsAndGroupsAreOneGeometry) {
    const Geometry geometry = load(
        "o one\nv 0 0 0\nv 1 0 0\nv 0 1 0\ng a b\nf 1 2 3\no two\ng\nv 0 0 2\nv 1 0 2\nv 0 1 2\nf 4 5 6\nl 1 "
        "2\np 3\n");
    EXPECT_EQ(geometry.triangles.size(), 2u);
    EXPECT_EQ(geometry.positions.size(), 6u + 4u);  // and the lamp's
}

TEST_F(ObjTest, QuadrilateralIsCutOnceAndKeepsItsFront) {
    const Geometry geometry = load("v 0 0 0\nv 2 0 0\nv 2 3 0\nv 0 3 0\nf 1 2 3 4\n");
    ASSERT_EQ(geometry.triangles.size(), 2u);
    EXPECT_THAT(areaVector(geometry, 0), IsNear(glm::vec3(0, 0, 3), 1e-6f));
    EXPECT_THAT(areaVector(geometry, 1), IsNear(glm::vec3(0, 0, 3), 1e-6f));
}

TEST_F(ObjTest, FacesBeforeAnyMaterialAreDefaultGrey) {
    write("m.mtl", "newmtl red\nKd 1 0 0\n");
    const LoadedScene scene =
        loadObj("mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nusemtl red\nf 1 2 3\n");
    const Material& first = scene.materials[scene.geometry.materials[0]];
    EXPECT_EQ(first.name, "default");
    EXPECT_EQ(first.baseColor, glm::vec3(0.8f));
    EXPECT_EQ(scene.materials[scene.geometry.materials[1]].name, "red");
}

TEST_F(ObjTest, MissingMtlIsAWarning) {
    const LoadedScene scene =
        loadObj("mtllib none.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl brick wall \nf 1 2 3\n");
    const Material& material = scene.materials[scene.geometry.materials[0]];
    EXPECT_EQ(material.name, "brick wall");
    EXPECT_EQ(material.baseColor, glm::vec3(0.8f));
    ASSERT_GE(scene.warnings.size(), 2u);
    EXPECT_THAT(scene.warnings[0].text, HasSubstr("none.mtl: no such file"));
    EXPECT_THAT(scene.warnings[1].text, HasSubstr("\"brick wall\" is not defined"));
}

TEST_F(ObjTest, MtlFilesWithBlanksOrSeveralOnALine) {
    write("my colours.mtl", "newmtl a\nKd 1 0 0\n");
    write("b.mtl", "newmtl b\nKd 0 1 0\n");
    write("c.mtl", "newmtl c\nKd 0 0 1\n");
    const LoadedScene scene = loadObj(
        "mtllib my colours.mtl\nmtllib b.mtl c.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\n"
        "usemtl a\nf 1 2 3\nusemtl b\nf 1 2 3\nusemtl c\nf 1 2 3\n");
    const auto diffuse = [&](std::size_t i) {
        return scene.materials[scene.geometry.materials[i]].baseColor;
    };
    EXPECT_EQ(diffuse(0), glm::vec3(1, 0, 0));
    EXPECT_EQ(diffuse(1), glm::vec3(0, 1, 0));
    EXPECT_EQ(diffuse(2), glm::vec3(0, 0, 1));
}

TEST_F(ObjTest, DegenerateTrianglesAreLeftOutAndCounted) {
    const LoadedScene scene =
        loadObj("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 2 0 0\nv 1 1e-9 0\nf 1 1 2\nf 1 2 3\nf 1 2 4\nf 1 4 5\n");
    EXPECT_EQ(scene.geometry.triangles.size(), 1u + 2u);
    EXPECT_THAT(scene.warnings[0].text, HasSubstr("mesh.obj: 3 of 4 triangles left out: zero area"));
}

TEST_F(ObjTest, UnknownStatementsAreIgnoredWithAWarning) {
    const LoadedScene scene = loadObj(std::string(kTriangleObj) + "curv 0 1 1 2\nsurf 1\n");
    EXPECT_THAT(scene.warnings[0].text,
                HasSubstr("mesh.obj: line 5: \"curv\" is not supported; 2 such lines are ignored"));
}

TEST_F(ObjTest, LargeFilesAreReadInPartsThatFitTogether) {
    // Larger than several parts that are read in parallel; relative indices, materials and smoothing groups
    // extend across them.
    constexpr std::size_t kTriangles = 200'000;
    std::string text = "usemtl a\n";
    for (std::size_t i = 0; i < kTriangles; ++i) {
        if (i == kTriangles / 2) text += "usemtl b\n";
        text += fmt::format("v {0} 0.12345678 0\nv {0} 1 0\nv {0} 0 1.0000000\nf -3 -2 {1}\n", i, 3 * i + 3);
    }
    ASSERT_GT(text.size(), std::size_t{9} << 20);
    const LoadedScene scene = loadObj(text);
    ASSERT_EQ(scene.geometry.triangles.size(), kTriangles + 2);
    for (std::uint32_t i = 0; i < kTriangles; ++i) {
        ASSERT_EQ(scene.geometry.triangles[i], glm::uvec3(3 * i, 3 * i + 1, 3 * i + 2));
        ASSERT_EQ(scene.geometry.positions[3 * i].x, static_cast<float>(i));
        ASSERT_EQ(scene.materials[scene.geometry.materials[i]].name, i < kTriangles / 2 ? "a" : "b");
    }
}

TEST_F(ObjTest, ErrorsOfLargeFilesNameTheFirstWrongLine) {
    std::string text(kTriangleObj);
    for (int i = 0; i < 400'000; ++i)
        text += "vn 0.00000001 0.00000002 1.00000000\n";
    text += "v 1 2\n";
    for (int i = 0; i < 400'000; ++i)
        text += "vn 0.00000001 0.00000002 1.00000000\n";
    text += "f 1 2 9\n";
    EXPECT_THAT(errorOfObj(text, Reading::kStrict),
                StartsWith("mesh.obj: line 400005: 2 numbers; expected \"v x y z\""));
}

TEST_F(ObjTest, ErrorsCountContinuedLines) {
    EXPECT_THAT(errorOfObj("v 0 0 \\\n0\nv 1 0 0\nv 0 x 0\nf 1 2 3\n"),
                StartsWith("mesh.obj: line 4: \"x\" is not"));
}

TEST_F(ObjTest, NumbersThatAreNotDecimalAreRefused) {
    for (const char* number :
         {"nan", "inf", "-inf", "0x10", "1,5", "--1", "1e", "1e+", ".", "1.2.3", "1e99999", "e5"}) {
        const std::string error = errorOfObj(fmt::format("v 0 0 0\nv {} 0 0\nv 0 1 0\nf 1 2 3\n", number));
        EXPECT_THAT(error,
                    StartsWith(fmt::format("mesh.obj: line 2: \"{}\" is not a finite number", number)));
    }
    EXPECT_THAT(errorOfObj("v 0 0 0\nv 1e39 0 0\nv 0 1 0\nf 1 2 3\n"),
                StartsWith("mesh.obj: line 2: a coordinate is not finite or too large"));
    EXPECT_THAT(errorOfObj("v 0 0 0\nv 1e300 0 0\nv 0 1 0\nf 1 2 3\n"),
                StartsWith("mesh.obj: line 2: a coordinate"));
}

TEST_F(ObjTest, IndicesAreChecked) {
    const std::string head = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvn 0 0 1\n";
    const auto error = [&](const char* face) { return errorOfObj(head + face + "\n"); };
    EXPECT_THAT(error("f 1 2 4"),
                HasSubstr("line 6: vertex index 4 is out of range; there are 3 vertices in the file"));
    EXPECT_THAT(error("f 0 1 2"), HasSubstr("line 6: vertex index 0 is out of range"));
    EXPECT_THAT(error("f -4 1 2"),
                HasSubstr("vertex index -4 is out of range; there are 3 vertices before this line"));
    EXPECT_THAT(error("f 1 2 99999999999999999999999"), HasSubstr("is out of range"));
    EXPECT_THAT(error("f 1 2 three"), HasSubstr("\"three\" is not a corner of a face"));
    EXPECT_THAT(error("f 1 2 +-3"), HasSubstr("\"+-3\" is not a corner of a face"));
}

TEST_F(ObjTest, StrictReadingRefusesWhatDoesNotMatter) {
    const std::string head = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvn 0 0 1\nf 1 2 3\n";
    const auto error = [&](const char* line) { return errorOfObj(head + line + "\n", Reading::kStrict); };
    EXPECT_THAT(error("f 1/2 2/1 3/1"), HasSubstr("line 7: texture coordinate index 2 is out of range"));
    EXPECT_THAT(error("f 1//1 2//2 3//1"), HasSubstr("line 7: normal index 2 is out of range"));
    EXPECT_THAT(error("f 1//0 2//1 3//1"), HasSubstr("line 7: normal index 0 is out of range"));
    EXPECT_THAT(error("f 1 2"), HasSubstr("line 7: a face of 2 corners; expected at least 3"));
    EXPECT_THAT(error("f 1/ 2/ 3/"), HasSubstr("line 7: \"1/\" is not a corner of a face"));
    EXPECT_THAT(error("f 1/1/ 2/1/ 3/1/"), HasSubstr("line 7: \"1/1/\" is not a corner of a face"));
    EXPECT_THAT(error("f 1 2 3x"), HasSubstr("line 7: \"3x\" is not a corner of a face"));
    EXPECT_THAT(error("f 1 2 3 1.5"), HasSubstr("line 7: \"1.5\" is not a corner of a face"));
    EXPECT_THAT(error("f 1 2 9"), HasSubstr("line 7: vertex index 9 is out of range"));
    EXPECT_THAT(error("f 1 2 three"), HasSubstr("line 7: \"three\" is not a corner of a face"));
    EXPECT_THAT(error("v 0 0"), HasSubstr("line 7: 2 numbers; expected \"v x y z\""));
    EXPECT_THAT(error("v 0 0 0 foo"), HasSubstr("line 7: \"foo\" is not a finite number"));
    EXPECT_THAT(error("vn nan 0 0"), HasSubstr("line 7: \"nan\" is not a finite number"));
    EXPECT_THAT(error("vt 0 -1.#IND"), HasSubstr("line 7: \"-1.#IND\" is not a finite number"));
    EXPECT_THAT(error("v nan 0 0"), HasSubstr("line 7: \"nan\" is not a finite number"));
    EXPECT_THAT(error("vn 0 1"), HasSubstr("line 7: 2 numbers; expected \"vn x y z\""));
    EXPECT_THAT(error("usemtl "), HasSubstr("line 7: names no material"));
    EXPECT_THAT(error("mtllib"), HasSubstr("line 7: names no file"));
    EXPECT_THAT(error("s on"), HasSubstr("line 7: smoothing group \"on\"; expected a number or \"off\""));
}

TEST_F(ObjTest, ColoursOfVerticesScaleTheBaseColour) {
    // 188 of 255 is 0.5029 in linear light: ((188 / 255 + 0.055) / 1.055)^2.4.
    LoadedScene scene = loadObj("v 0 0 0 0.737254902 0 1\nv 1 0 0\nv 0 1 0 0.5 0 1 0.737254902\nf 1 2 3\n");
    ASSERT_GE(scene.geometry.colours.size(), 3u);
    EXPECT_THAT(scene.geometry.colours[0], IsNear(glm::vec3(0.50289f, 0, 1), 1e-4f));
    EXPECT_EQ(scene.geometry.colours[1], glm::vec3(1)) << "has none";
    EXPECT_THAT(scene.geometry.colours[2], IsNear(glm::vec3(0, 1, 0.50289f), 1e-4f)) << "after a weight";
    EXPECT_EQ(scene.materials[0].baseColor, glm::vec3(1));
    EXPECT_TRUE(loadObj(kTriangleObj).geometry.colours.empty());
    write("m.mtl", "newmtl a\nKd 0.25 0.5 0.75\n");
    scene = loadObj("mtllib m.mtl\nv 0 0 0 1 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\nf 1 2 3\nusemtl b\nf 3 2 1\n");
    EXPECT_EQ(scene.materials[0].baseColor, glm::vec3(0.25f, 0.5f, 0.75f));
    EXPECT_EQ(scene.materials[1].baseColor, glm::vec3(1));
    EXPECT_THAT(scene.warnings[0].text,
                HasSubstr("\"b\" is not defined by any MTL file: the colours of vertices are used"));
}

TEST_F(ObjTest, ColoursOfVerticesOfALongFile) {
    // Several parts are read at once; the first vertices of each have no colours.
    std::string text;
    constexpr std::size_t kFaces = 120'000;
    for (std::size_t i = 0; i < kFaces; ++i)
        text += fmt::format("v {0} 0 0\nv {0} 1 0 {1} 0 1\nv {0} 0 1\nf -3 -2 -1\n", i, i % 2);
    const Geometry geometry = load(text);
    ASSERT_GE(geometry.colours.size(), 3 * kFaces);
    for (std::size_t i = 0; i < kFaces; ++i) {
        ASSERT_EQ(geometry.colours[3 * i], glm::vec3(1)) << i;
        ASSERT_EQ(geometry.colours[3 * i + 1], glm::vec3(i % 2, 0, 1)) << i;
    }
}

TEST_F(ObjTest, FilesWithoutFacesAreRefused) {
    EXPECT_THAT(errorOfObj(""), StartsWith("mesh.obj: has no faces"));
    EXPECT_THAT(errorOfObj("v 0 0 0\n"), StartsWith("mesh.obj: has no faces"));
    EXPECT_THAT(errorOfObj("v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n"),
                StartsWith("mesh.obj: every triangle has zero area"));
    EXPECT_THAT(errorOfObj("v 0 0 0\nv 1 0 0\nf 1 2\n"), StartsWith("mesh.obj: has no faces"));
    EXPECT_THAT(errorOfObj(std::string("v 0 0 0\n\0x", 10)),
                StartsWith("mesh.obj: line 2: holds a zero byte"));
}

TEST_F(ObjTest, OtherExtensionsAreRefused) {
    write("mesh.fbx", kTriangleObj);
    EXPECT_EQ(errorOf("mesh.fbx"),
              "mesh.fbx: has no extension of a scene file; expected .obj, .ply, .stl, .gltf, .glb or .json");
    EXPECT_THAT(errorOf("none.obj"), StartsWith("none.obj: cannot open: No such file"));
}

}  // namespace
}  // namespace duolux::test

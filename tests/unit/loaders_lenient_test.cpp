// Files that other programs write and load, even if they are incorrect.
#include <fmt/format.h>

#include <string>

#include "tests/unit/scene_files.h"

namespace duolux::test {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

class LenientTest : public SceneFiles {
  protected:
    /// The warnings for a square (1 2 3 4) and more statements, without the one of the lamp.
    std::vector<std::string> warningsOf(const std::string& more) const {
        return withoutLight(textsOf(loadObj("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n" + more).warnings));
    }

    std::vector<std::string> withoutLight(std::vector<std::string> warnings) const {
        const std::string prefix = folder_.string() + "/";
        std::vector<std::string> rest;
        for (std::string& warning : warnings) {
            if (warning.find("nothing emits") != std::string::npos) continue;
            rest.push_back(warning.starts_with(prefix) ? warning.substr(prefix.size()) : warning);
        }
        return rest;
    }

    std::size_t smoothTriangles(const std::string& text) const {
        const Geometry geometry = loadObj(text).geometry;
        std::size_t count = 0;
        for (const glm::uvec3& normals : geometry.normalIndices)
            count += normals.x != Geometry::kNoNormal ? 1 : 0;
        return count;
    }
};

TEST_F(LenientTest, NormalsThatAreNotThereLeaveTrianglesFlat) {
    EXPECT_THAT(warningsOf("f 1//1 2//2 3//3 4//4\n"),
                ElementsAre("mesh.obj: line 5: a normal index that is 0 or out of range (and 3 more): such "
                            "triangles are flat"));
    EXPECT_EQ(warningsOf("vn 0 0 1\nf 1//0 2//1 3//1\nf 1//1 3//-2 4//99999999999\n").size(), 1u);
    const std::string square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";
    EXPECT_EQ(smoothTriangles(square + "vn 0 0 1\nf 1//0 2//1 3//1\nf 1//1 3//1 4//1\n"), 1u);
    EXPECT_EQ(smoothTriangles(square + "vn nan nan nan\nvn 0 0 1\nf 1//2 2//2 3//2\nf 1//1 3//1 4//1\n"), 1u);
}

TEST_F(LenientTest, NormalsAndTextureCoordinatesThatAreNoNumbers) {
    EXPECT_THAT(
        warningsOf(
            "vn nan 0 0\nvn 0 1\nvn 0 0 x\nvn 0 0 1 0\nvt\nvt u v\nvt 0 -1.#IND\nvt 1 2 3 4\nf 1 2 3\n"),
        ElementsAre(HasSubstr("line 8: more numbers than the statement has: the last"),
                    HasSubstr("line 5: a normal that is not three finite numbers (and 2 more): "),
                    HasSubstr("line 9: a texture coordinate that is not one to three finite numbers, "
                              "or too large (and 3 more): triangles that name it have none")));
}

TEST_F(LenientTest, TextureCoordinatesAreNotUsed) {
    EXPECT_THAT(
        warningsOf("f 1/1 2/0 3/-1\n"),
        ElementsAre(HasSubstr("line 5: a texture coordinate index that is 0 or out of range (and 2 more)")));
}

TEST_F(LenientTest, CornersMayEndInASlash) {
    for (const char* face : {"f 1/ 2/ 3/", "f 1// 2// 3//", "vt 0 0\nf 1/1/ 2/1/ 3/1/"}) {
        const LoadedScene scene = loadObj("v 0 0 0\nv 1 0 0\nv 0 1 0\n" + std::string(face));
        EXPECT_EQ(scene.geometry.triangles[0], glm::uvec3(0, 1, 2));
        EXPECT_THAT(scene.warnings[0].text,
                    HasSubstr("a corner that ends in \"/\" (and 2 more): read without it"));
    }
}

TEST_F(LenientTest, CornersAreReadAsFarAsTheyAreNumbers) {
    const std::string head = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvn 0 0 1\n";
    for (const char* face : {"1/1// 2/1// 3/1//", "1/1/1/1 2/1/1/1 3/1/1/1", "1.0 2.0 3.0", "1/// 2/// 3///",
                             "1, 2, 3,", "1 , 2 , 3 ,", "1,2,3,", "1.0/1.0/1.0 2.0/1.0/1.0 3.0/1.0/1.0"}) {
        const LoadedScene scene = loadObj(head + "f " + face + "\n");
        EXPECT_EQ(scene.geometry.triangles[0], glm::uvec3(0, 1, 2)) << face;
        EXPECT_THAT(
            withoutLight(textsOf(scene.warnings)),
            ElementsAre("mesh.obj: line 6: a corner with more than v/vt/vn, as in 1.0 or 1/1/1/1 (and 2 "
                        "more): the rest is ignored"))
            << face;
    }
    for (const char* face :
         {"+1 +2 +3", "1 2 3#4", "1 2 3 \x1A", "1 2 3\n\x1A\r\n", "1\xA0 2\xA0 3", "1\f2\v3",
          "1\xC2\xA0"
          "2\xC2\xA0"
          "3",
          "1 \\ \n2 \\\t\r\n3", "1 2 3 \\", "1 2 3\\"}) {
        const LoadedScene scene = loadObj(head + "f " + face);
        EXPECT_EQ(scene.geometry.triangles[0], glm::uvec3(0, 1, 2)) << face;
        EXPECT_THAT(withoutLight(textsOf(scene.warnings)), IsEmpty()) << face;
    }
}

TEST_F(LenientTest, FacesWithoutTheirVerticesAreLeftOut) {
    const std::string head = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\n";
    const LoadedScene scene =
        loadObj(head + "usemtl a\nf 1//1 2//1 9//1\nf 1 2 0\nusemtl b\nf 1//1 2//1 3//1\nf a b c\n");
    EXPECT_EQ(scene.geometry.triangles.size(), 1u + 2u);
    EXPECT_EQ(scene.materials[scene.geometry.materials[0]].name, "b");
    EXPECT_EQ(scene.geometry.normalIndices[0], glm::uvec3(0, 0, 0));
    EXPECT_THAT(
        withoutLight(textsOf(scene.warnings)),
        Contains(
            "mesh.obj: line 6: a face with a vertex index that is 0, out of range or not a number (and 2 "
            "more): left out"));
    EXPECT_EQ(errorOfObj(head + "f 1 2 9\nf 1 2 0\n"),
              "mesh.obj: line 5: vertex index 9 is out of range; there are 3 vertices in the file");
}

TEST_F(LenientTest, NamesKeepTheirBackslashes) {
    for (const char* name : {"g back\\", "usemtl C:\\textures\\", "o a b\\"}) {
        const LoadedScene scene = loadObj("v 0 0 0\nv 1 0 0\nv 0 1 0\n" + std::string(name) + "\nf 1 2 3\n");
        EXPECT_EQ(scene.geometry.triangles.size(), 1u + 2u) << name;
    }
    write("a.mtl", "newmtl a\nKd 1 0 0\n");
    EXPECT_THAT(warningsOf("mtllib a.mtl \\\n b.mtl\nusemtl a\nf 1 2 3\n"),
                ElementsAre(HasSubstr("b.mtl: no such file")));
}

TEST_F(LenientTest, FacesOfFewerThanThreeCornersAreLeftOut) {
    EXPECT_THAT(warningsOf("vn 0 0 1\nf 1//1\nf\nf 1 2\nf 1 9\nf 1 2 3\n"),
                ElementsAre("mesh.obj: line 6: a face of fewer than 3 corners (and 3 more): left out"));
    const LoadedScene scene = loadObj("v 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\nf 1 2\nusemtl b\nf 1 2 3\n");
    EXPECT_EQ(scene.materials[scene.geometry.materials[0]].name, "b");
}

TEST_F(LenientTest, AnEmptyMaterialSlotIsDefaultGrey) {
    write("m.mtl", "newmtl red\nKd 1 0 0\n");
    const LoadedScene scene =
        loadObj("mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl red\nf 1 2 3\nusemtl \nf 1 2 3\n");
    EXPECT_EQ(scene.materials[scene.geometry.materials[0]].name, "red");
    EXPECT_EQ(scene.materials[scene.geometry.materials[1]].name, "default");
    EXPECT_THAT(withoutLight(textsOf(scene.warnings)),
                ElementsAre("mesh.obj: line 7: usemtl without a name: its faces are grey 0.8"));
}

TEST_F(LenientTest, SmoothingByWords) {
    const std::string square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";
    EXPECT_EQ(smoothTriangles(square + "s on\nf 1 2 3 4\n"), 2u);
    EXPECT_EQ(smoothTriangles(square + "s off\nf 1 2 3 4\n"), 0u);
    EXPECT_EQ(smoothTriangles(square + "s null\nf 1 2 3 4\n"), 0u);
    EXPECT_THAT(warningsOf("s on\ns off\ns 1\ns\nf 1 2 3\n"),
                ElementsAre(HasSubstr("line 5: a smoothing group that is")));
}

TEST_F(LenientTest, VerticesThatNoFaceUsesMayBeAnything) {
    const LoadedScene scene =
        loadObj("v 0 0 0\nv 1 0 0\nv nan 0 0\nv 0 1 0\nv 1e300 0 0\nv -1.#IND 0 0\nf 1 2 4\n");
    EXPECT_THAT(withoutLight(textsOf(scene.warnings)),
                ElementsAre("mesh.obj: line 3: a vertex that is not three finite numbers, or too large (and "
                            "2 more): no face uses it"));
    for (const glm::vec3& position : scene.geometry.positions)
        EXPECT_LE(glm::length(position), 10.0f);
}

TEST_F(LenientTest, FacesWithVerticesThatAreNoNumbersAreLeftOut) {
    const std::string head =
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 nan 0\nv 5 5\nvn 0 0 1\nvn 0 1 0\nvt 0 0\nvt 1 1\n";
    const LoadedScene scene = loadObj(head +
                                      "usemtl a\nf 1//1 2//1 4//1\ns 1\nf 1/1 2/1 3/2\nusemtl b\n"
                                      "f 3/1/2 2/1/2 1/2/2\nf 1/2/1 4/2/1 2/2/1 3/2/1\ns off\nusemtl c\n"
                                      "f 1 3 2\nf 1 2 5\nusemtl d\n");
    EXPECT_THAT(withoutLight(textsOf(scene.warnings)),
                Contains("mesh.obj: line 4: a vertex that is not three finite numbers: 3 faces with "
                         "such vertices are left out"));
    const Geometry& geometry = scene.geometry;
    ASSERT_GE(geometry.triangles.size(), 3u);
    const char* const names[] = {"a", "b", "c"};
    for (std::size_t i = 0; i < 3; ++i)
        EXPECT_EQ(scene.materials[geometry.materials[i]].name, names[i]);
    const auto corner = [&](std::size_t triangle, int k) {
        return geometry.positions[geometry.triangles[triangle][k]];
    };
    EXPECT_EQ(corner(0, 1), glm::vec3(1.0f, 0.0f, 0.0f));
    EXPECT_EQ(corner(1, 0), glm::vec3(0.0f, 1.0f, 0.0f));
    EXPECT_EQ(corner(2, 1), glm::vec3(0.0f, 1.0f, 0.0f));
    EXPECT_EQ(geometry.normals[geometry.normalIndices[1].x], glm::vec3(0.0f, 1.0f, 0.0f));
    EXPECT_NE(geometry.normalIndices[0].x, Geometry::kNoNormal) << "of the smoothing group";
    EXPECT_EQ(geometry.normalIndices[2].x, Geometry::kNoNormal);
    ASSERT_GE(geometry.uvIndices.size(), 3u);
    EXPECT_EQ(geometry.uvs[geometry.uvIndices[0].z].x, 1.0f);
    EXPECT_EQ(geometry.uvs[geometry.uvIndices[1].z].x, 1.0f);
    EXPECT_EQ(geometry.uvIndices[2].x, Geometry::kNoUv);

    EXPECT_THAT(warningsOf("v inf 0 0\nf 1 2 3\nf 1 2 5\n"),
                ElementsAre("mesh.obj: line 5: a vertex that is not three finite numbers: 1 face with such "
                            "vertices is left out"));
    EXPECT_EQ(errorOfObj("v 0 0 0\nv 1 0 0\nv 0 nan 0\nf 1 2 3\n"),
              "mesh.obj: line 3: \"nan\" is not a finite number; expected \"v x y z\"");
    EXPECT_THAT(errorOfObj("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 nan 0\nf 1 2 3\nf 1 2 4\n", Reading::kStrict),
                HasSubstr("line 4: \"nan\" is not a finite number"));
}

TEST_F(LenientTest, NumbersThatAreNotUsedMayBeAnything) {
    const std::string extra = "mesh.obj: line 5: extra values that are not finite numbers: ignored";
    EXPECT_THAT(warningsOf("v 0 0 0 nan nan nan\nf 5 2 3\n"), ElementsAre(extra));
    EXPECT_THAT(warningsOf("v 0 0 0 foo\nf 5 2 3\n"), ElementsAre(extra));
    EXPECT_THAT(
        warningsOf("v foo 0 0\nv 5 5\nv\nf 1 2 3\n"),
        ElementsAre("mesh.obj: line 5: a vertex that is not three finite numbers, or too large (and 2 "
                    "more): no face uses it"));
    EXPECT_EQ(errorOfObj("v 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"),
              "mesh.obj: line 1: 2 numbers; expected \"v x y z\"");
    EXPECT_EQ(smoothTriangles("v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1 nan\nf 1//1 2//1 3//1\n"), 1u);
}

TEST_F(LenientTest, CommentsMayFollowNumbersAtOnce) {
    EXPECT_THAT(warningsOf("v 0 0 2#c\nvn 0 0 1#c\nvt 0 0#c\nf 5/1/1 2/1/1 3/1/1#c\n"), IsEmpty());
    EXPECT_THAT(warningsOf("v 0 0 1.#INF\nv 0 0 -1.#IND00\nf 1 2 3\n"),
                ElementsAre(HasSubstr("(and 1 more)")));
    write("m.mtl", "newmtl a\nKd 1 0 0.5#c\n");
    EXPECT_EQ(loadObj("mtllib m.mtl\nusemtl a\n" + std::string(kTriangleObj)).materials[0].baseColor,
              glm::vec3(1, 0, 0.5f));
}

TEST_F(LenientTest, WeightsOfVerticesAreNotUsed) {
    EXPECT_THAT(warningsOf("v 0 0 2 2\nv 0 0 2 1\nf 5 2 3\n"),
                ElementsAre("mesh.obj: line 5: a vertex with a weight w other than 1: w is not used"));
    EXPECT_THAT(warningsOf("v 0 0 2 0.5 1 1 1\nf 5 2 3\n").size(), 1u) << "with a colour";
}

TEST_F(LenientTest, ColoursOfVerticesBeyondTheirRangeAreClamped) {
    EXPECT_THAT(
        withoutLight(
            textsOf(loadObj("v 0 0 0 255 0 0\nv 1 0 0 1 0 0\nv 0 1 0 1 -0.5 0\nf 1 2 3\n").warnings)),
        ElementsAre("mesh.obj: line 1: a vertex whose colour is not between 0 and 1 (and 1 more): clamped"));
}

TEST_F(LenientTest, ZeroBytesAtTheEndAndBackslashesInCommentsDoNotMatter) {
    const LoadedScene scene =
        loadObj("# C:\\models\\\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n" + std::string(16, '\0'));
    EXPECT_EQ(scene.geometry.positions[1], glm::vec3(1, 0, 0));
}

TEST_F(LenientTest, LibrariesAreFoundAsTheyWereMeant) {
    std::filesystem::create_directory(folder_ / "materials");
    write("materials/red.mtl", "newmtl red\nKd 1 0 0\n");
    write("Beside.mtl", "newmtl red\nKd 1 0 0\n");
    for (const char* name : {".\\materials\\red.mtl", "materials\\Red.MTL", "\"materials/red.mtl\"",
                             "beside.mtl", "C:\\work\\beside.mtl", "/no/such/folder/Beside.mtl"}) {
        const LoadedScene scene = loadObj(fmt::format("mtllib {}\nusemtl red\n{}", name, kTriangleObj));
        EXPECT_EQ(scene.materials[scene.geometry.materials[0]].baseColor, glm::vec3(1, 0, 0)) << name;
    }
}

TEST_F(LenientTest, MissingLibrariesSuggestTheOneBeside) {
    write("cornell_box.mtl", "newmtl red\nKd 1 0 0\n");
    const auto warning = [&](const char* lines) {
        return withoutLight(textsOf(loadObj(std::string(lines) + std::string(kTriangleObj)).warnings)).at(0);
    };
    EXPECT_EQ(warning("mtllib cornellbox.mtl\n"),
              "cornellbox.mtl: no such file: its materials are grey; did you mean \"cornell_box.mtl\"?");
    EXPECT_EQ(warning("mtllib quite different.mtl\nmtllib b.mtl c.mtl\n"),
              "quite different.mtl: no such file: its materials are grey (2 more MTL files are missing)");
}

TEST_F(LenientTest, FilesOfAnotherKindAreCalledWhatTheyAre) {
    const std::string lfs = "version https://git-lfs.github.com/spec/v1\noid sha256:ab\nsize 12\n";
    EXPECT_EQ(errorOfObj(lfs),
              "mesh.obj: is a Git LFS pointer; expected the file itself, which \"git lfs pull\" fetches");
    EXPECT_THAT(errorOfJson(lfs), StartsWith("scene.json: is a Git LFS pointer; "));
    EXPECT_EQ(errorOfObj("ply\nformat ascii 1.0\n"), "mesh.obj: is PLY; expected a Wavefront OBJ file");
    EXPECT_THAT(errorOfObj("solid part\n facet normal 0 0 1\n"), StartsWith("mesh.obj: is STL; "));
    std::string stl(84 + 50, '\0');
    stl[80] = 1;
    EXPECT_THAT(errorOfObj(stl), StartsWith("mesh.obj: is STL; "));
    EXPECT_THAT(errorOfObj("{\"asset\": {\"version\": \"2.0\"}}"), StartsWith("mesh.obj: is glTF; "));
    EXPECT_THAT(errorOfJson("{\"asset\": {\"version\": \"2.0\"}}"),
                StartsWith("scene.json: is glTF; expected a JSON scene"));
    EXPECT_THAT(errorOfObj("{\"duolux\": 1}"), StartsWith("mesh.obj: is JSON; "));
    EXPECT_THAT(errorOfObj(std::string("PK\x03\x04\0\0", 6)), StartsWith("mesh.obj: is a zip archive; "));
    EXPECT_THAT(errorOfObj("\x1F\x8B\x08"), StartsWith("mesh.obj: is compressed by gzip; "));
    EXPECT_THAT(errorOfObj("\n<!DOCTYPE html>\n"), StartsWith("mesh.obj: is an HTML page; "));
    EXPECT_THAT(errorOfObj(std::string("\xFF\xFEv\0", 4)), StartsWith("mesh.obj: is UTF-16 text; "));
    const auto kindOf = [&](const std::string& text) {
        const std::string error = errorOfObj(text);
        return error.substr(0, error.find(';'));
    };
    EXPECT_EQ(kindOf("OFF 3 1 0\n0 0 0\n"), "mesh.obj: is OFF");
    EXPECT_EQ(kindOf("ply \nformat ascii 1.0\n"), "mesh.obj: is PLY");
    EXPECT_EQ(kindOf("  0\r\nSECTION\r\n  2\r\nHEADER\r\n"), "mesh.obj: is DXF");
    EXPECT_EQ(kindOf("999\nby foo\n0\nSECTION\n"), "mesh.obj: is DXF");
    EXPECT_EQ(kindOf("../../.git/annex/objects/1/2/SHA256E-s3--ab.obj\n"),
              "mesh.obj: is a git-annex pointer");
    EXPECT_EQ(kindOf("/annex/objects/SHA256E-s3--ab.obj\n"), "mesh.obj: is a git-annex pointer");
    EXPECT_EQ(kindOf("#VRML V2.0 utf8\n"), "mesh.obj: is VRML");
    EXPECT_EQ(kindOf("# .PCD v0.7 - Point Cloud\n"), "mesh.obj: is a PCD point cloud");
    EXPECT_EQ(kindOf(std::string("v\0 \0001\0 \0002\0", 10)), "mesh.obj: is UTF-16 text");
    EXPECT_EQ(kindOf(std::string("\0v\0 \0001\0 \0002", 10)), "mesh.obj: is UTF-16 text");
    write("m.mtl", lfs);
    EXPECT_THAT(withoutLight(textsOf(loadObj("mtllib m.mtl\n" + std::string(kTriangleObj)).warnings)),
                ElementsAre(HasSubstr("m.mtl: is a Git LFS pointer; ")));
}

TEST_F(LenientTest, CommentsAndNamesDoNotMakeAFileForeign) {
    for (const char* comment : {"# .pcd to obj by foo\n", "#VRML2OBJ export\n", "# ply\n", "o off\n"})
        EXPECT_EQ(loadObj(comment + std::string(kTriangleObj)).content.triangles, 1u) << comment;
    write("asset.obj", "usemtl asset\n" + std::string(kTriangleObj));
    EXPECT_EQ(
        loadJson(
            R"({"materials": {"asset": {"diffuse": 0.5}}, "duolux": 1, "objects": [{"mesh": "asset.obj"}]})")
            .materials[0]
            .baseColor,
        glm::vec3(0.5f));
}

}  // namespace
}  // namespace duolux::test

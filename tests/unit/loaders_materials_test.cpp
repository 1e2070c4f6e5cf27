// The materials of faces in OBJ files.
#include <fmt/format.h>

#include <ctime>
#include <string>

#include "tests/unit/scene_files.h"

namespace duolux::test {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

class MaterialsTest : public SceneFiles {
  protected:
    static constexpr const char* kVertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

    /// The material of the first triangle.
    const Material materialOf(const std::string& statements) const {
        const LoadedScene scene = loadObj(statements + "\n" + std::string(kTriangleObj));
        return scene.materials[scene.geometry.materials[0]];
    }

    LoadedScene timed(const std::string& name) const {
        const std::clock_t start = std::clock();
        LoadedScene scene = load(name);
        EXPECT_LT(static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC, 2.0);
        return scene;
    }
};

TEST_F(MaterialsTest, FacesWithoutOneAreGreyWhateverTheFileCallsDefault) {
    write("m.mtl", "newmtl default\nKd 1 0 0\n");
    const LoadedScene scene =
        loadObj("mtllib m.mtl\n" + std::string(kTriangleObj) + "usemtl default\nf 1 2 3\n");
    EXPECT_EQ(scene.materials[scene.geometry.materials[0]].baseColor, glm::vec3(0.8f));
    EXPECT_EQ(scene.materials[scene.geometry.materials[1]].baseColor, glm::vec3(1, 0, 0));
}

TEST_F(MaterialsTest, NamesWithCommentsAndQuotes) {
    const auto expectRed = [&](const char* defined, const char* used, const char* name) {
        write("m.mtl", fmt::format("newmtl {}\nKd 1 0 0\n", defined));
        const Material material = materialOf(fmt::format("mtllib m.mtl\nusemtl {}", used));
        EXPECT_EQ(material.baseColor, glm::vec3(1, 0, 0)) << defined << " " << used;
        EXPECT_EQ(material.name, name);
    };
    expectRed("red # c", "red", "red");
    expectRed("red", "red # c", "red");
    expectRed("\"my red\"", "my red", "my red");
    expectRed("my red", "\"my red\"", "my red");
    expectRed("Material #25", "Material #25", "Material #25");
    write("m.mtl", "newmtl Material #25\nKd 1 0 0\nnewmtl Material #26\nKd 0 1 0\n");
    EXPECT_EQ(materialOf("mtllib m.mtl\nusemtl Material #26").baseColor, glm::vec3(0, 1, 0));
}

TEST_F(MaterialsTest, LibrariesWithCommentsQuotesAndWithoutExtension) {
    write("m.mtl", "newmtl red\nKd 1 0 0\n");
    write("x y.mtl", "newmtl green\nKd 0 1 0\n");
    for (const char* names :
         {"m.mtl # comment", "\"m.mtl\" \"x y.mtl\"", "m", "M", "\"m\" # c", "sub\\m", "none.mtl m.mtl"}) {
        EXPECT_EQ(materialOf(fmt::format("mtllib {}\nusemtl red", names)).baseColor, glm::vec3(1, 0, 0))
            << names;
    }
    EXPECT_EQ(materialOf("mtllib \"m.mtl\" \"x y.mtl\"\nusemtl green").baseColor, glm::vec3(0, 1, 0));
    EXPECT_EQ(materialOf("mtllib x y.mtl # both\nusemtl green").baseColor, glm::vec3(0, 1, 0));
}

TEST_F(MaterialsTest, ALibraryThatCannotBeReadLeavesGrey) {
    write("m.mtl", std::string("newmtl red\nKd \0 0 0\n", 20));
    const LoadedScene scene = loadObj("mtllib m.mtl\nusemtl red\n" + std::string(kTriangleObj));
    EXPECT_EQ(scene.materials[scene.geometry.materials[0]].baseColor, glm::vec3(0.8f));
    EXPECT_THAT(textsOf(scene.warnings),
                Contains(HasSubstr("m.mtl: line 2: holds a zero byte; expected a text file: its "
                                   "materials are grey")));
}

TEST_F(MaterialsTest, ColoursThatAreTooLargeMatterOnlyWhereTheyAreUsed) {
    write("m.mtl", "newmtl sun\nKe 1e300 1 1\nnewmtl snow\nKd 1e13 1 1\nnewmtl red\nKd 1 0 0\n");
    EXPECT_EQ(materialOf("mtllib m.mtl\nusemtl sun\nusemtl red").baseColor, glm::vec3(1, 0, 0));
    EXPECT_EQ(errorOfObj("mtllib m.mtl\nusemtl snow\n" + std::string(kTriangleObj)),
              "m.mtl: line 4: Kd: too large; expected numbers from 0 to 1e+12");
    EXPECT_THAT(errorOfObj("mtllib m.mtl\nusemtl red\n" + std::string(kTriangleObj), Reading::kStrict),
                StartsWith("m.mtl: line 2: Ke: too large"));
}

TEST_F(MaterialsTest, StrictReadingRefusesWhatIsNotThere) {
    write("m.mtl", "newmtl red\nKd 1 0 0\n");
    const auto error = [&](const std::string& head) {
        return errorOfObj(head + std::string(kTriangleObj), Reading::kStrict);
    };
    EXPECT_EQ(error("mtllib n.mtl\n"), "n.mtl: no such file; did you mean \"m.mtl\"?");
    EXPECT_EQ(error("mtllib quite_different.mtl\n"),
              "quite_different.mtl: no such file; expected the MTL file that mesh.obj names");
    EXPECT_EQ(error("mtllib m.mtl\nusemtl blue\n"),
              "mesh.obj: material \"blue\" is not defined by any MTL file; expected a newmtl of that name");
    write("m.mtl", "newmtl red\nKd 1 0 0\nnewmtl red\nKd 0 1 0\n");
    EXPECT_EQ(error("mtllib m.mtl\nusemtl red\n"),
              "m.mtl: line 3: material \"red\" is defined again; expected names that differ");
}

TEST_F(MaterialsTest, WarningsAreShort) {
    const LoadedScene scene =
        loadObj("mtllib " + std::string(1 << 20, 'x') + ".mtl\n" + std::string(kTriangleObj));
    EXPECT_LT(scene.warnings.at(0).text.size(), 1100u);
    EXPECT_THAT(scene.warnings[0].text, HasSubstr("no such file"));
}

TEST_F(MaterialsTest, MaterialsThatNoFaceHasAreLeftOutButMayBeNamed) {
    write("m.mtl", "newmtl red\nKd 1 0 0\nnewmtl blue\nKd 0 0 1\n");
    write("mesh.obj", "mtllib m.mtl\nusemtl empty\nusemtl red\n" + std::string(kTriangleObj));
    const LoadedScene scene =
        loadJson(R"({"duolux": 1, "objects": [{"mesh": "mesh.obj"}, {"mesh": "./mesh.obj"}],
        "materials": {"blue": {"diffuse": 0.5}, "empty": {}, "red": {"diffuse": 0.25}}})");
    ASSERT_EQ(scene.materials[0].baseColor, glm::vec3(0.25f));
    EXPECT_EQ(scene.content.materials, 1u);
    EXPECT_THAT(textsOf(scene.warnings),
                Contains(HasSubstr("scene.json: materials.blue (and 1 more): no face has this material")));
    EXPECT_THAT(scene.files, testing::SizeIs(3)) << "the mesh is read once";
    EXPECT_THAT(errorOfJson(R"({"duolux": 1, "objects": [{"mesh": "mesh.obj"}],
                               "materials": {"blue": {"diffuse": 2}}})"),
                HasSubstr("materials.blue.diffuse: is 2"));
    EXPECT_THAT(errorOfJson(R"({"duolux": 1, "objects": [{"mesh": "mesh.obj"}], "materials": {"bleu": {}}})"),
                HasSubstr("did you mean \"blue\"?"));
}

TEST_F(MaterialsTest, TimeIsThatOfWhatIsUsed) {
    std::string library;
    for (int i = 0; i < 10'000; ++i)
        library += fmt::format("newmtl m{}\nKd 1 0 0\nmap_Kd a.png\n", i);
    write("m.mtl", library);
    std::string copies, objects;
    for (int i = 0; i < 200; ++i) {
        write(fmt::format("{}.obj", i), fmt::format("mtllib m.mtl\nusemtl m{}\n{}", i, kTriangleObj));
        objects += fmt::format("{}{{\"mesh\": \"{}.obj\"}}", i == 0 ? "" : ",", i);
    }
    for (int i = 0; i < 5'000; ++i)
        copies += ", {\"mesh\": \"0.obj\"}";
    write("scene.json", R"({"duolux": 1, "objects": [)" + objects + copies + "]}");
    const LoadedScene scene = timed("scene.json");
    EXPECT_EQ(scene.content.materials, 200u);
    EXPECT_EQ(scene.content.triangles, 5'200u);
    std::size_t missing = 0;
    for (const std::string& warning : textsOf(scene.warnings))
        missing += warning.find("there is no image") != std::string::npos ? 1 : 0;
    EXPECT_EQ(missing, 1u) << "once for the file";
}

TEST_F(MaterialsTest, MissingLibrariesAmongManyFiles) {
    std::string lines;
    for (int i = 0; i < 1'500; ++i) {
        write(fmt::format("library number {}.mtl", i), "newmtl a\n");
        lines += fmt::format("mtllib Library Number {}x.mtl\n", i);
    }
    write("mesh.obj", lines + std::string(kTriangleObj));
    EXPECT_THAT(textsOf(timed("mesh.obj").warnings), Contains(HasSubstr("1499 more MTL files are missing")));
}

}  // namespace
}  // namespace duolux::test

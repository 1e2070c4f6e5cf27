#include <fmt/format.h>

#include "host/scene/mtl.h"
#include "tests/unit/scene_files.h"

namespace duolux::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

class MtlTest : public SceneFiles {
  protected:
    MaterialLibrary load(std::string_view text) const { return loadMtl(write("m.mtl", text)); }

    std::string errorOfMtl(std::string_view text) const {
        write("m.mtl", text);
        return errorOfObj("mtllib m.mtl\n" + std::string(kTriangleObj));
    }
};

TEST_F(MtlTest, ReadsDiffuseAndEmission) {
    const MaterialLibrary library =
        load("newmtl lamp\n  Kd 0.1 .2 3e-1\nKe 1 2 3.5 # bright\nNs 10\nillum 2\n");
    ASSERT_EQ(library.materials.size(), 1u);
    const Material& material = library.materials[0];
    EXPECT_EQ(material.name, "lamp");
    EXPECT_EQ(material.diffuse, glm::vec3(0.1f, 0.2f, 0.3f));
    EXPECT_EQ(material.emission.invisible, glm::vec3(1.0f, 2.0f, 3.5f));
    EXPECT_EQ(material.emission.visible, glm::vec3(1.0f, 2.0f, 3.5f));
    EXPECT_EQ(material.emission.sides, Sides::kFront);
    EXPECT_EQ(material.sides, Sides::kBoth);
    EXPECT_FALSE(material.reflectance.has_value());
    EXPECT_THAT(library.warnings, IsEmpty());
}

TEST_F(MtlTest, AbsentDiffuseIsGreyButBlackIsBlack) {
    const MaterialLibrary library = load("newmtl absent\nKs 1 1 1\nnewmtl black\nKd 0 0 0\n");
    EXPECT_EQ(library.materials[0].diffuse, glm::vec3(0.8f));
    EXPECT_EQ(library.materials[1].diffuse, glm::vec3(0.0f));
}

TEST_F(MtlTest, NamesMayHoldBlanksAndLinesEndInCrLf) {
    const MaterialLibrary library = load("newmtl  old brick \r\nKd 1 0 0\r\n\r\nnewmtl b\r\nKd 0 1 0\r\n");
    ASSERT_EQ(library.materials.size(), 2u);
    EXPECT_EQ(library.materials[0].name, "old brick");
    EXPECT_EQ(library.materials[0].diffuse, glm::vec3(1, 0, 0));
    EXPECT_EQ(library.materials[1].diffuse, glm::vec3(0, 1, 0));
}

TEST_F(MtlTest, ReflectingMoreThanAllIsAWarning) {
    const MaterialLibrary library = load("newmtl a\nKd 1 1.5 1\n");
    EXPECT_EQ(library.materials[0].diffuse.y, 1.5f);
    EXPECT_THAT(library.warnings, ElementsAre(HasSubstr("m.mtl: line 2: Kd of \"a\" is above 1")));
}

TEST_F(MtlTest, SecondDefinitionAndTexturesAreWarnings) {
    const MaterialLibrary library = load("newmtl a\nKd 1 0 0\nmap_Kd -s 2 2 wood.png\nnewmtl a\nKd 0 1 0\n");
    ASSERT_EQ(library.materials.size(), 1u);
    EXPECT_EQ(library.materials[0].diffuse, glm::vec3(1, 0, 0));
    EXPECT_THAT(library.warnings,
                ElementsAre(HasSubstr("\"a\" is defined again"), HasSubstr("textures are not read")));
}

TEST_F(MtlTest, ErrorsNameTheLine) {
    EXPECT_THAT(errorOfMtl("newmtl a\nKd red\n"),
                StartsWith("m.mtl: line 2: Kd: \"red\" is not a finite number"));
    EXPECT_THAT(errorOfMtl("newmtl a\n\nKe 1 2\n"),
                StartsWith("m.mtl: line 3: Ke: 2 numbers; expected \"Ke r g b\""));
    EXPECT_THAT(errorOfMtl("newmtl a\nKd\n"), StartsWith("m.mtl: line 2: Kd: 0 numbers"));
    EXPECT_THAT(errorOfMtl("newmtl a\nKd 1 1 1 1\n"), StartsWith("m.mtl: line 2: Kd: 4 numbers"));
    EXPECT_THAT(errorOfMtl("newmtl a\nKd 0.5 -0.5 0.5\n"), StartsWith("m.mtl: line 2: Kd: -0.5 is negative"));
    EXPECT_THAT(errorOfMtl("newmtl a\nKe nan 0 0\n"),
                StartsWith("m.mtl: line 2: Ke: \"nan\" is not a finite number"));
    EXPECT_THAT(errorOfMtl("newmtl a\nKe 1e300 0 0\n"), StartsWith("m.mtl: line 2: Ke: too large"));
    EXPECT_THAT(errorOfMtl("Kd 1 1 1\nnewmtl a\n"), StartsWith("m.mtl: line 1: Kd before any newmtl"));
    EXPECT_THAT(errorOfMtl("newmtl\nKd 1 1 1\n"), StartsWith("m.mtl: line 1: names no material"));
}

TEST_F(MtlTest, EmptyFileIsAWarning) {
    EXPECT_THAT(load("# nothing\n").warnings, ElementsAre(HasSubstr("m.mtl: defines no material")));
}

}  // namespace
}  // namespace duolux::test

#include <fmt/format.h>

#include "host/loaders/mtl.h"
#include "tests/unit/scene_files.h"

namespace duolux::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

class MtlTest : public SceneFiles {
  protected:
    MaterialLibrary load(std::string_view text) const {
        FileFinder finder;
        return loadMtl(write("m.mtl", text), finder);
    }

    std::string errorOfMtl(std::string_view text) const {
        write("m.mtl", text);
        return errorOfObj("mtllib m.mtl\n" + std::string(kTriangleObj), Reading::kStrict);
    }
};

TEST_F(MtlTest, ReadsDiffuseAndEmission) {
    const MaterialLibrary library =
        load("newmtl lamp\n  Kd 0.1 .2 3e-1\nKe 1 2 3.5 # bright\nNs 10\nillum 2\n");
    ASSERT_EQ(library.materials.size(), 1u);
    const Material& material = library.materials[0];
    EXPECT_EQ(material.name, "lamp");
    EXPECT_EQ(material.baseColor, glm::vec3(0.1f, 0.2f, 0.3f));
    EXPECT_EQ(material.emission.invisible, glm::vec3(1.0f, 2.0f, 3.5f));
    EXPECT_EQ(material.emission.visible, glm::vec3(1.0f, 2.0f, 3.5f));
    EXPECT_EQ(material.emission.sides, Sides::kFront);
    EXPECT_EQ(material.sides, Sides::kBoth);
    EXPECT_FALSE(material.reflectance.has_value());
    EXPECT_THAT(library.warnings, IsEmpty());
}

TEST_F(MtlTest, AbsentDiffuseIsGreyButBlackIsBlack) {
    const MaterialLibrary library = load("newmtl absent\nKs 1 1 1\nnewmtl black\nKd 0 0 0\n");
    EXPECT_EQ(library.materials[0].baseColor, glm::vec3(0.8f));
    EXPECT_EQ(library.materials[1].baseColor, glm::vec3(0.0f));
}

TEST_F(MtlTest, NamesMayHoldBlanksAndLinesEndInCrLf) {
    const MaterialLibrary library = load("newmtl  old brick \r\nKd 1 0 0\r\n\r\nnewmtl b\r\nKd 0 1 0\r\n");
    ASSERT_EQ(library.materials.size(), 2u);
    EXPECT_EQ(library.materials[0].name, "old brick");
    EXPECT_EQ(library.materials[0].baseColor, glm::vec3(1, 0, 0));
    EXPECT_EQ(library.materials[1].baseColor, glm::vec3(0, 1, 0));
}

TEST_F(MtlTest, ReflectingMoreThanAllIsAWarning) {
    const MaterialLibrary library = load("newmtl a\nKd 1 1.5 1\n");
    EXPECT_EQ(library.materials[0].baseColor.y, 1.5f);
    EXPECT_THAT(library.warnings, ElementsAre(HasSubstr("m.mtl: line 2: Kd of \"a\" is above 1")));
}

TEST_F(MtlTest, SecondDefinitionAndMissingImagesAreWarnings) {
    const MaterialLibrary library = load(
        "newmtl a\nKd 1 0 0\nmap_Kd -s 2 2 wood.png\nnewmtl a\nKd 0 1 0\nnewmtl b\nmap_Kd tex\\stone.png\n");
    ASSERT_EQ(library.materials.size(), 2u);
    EXPECT_EQ(library.materials[0].baseColor, glm::vec3(1, 0, 0));
    EXPECT_THAT(library.materials[0].textures, IsEmpty());
    EXPECT_THAT(
        library.warnings,
        ElementsAre(
            HasSubstr("m.mtl: line 4: material \"a\" is defined again: the first one counts"),
            HasSubstr(
                "m.mtl: line 3: there is no image \"wood.png\" (and 1 more): materials are without it")));
}

TEST_F(MtlTest, StrictErrorsNameTheLine) {
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
    EXPECT_EQ(errorOfMtl("newmtl a\nNs shiny\n"),
              "m.mtl: line 2: Ns: \"shiny\" is not a finite number; expected \"Ns NUMBER\"");
    EXPECT_EQ(errorOfMtl("newmtl a\nd 1.5\n"), "m.mtl: line 2: d: out of range; expected 0 to 1");
    EXPECT_EQ(errorOfMtl("newmtl a\nKs 2 0 0\n"), "m.mtl: line 2: Ks: out of range; expected 0 to 1");
    EXPECT_EQ(
        errorOfMtl("newmtl a\nmap_Kd none.png\n"),
        "m.mtl: line 2: there is no image \"none.png\"; expected the path of an image, relative to the MTL "
        "file");
    EXPECT_EQ(errorOfMtl("newmtl a\nmap_Kd -s 2 2\n"),
              "m.mtl: line 2: map_Kd names no image; expected \"map_Kd FILE\"");
}

TEST_F(MtlTest, ColoursThatAreNotThreeNumbersAreReadAsTheyCanBe) {
    const auto read = [&](const char* colour) {
        const MaterialLibrary library = load(fmt::format("newmtl a\nKd {}\nKe {}\n", colour, colour));
        EXPECT_EQ(library.warnings.size(), 1u) << colour;
        EXPECT_EQ(library.materials[0].emission.invisible, library.materials[0].baseColor == glm::vec3(0.8f)
                                                               ? glm::vec3(0.0f)
                                                               : library.materials[0].baseColor);
        return library.materials[0].baseColor;
    };
    EXPECT_EQ(read("0.5"), glm::vec3(0.5f));
    EXPECT_EQ(read("0.5 0.25"), glm::vec3(0.5f, 0.25f, 0.0f));
    EXPECT_EQ(read("0.5 0.25 1 1"), glm::vec3(0.5f, 0.25f, 1.0f));
    EXPECT_EQ(read("-0.5 1 0"), glm::vec3(0.0f, 1.0f, 0.0f));
    for (const char* absent : {"", "red", "nan 0 0", "1e999 0 0", "spectral a.rfl"})
        EXPECT_EQ(read(absent), glm::vec3(0.8f)) << absent;
}

TEST_F(MtlTest, SpectraAreCalledSo) {
    EXPECT_THAT(load("newmtl a\nKd spectral file.rfl 2\nKe xyz 0.1 0.2 0.3\n").warnings,
                ElementsAre(HasSubstr("m.mtl: line 2: a colour as a spectrum or in CIE XYZ (and 1 more): not "
                                      "supported; read as if it were absent")));
}

TEST_F(MtlTest, EachKindOfOddityIsOneWarning) {
    const MaterialLibrary library = load(
        "Kd 1 0 0\nNs 3\nnewmtl\nKd 1 0 0\nnewmtl a\nKd 0.5\nKe 2\nnewmtl b\nKd 2 2 2\nnewmtl c\nKd 3 3 3\n");
    ASSERT_EQ(library.materials.size(), 3u);
    EXPECT_EQ(library.materials[0].baseColor, glm::vec3(0.5f));
    EXPECT_THAT(library.warnings,
                ElementsAre(HasSubstr("m.mtl: line 1: a statement before any newmtl (and 1 more): ignored"),
                            HasSubstr("m.mtl: line 3: newmtl without a name: what follows it is ignored"),
                            HasSubstr("m.mtl: line 6: a colour that is not three numbers (and 1 more): one"),
                            HasSubstr("m.mtl: line 9: Kd of \"b\" is above 1 (and 1 more): the surface")));
}

TEST_F(MtlTest, TheStatedLimitOfEmissionIsAccepted) {
    EXPECT_EQ(load("newmtl a\nKe 1e12 1e12 1e12\n").materials[0].emission.visible, glm::vec3(1e12f));
    EXPECT_THAT(errorOfMtl("newmtl a\nKe 1.0001e12 0 0\n"),
                HasSubstr("Ke: too large; expected numbers from 0 to 1e+12"));
}

TEST_F(MtlTest, ValuesThatAreWrongAreOneWarningAKind) {
    const MaterialLibrary library = load("newmtl a\nd 1.5\nNs\nTr -1\nPm x\nNi 0\nmap_Kd\nmap_d -clamp on\n");
    EXPECT_THAT(
        library.warnings,
        ElementsAre(HasSubstr("m.mtl: line 3: a value that is not a finite number (and 1 more): read as "),
                    HasSubstr("m.mtl: line 2: a value out of its range (and 2 more): clamped"),
                    HasSubstr("m.mtl: line 7: an image without a name (and 1 more): ignored")));
}

TEST_F(MtlTest, NamesWhatHasNoEffect) {
    write("a.png", "-");
    const MaterialLibrary library = load(
        "newmtl leaf\ndisp a.png\nmap_refl b.png\nKd 1 1 1\nnewmtl wall\nmap_disp c.png\nTf 1 0 0\n"
        "newmtl glass\nd -halo 0.5\nillum 9\nmap_Kd -t 1 1 -boost 2 a.png\n");
    EXPECT_THAT(
        library.warnings,
        ElementsAre(
            HasSubstr("m.mtl: line 2: images of these kinds are not used: disp (2), refl (1) of 2 "
                      "materials have no effect"),
            HasSubstr("m.mtl: line 7: does not apply to the material: Tf (1), map_Kd (1) of 2 materials "
                      "have no effect"),
            HasSubstr("m.mtl: line 9: options of images are not used: -halo (1), -t (1), -boost (1) of 1 "
                      "material have no effect")));
}

TEST_F(MtlTest, NamesStatementsThatItDoesNotKnow) {
    EXPECT_THAT(
        load("newmtl a\nkd 1 0 0\nfoo\nnewmtl b\nfoo 1\n").warnings,
        ElementsAre(HasSubstr("m.mtl: line 2: not known: kd (1), foo (2) of 2 materials have no effect; did "
                              "you mean Kd?")));
    EXPECT_THAT(
        load("newmtl a\nMAP_KD a.png\nmap_opacity b.png\nmap_Ka c.png\n").warnings,
        ElementsAre(HasSubstr("images of these kinds are not used: MAP_KD (1), map_opacity (1), map_Ka (1) "
                              "of 1 material have no effect; did you mean map_Kd?")));
    EXPECT_THAT(
        load("newmtl a\nTf 0.5 0.5 0.5\nnewmtl b\nTf 1 0 0\n").warnings,
        ElementsAre(HasSubstr("line 2: does not apply to the material: Tf of 2 materials has no effect")));
    std::string many = "newmtl a\n";
    for (int i = 0; i < 100'000; ++i)
        many += fmt::format("word{} 1\n", i);
    const MaterialLibrary library = load(many);
    ASSERT_EQ(library.warnings.size(), 1u);
    EXPECT_LT(library.warnings[0].size(), 400u);
}

TEST_F(MtlTest, WhatExportersAlwaysWriteIsNoNews) {
    // Blender; 3ds Max; one that takes Tr for d.
    EXPECT_THAT(load("newmtl a\nNs 250\nKa 1 1 1\nKd 0.8 0.8 0.8\nKs 0.5 0.5 0.5\nKe 0 0 0\nNi 1.45\nd "
                     "1.000000\nillum 2\n"
                     "newmtl b\nNs 10\nd 1.0\nTr 0.0\nTf 1 1 1\nillum 2\nKs 0 0 0\nKe 0 0 0\n"
                     "newmtl c\nd 1\nTr 1\nKs 1 1 1\nillum 1\nPr 0.5\nPm 0\n")
                    .warnings,
                IsEmpty());
}

TEST_F(MtlTest, EmptyFileIsAWarning) {
    EXPECT_THAT(load("# nothing\n").warnings, ElementsAre(HasSubstr("m.mtl: defines no material")));
}

}  // namespace
}  // namespace duolux::test

// What the values of MTL files mean.
#include <cmath>
#include <string>

#include "host/loaders/mtl.h"
#include "host/loaders/mtl_material.h"
#include "tests/unit/scene_files.h"

namespace duolux::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class MtlMaterialTest : public SceneFiles {
  protected:
    MtlMaterialTest() {
        for (const char* const name : {"a.png", "b.png"})
            write(name, "-");
    }

    MaterialLibrary load(const std::string& statements) const {
        FileFinder finder;
        return loadMtl(write("m.mtl", "newmtl a\n" + statements), finder);
    }
    Material read(const std::string& statements) const { return load(statements).materials.at(0); }

    /// A diffuse material, as it is without further statements.
    static Material diffuse(const glm::vec3& colour) {
        Material material;
        material.name = "a";
        material.baseColor = colour;
        return material;
    }
    /// The reflectance of a dielectric with this index at normal incidence (Fresnel).
    static float fresnel(const Material& material) {
        const float ratio = (material.ior - 1.0f) / (material.ior + 1.0f);
        return ratio * ratio * material.specularColor.x * material.specular;
    }
    static const MaterialTexture* use(const Material& material, MaterialInput input) {
        for (const MaterialTexture& texture : material.textures) {
            if (texture.input == input) return &texture;
        }
        return nullptr;
    }
};

TEST_F(MtlMaterialTest, WhatExportersWriteForDiffuseMaterialsIsDiffuse) {
    const Material expected = diffuse(glm::vec3(0.5f, 0.25f, 0.125f));
    const std::string colour = "Kd 0.5 0.25 0.125\n";
    for (const char* const rest :
         {"", "Ks 0.5 0.5 0.5\nNs 250\nNi 1.45\nd 1\nillum 2\n", "Ks 1 1 1\nNs 10\nillum 1\n",
          "Ks 1 1 1\nillum 0\n", "Ka 1 1 1\nTf 1 1 1\nNi 1\nillum 4\n", "Tr 0\nd 1\nKs 0 0 0\nillum 7\n",
          "d 1\nTr 1\n", "Tf 0 0 0\nillum 3\n", "Ks 0.9 0.9 0.9\nillum 10\n"}) {
        EXPECT_EQ(read(colour + rest), expected) << rest;
        EXPECT_THAT(load(colour + rest).warnings, IsEmpty()) << rest;
    }
}

TEST_F(MtlMaterialTest, LargeKsIsTheReflectanceOfADielectric) {
    const Material material = read("Kd 0.5 0 0\nKs 0.6 0.6 0.6\nNs 48\nillum 2\n");
    EXPECT_NEAR(fresnel(material), 0.6f, 1e-6f);
    EXPECT_NEAR(std::pow(material.roughness, 4.0f), 2.0f / 50.0f, 1e-6f) << "alpha squared";
    EXPECT_EQ(material.metallic, 0.0f);
    EXPECT_EQ(material.baseColor, glm::vec3(0.5f, 0, 0));
    EXPECT_EQ(read("Kd 0.5 0 0\nKs 0.6 0.6 0.6\nillum 2\n").roughness, 1.0f) << "Ns is 0 by default";
    EXPECT_EQ(read("Kd 0.5 0 0\nKs 0.6 0.6 0.6\nNs 48\n"), material) << "illum is 2 by default";
}

TEST_F(MtlMaterialTest, Mirrors) {
    for (const char* const model : {"3", "5", "8"}) {
        const Material weak = read(std::string("Kd 0.5 0 0\nKs 0.1 0.1 0.1\nNs 200\nillum ") + model);
        EXPECT_NEAR(fresnel(weak), 0.1f, 1e-6f) << model;
        EXPECT_EQ(weak.roughness, 0.0f);
    }
    EXPECT_NEAR(std::pow(read("Ks 0.5 0.5 0.5\nNs 30\nillum 3\n").roughness, 4.0f), 2.0f / 32.0f, 1e-6f);
    const Material gold = read("Kd 0 0 0\nKs 1 0.75 0.25\nillum 3\n");
    EXPECT_EQ(gold.metallic, 1.0f);
    EXPECT_EQ(gold.baseColor, glm::vec3(1.0f, 0.75f, 0.25f));
    EXPECT_EQ(gold.roughness, 0.0f);
    EXPECT_EQ(gold.specular, 0.0f) << "there is no dielectric";
    EXPECT_EQ(read("Kd 0 0 0\nmap_Kd a.png\nKs 1 1 1\nillum 3\n").metallic, 0.0f) << "the image is not black";
}

TEST_F(MtlMaterialTest, DissolveIsCoverage) {
    for (const char* const statements :
         {"d 0.25\n", "Tr 0.75\n", "d 0.25\nTr 0.25\n", "d 0.25\nillum 4\nmap_d a.png\n"}) {
        const Material material = read(statements);
        EXPECT_EQ(material.alpha.mode, AlphaMode::kBlend) << statements;
        EXPECT_EQ(material.alpha.value, 0.25f) << statements;
        EXPECT_EQ(material.transmission, 0.0f);
    }
    const Material cutOut = read("Kd 1 1 1\nmap_Kd a.png\nmap_d a.png\n");
    EXPECT_EQ(cutOut.alpha.mode, AlphaMode::kBlend);
    EXPECT_EQ(cutOut.alpha.value, 1.0f);
    EXPECT_EQ(use(cutOut, MaterialInput::kAlpha)->channel, 3u) << "the alpha of the image of colours";
    EXPECT_EQ(use(cutOut, MaterialInput::kAlpha)->texture.colourSpace, ColourSpace::kLinear);
    EXPECT_EQ(use(read("map_Kd a.png\nmap_d b.png\n"), MaterialInput::kAlpha)->channel, 0u);
    EXPECT_EQ(use(read("map_Kd a.png\nmap_d -imfchan g a.png\n"), MaterialInput::kAlpha)->channel, 1u);
    EXPECT_EQ(use(read("map_d -imfchan m b.png\n"), MaterialInput::kAlpha)->channel, 3u);
}

TEST_F(MtlMaterialTest, Glass) {
    for (const char* const model : {"4", "6", "7", "9"}) {
        const Material glass =
            read(std::string("Kd 0.1 0.1 0.1\nd 0.2\nTf 0.5 1 0.75\nNi 1.25\nNs 300\nillum ") + model);
        EXPECT_EQ(glass.transmission, 1.0f) << model;
        EXPECT_EQ(glass.specular, 1.0f);
        EXPECT_EQ(glass.ior, 1.25f);
        EXPECT_EQ(glass.roughness, 0.0f);
        EXPECT_EQ(glass.baseColor, glm::vec3(0.5f, 1.0f, 0.75f));
        EXPECT_EQ(glass.alpha, Alpha()) << "it is all there";
        EXPECT_FALSE(glass.thin);
    }
    EXPECT_EQ(read("Tf 1 1 1\nNi 1.5\nillum 7\n").transmission, 1.0f) << "a classic one without d";
    EXPECT_EQ(read("d 0.5\nillum 4\n").ior, 1.5f);
    EXPECT_EQ(read("d 0.5\nillum 4\n").baseColor, glm::vec3(1.0f));
    EXPECT_NEAR(std::pow(read("d 0.5\nNs 6\nillum 4\n").roughness, 4.0f), 2.0f / 8.0f, 1e-6f) << "frosted";
    EXPECT_THAT(load("Kd 0.8 0.8 0.8\nd 0.5\nillum 9\n").warnings, IsEmpty());
    EXPECT_THAT(
        load("Kd 0 1 0\nd 0.5\nillum 9\n").warnings,
        ElementsAre(HasSubstr("line 2: does not apply to the material: Kd of 1 material has no effect")));
}

TEST_F(MtlMaterialTest, PhysicallyBasedStatements) {
    const Material material = read(
        "Kd 1 0.5 0\nKs 1 1 1\nNs 5\nPr 0.25\nPm 0.75\nPc 0.5\nPcr 0.125\nPs 0.375\naniso 0.5\nanisor "
        "0.25\nNi 2\n");
    EXPECT_EQ(material.baseColor, glm::vec3(1, 0.5f, 0));
    EXPECT_EQ(material.roughness, 0.25f);
    EXPECT_EQ(material.metallic, 0.75f);
    EXPECT_EQ(material.specular, 1.0f);
    EXPECT_EQ(material.specularColor, glm::vec3(1.0f)) << "Ks is for other programs";
    EXPECT_EQ(material.ior, 2.0f);
    EXPECT_EQ(material.clearcoat, 0.5f);
    EXPECT_EQ(material.clearcoatRoughness, 0.125f);
    EXPECT_EQ(material.sheenColor, glm::vec3(0.375f));
    EXPECT_EQ(material.sheenRoughness, 0.5f);
    EXPECT_EQ(material.anisotropy, 0.5f);
    EXPECT_EQ(material.anisotropyRotation, 90.0f);
    EXPECT_EQ(read("Pr 0.5\naniso -0.25\n").anisotropyRotation, 90.0f) << "across the tangent";
    EXPECT_EQ(read("Pr 0.5\naniso -0.25\n").anisotropy, 0.25f);
    EXPECT_EQ(read("Pr 0.5\nNi 1\n").ior, 1.5f) << "1 is what exporters write by default";
    EXPECT_EQ(read("Pm 1\n").roughness, 0.5f);
    EXPECT_NEAR(std::pow(read("Pm 1\nNs 6\n").roughness, 4.0f), 2.0f / 8.0f, 1e-6f);
    EXPECT_EQ(read("Ps 0.25 0.5 1\n").sheenColor, glm::vec3(0.25f, 0.5f, 1.0f));
}

TEST_F(MtlMaterialTest, ImagesOfEveryKind) {
    struct Case {
        const char* statements;
        MaterialInput input;
        ColourSpace colourSpace;
    };
    for (const auto& [statements, input, colourSpace] :
         {Case{"map_Kd a.png", MaterialInput::kBaseColor, ColourSpace::kSrgb},
          Case{"map_Ks a.png", MaterialInput::kSpecularColor, ColourSpace::kSrgb},
          Case{"map_Ke a.png", MaterialInput::kEmission, ColourSpace::kSrgb},
          Case{"map_d a.png", MaterialInput::kAlpha, ColourSpace::kLinear},
          Case{"map_Pr a.png", MaterialInput::kRoughness, ColourSpace::kLinear},
          Case{"map_Pm a.png", MaterialInput::kMetallic, ColourSpace::kLinear},
          Case{"map_Pc a.png", MaterialInput::kClearcoat, ColourSpace::kLinear},
          Case{"map_Pcr a.png", MaterialInput::kClearcoatRoughness, ColourSpace::kLinear},
          Case{"map_Ps a.png", MaterialInput::kSheenColor, ColourSpace::kSrgb},
          Case{"norm a.png", MaterialInput::kNormal, ColourSpace::kLinear}}) {
        const MaterialLibrary library = load(statements);
        ASSERT_EQ(library.materials[0].textures.size(), 1u) << statements;
        EXPECT_EQ(library.materials[0].textures[0].input, input) << statements;
        EXPECT_EQ(library.materials[0].textures[0].texture.colourSpace, colourSpace) << statements;
        EXPECT_THAT(library.warnings, IsEmpty()) << statements;
        ASSERT_EQ(library.images.size(), 1u);
        EXPECT_EQ(library.images[0].path, folder_ / "a.png");
    }
    EXPECT_EQ(read("norm -bm 0.5 a.png").normalScale, 0.5f);
    EXPECT_EQ(use(read("map_Pr -imfchan g a.png"), MaterialInput::kRoughness)->channel, 1u);
}

TEST_F(MtlMaterialTest, BumpMapsBecomeNormals) {
    for (const char* const keyword : {"map_bump", "map_Bump", "bump", "Bump"}) {
        const MaterialLibrary library = load(keyword + std::string(" -bm 0.25 -clamp on -imfchan g a.png\n"));
        const Material& material = library.materials[0];
        ASSERT_EQ(material.textures.size(), 1u) << keyword;
        EXPECT_EQ(material.textures[0].input, MaterialInput::kNormal);
        EXPECT_EQ(material.textures[0].texture.colourSpace, ColourSpace::kLinear);
        EXPECT_EQ(material.textures[0].texture.wrapU, Wrap::kClamp);
        EXPECT_EQ(material.normalScale, 0.25f);
        ASSERT_EQ(library.images.size(), 1u);
        const ImageConversion expected{
            .kind = ImageConversion::Kind::kHeights, .channel = 1, .repeats = false};
        EXPECT_EQ(library.images[0].conversion, expected);
        EXPECT_THAT(library.warnings, IsEmpty());
    }
    const ImageConversion repeated{.kind = ImageConversion::Kind::kHeights,
                                   .channel = ImageConversion::kLuminance};
    EXPECT_EQ(load("bump a.png").images.at(0).conversion, repeated);
    EXPECT_EQ(read("bump a.png").normalScale, 1.0f);
    const MaterialLibrary both = load("bump a.png\nnorm -bm 0.5 b.png\n");
    EXPECT_EQ(both.materials[0].normalScale, 0.5f);
    EXPECT_EQ(both.images.at(both.materials[0].textures.at(0).texture.image).path, folder_ / "b.png");
    EXPECT_THAT(both.warnings,
                ElementsAre(HasSubstr("line 2: does not apply to the material: bump of 1 material")));
    const MaterialLibrary twice = load("bump a.png\nmap_Kd a.png\n");
    EXPECT_EQ(twice.images.size(), 2u) << "the colours and the normals";
}

TEST_F(MtlMaterialTest, ExponentsInImagesBecomeRoughness) {
    const auto conversionOf = [&](const std::string& statements) {
        const MaterialLibrary library = load(statements + "map_Ns a.png\n");
        EXPECT_EQ(library.materials[0].roughness, 1.0f) << statements;
        EXPECT_THAT(library.warnings, IsEmpty()) << statements;
        return library.images.at(library.materials[0].textures.at(0).texture.image).conversion;
    };
    ImageConversion expected{.kind = ImageConversion::Kind::kExponents, .factor = 250.0f};
    EXPECT_EQ(conversionOf("Ks 0.9 0.9 0.9\nNs 250\n"), expected);
    EXPECT_EQ(conversionOf("Pm 1\nNs 250\n"), expected);
    expected.mirrorFrom = 100.0f;
    EXPECT_EQ(conversionOf("Ks 0.2 0.2 0.2\nNs 250\nillum 3\n"), expected);
    EXPECT_EQ(conversionOf("d 0.5\nNs 250\nillum 4\n"), expected);
    EXPECT_EQ(conversionOf("Ks 0.2 0.2 0.2\nNs 0\nillum 3\n").factor, 1000.0f);
    for (const char* const statements : {"Kd 1 1 1\n", "Pr 0.5\n"}) {
        EXPECT_THAT(load(statements + std::string("map_Ns a.png\n")).warnings,
                    ElementsAre(HasSubstr("does not apply to the material: map_Ns of 1 material")));
    }
}

TEST_F(MtlMaterialTest, BaseAndGainOfImages) {
    const MaterialLibrary library = load("map_Kd -mm 0.25 0.5 a.png\nmap_d a.png\n");
    ASSERT_EQ(library.images.size(), 2u);
    const auto conversionOf = [&](MaterialInput input) {
        return library.images.at(use(library.materials[0], input)->texture.image).conversion;
    };
    EXPECT_EQ(conversionOf(MaterialInput::kBaseColor), (ImageConversion{.base = 0.25f, .gain = 0.5f}));
    EXPECT_EQ(conversionOf(MaterialInput::kAlpha), ImageConversion());
}

TEST_F(MtlMaterialTest, FactorsOfImages) {
    EXPECT_EQ(read("map_Kd a.png\n").baseColor, glm::vec3(1.0f));
    EXPECT_EQ(read("Kd 0 0 0\nmap_Kd a.png\n").baseColor, glm::vec3(1.0f)) << "as exporters write";
    EXPECT_EQ(read("Kd 0.5 0.5 0.5\nmap_Kd a.png\n").baseColor, glm::vec3(0.5f));
    EXPECT_EQ(read("Kd 0.5 0.5 0.5\nmap_Kd none.png\n").baseColor, glm::vec3(0.5f));
    EXPECT_EQ(read("Ke 0 0 0\nmap_Ke a.png\n").emission.visible, glm::vec3(1.0f));
    EXPECT_EQ(read("Ke 4 5 6\nmap_Ke a.png\n").emission.invisible, glm::vec3(4, 5, 6));
    EXPECT_EQ(read("Pm 0\nmap_Pm a.png\n").metallic, 1.0f);
    EXPECT_NEAR(fresnel(read("Ks 0.25 0.25 0.25\nmap_Ks a.png\n")), 0.25f, 1e-6f)
        << "an image makes it shiny";
    EXPECT_THAT(load("Ks 0 0 0\nmap_Ks a.png\n").warnings,
                ElementsAre(HasSubstr("line 3: does not apply to the material: map_Ks of 1 material")));
}

}  // namespace
}  // namespace duolux::test

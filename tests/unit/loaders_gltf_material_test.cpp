// Materials, textures, cameras and lights of glTF files.
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "tests/unit/gltf_files.h"

namespace duolux::test {
namespace {

using nlohmann::json;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using V = glm::vec3;

class GltfMaterialTest : public GltfTest {
  protected:
    /// A triangle with this material, and three textures.
    static GltfFile fileWith(json material) {
        GltfFile file = triangleFile();
        file.json["meshes"][0]["primitives"][0]["material"] = file.add("materials", std::move(material));
        for (int i = 0; i < 3; ++i) {
            file.add("images", {{"uri", "image" + std::to_string(i) + ".png"}});
            file.add("textures", {{"source", i}});
        }
        return file;
    }
    Material materialOf(json material) const {
        const Mesh read = mesh(fileWith(std::move(material)));
        EXPECT_EQ(read.materials.size(), 1u);
        EXPECT_THAT(read.warnings, IsEmpty());
        return read.materials[0];
    }
    static json extensions(const char* name, json value) {
        return {{"extensions", {{name, std::move(value)}}}};
    }
};

/// How a texture is used, as text: "base_color 0 srgb" or "metallic 1 b".
std::vector<std::string> usesOf(const Mesh& mesh, const Material& material) {
    std::vector<std::string> uses;
    for (const auto& [input, texture, channel] : material.textures) {
        const std::string colourSpace =
            texture.colourSpace == ColourSpace::kSrgb ? "srgb" : std::string(1, "rgba"[channel]);
        std::string image = mesh.images.at(texture.image).path.filename().string();
        uses.push_back(std::string(nameOf(input)) + " " + image + " " + colourSpace);
    }
    return uses;
}

TEST_F(GltfMaterialTest, DefaultsAreThoseOfGltf) {
    Material expected;
    expected.name = "default";
    expected.baseColor = V(1);
    expected.metallic = expected.roughness = expected.specular = 1;
    EXPECT_EQ(mesh(triangleFile()).materials, std::vector<Material>{expected});
    expected.name = "material 0";
    EXPECT_EQ(materialOf(json::object()), expected);
}

TEST_F(GltfMaterialTest, FactorsAreRead) {
    Material expected;
    expected.name = "\xC3\xA9";
    expected.baseColor = V(0.25, 0.5, 0.75);
    expected.alpha = {AlphaMode::kMask, 0.5, 0.125};
    expected.metallic = 0.25;
    expected.roughness = 0.75;
    expected.specular = 1;
    expected.emission = {V(0.5, 1, 2), V(0.5, 1, 2), Sides::kFront};
    json material{
        {"name", "\xC3\xA9"},
        {"alphaMode", "MASK"},
        {"alphaCutoff", 0.125},
        {"emissiveFactor", {0.125, 0.25, 0.5}},
        {"pbrMetallicRoughness",
         {{"baseColorFactor", {0.25, 0.5, 0.75, 0.5}}, {"metallicFactor", 0.25}, {"roughnessFactor", 0.75}}}};
    material.update(extensions("KHR_materials_emissive_strength", {{"emissiveStrength", 4}}));
    EXPECT_EQ(materialOf(material), expected);
    material["doubleSided"] = true;
    expected.emission.sides = Sides::kBoth;
    EXPECT_EQ(materialOf(material), expected);
    material["alphaMode"] = "BLEND";
    expected.alpha.mode = AlphaMode::kBlend;
    EXPECT_EQ(materialOf(material), expected);
}

TEST_F(GltfMaterialTest, ExtensionsAreRead) {
    const auto with = [](auto&& change) {
        Material material;
        material.name = "material 0";
        material.baseColor = V(1);
        material.metallic = material.roughness = material.specular = 1;
        change(material);
        return material;
    };
    EXPECT_EQ(materialOf(extensions("KHR_materials_ior", {{"ior", 1.25}})),
              with([](Material& m) { m.ior = 1.25; }));
    // A reflectance of 1 at normal incidence, which the colour scales.
    json mirror = extensions("KHR_materials_ior", {{"ior", 0}});
    EXPECT_EQ(materialOf(mirror), with([](Material& m) { m.specularColor = V(1) / 0.04f; }));
    mirror["extensions"]["KHR_materials_specular"] = {{"specularColorFactor", {1, 0.5, 0.25}}};
    EXPECT_EQ(materialOf(mirror), with([](Material& m) { m.specularColor = V(1, 0.5, 0.25) / 0.04f; }));
    EXPECT_EQ(materialOf(extensions("KHR_materials_specular",
                                    {{"specularFactor", 0.5}, {"specularColorFactor", {2, 0.5, 0}}})),
              with([](Material& m) { m.specular = 0.5, m.specularColor = V(2, 0.5, 0); }));
    EXPECT_EQ(materialOf(extensions("KHR_materials_clearcoat",
                                    {{"clearcoatFactor", 0.5}, {"clearcoatRoughnessFactor", 0.25}})),
              with([](Material& m) { m.clearcoat = 0.5, m.clearcoatRoughness = 0.25; }));
    EXPECT_EQ(materialOf(extensions("KHR_materials_sheen",
                                    {{"sheenColorFactor", {1, 0.5, 0.25}}, {"sheenRoughnessFactor", 0.75}})),
              with([](Material& m) { m.sheenColor = V(1, 0.5, 0.25), m.sheenRoughness = 0.75; }));
    EXPECT_EQ(
        materialOf(extensions("KHR_materials_anisotropy",
                              {{"anisotropyStrength", 0.5}, {"anisotropyRotation", std::numbers::pi / 2}})),
        with([](Material& m) { m.anisotropy = 0.5, m.anisotropyRotation = 90; }));
    json glass = extensions("KHR_materials_transmission", {{"transmissionFactor", 0.5}});
    EXPECT_EQ(materialOf(glass), with([](Material& m) { m.transmission = 0.5, m.thin = true; }));
    glass["extensions"]["KHR_materials_volume"] = {{"attenuationColor", {0.5, 1, 0.25}},
                                                   {"attenuationDistance", 4}};
    const auto absorb = [](Material& m) {
        m.transmission = 0.5, m.attenuationColor = V(0.5, 1, 0.25), m.attenuationDistance = 4;
    };
    EXPECT_EQ(materialOf(glass), with([&](Material& m) { absorb(m), m.thin = true; }));
    glass["extensions"]["KHR_materials_volume"]["thicknessFactor"] = 0.1;
    EXPECT_EQ(materialOf(glass), with(absorb));
    EXPECT_EQ(
        materialOf(extensions("KHR_materials_pbrSpecularGlossiness", {{"diffuseFactor", {0.25, 0.5, 1, 1}},
                                                                      {"specularFactor", {0.04, 0.08, 1}},
                                                                      {"glossinessFactor", 0.75}})),
        with([](Material& m) {
            m.baseColor = V(0.25, 0.5, 1), m.metallic = 0, m.roughness = 0.25;
            m.specularColor = V(0.04f, 0.08f, 1) / 0.04f;
        }));
}

TEST_F(GltfMaterialTest, UnlitSurfacesShowTheirColourAndLightNothing) {
    json material = extensions("KHR_materials_unlit", json::object());
    material["pbrMetallicRoughness"] = {{"baseColorFactor", {0.25, 0.5, 1, 0.5}},
                                        {"baseColorTexture", {{"index", 1}}}};
    material["normalTexture"] = {{"index", 0}};
    material["alphaMode"] = "BLEND";
    const Mesh read = mesh(fileWith(material));
    const Material& unlit = read.materials[0];
    EXPECT_EQ(unlit.emission, (Emission{V(0), V(0.25, 0.5, 1), Sides::kBoth}));
    EXPECT_EQ(unlit.baseColor, V(0));
    EXPECT_EQ(unlit.metallic, 0);
    EXPECT_EQ(unlit.specular, 0);
    EXPECT_EQ(unlit.alpha, (Alpha{AlphaMode::kBlend, 0.5, 0.5}));
    EXPECT_THAT(usesOf(read, unlit), ElementsAre("alpha image1.png a", "emission image1.png srgb"));
    EXPECT_THAT(read.warnings, IsEmpty());
    GltfFile coloured = fileWith(material);
    coloured.json["meshes"][0]["primitives"][0]["attributes"]["COLOR_0"] = coloured.vec3(kCorners);
    EXPECT_TRUE(unlit.unlit);
    EXPECT_THAT(warningsOf(mesh(coloured)), IsEmpty());
}

TEST_F(GltfMaterialTest, TexturesHaveTheChannelsOfTheirSpecifications) {
    json material{{"pbrMetallicRoughness",
                   {{"baseColorTexture", {{"index", 0}}}, {"metallicRoughnessTexture", {{"index", 1}}}}},
                  {"normalTexture", {{"index", 2}, {"scale", -0.5}}},
                  {"occlusionTexture", {{"index", 1}}},
                  {"emissiveTexture", {{"index", 0}}},
                  {"emissiveFactor", {1, 1, 1}}};
    const json zero{{"index", 0}}, one{{"index", 1}}, two{{"index", 2}};
    material["extensions"] = {
        {"KHR_materials_specular", {{"specularTexture", one}, {"specularColorTexture", two}}},
        {"KHR_materials_transmission", {{"transmissionTexture", two}}},
        {"KHR_materials_volume", {{"thicknessTexture", zero}}},
        {"KHR_materials_clearcoat",
         {{"clearcoatTexture", zero},
          {"clearcoatRoughnessTexture", one},
          {"clearcoatNormalTexture", {{"index", 2}, {"scale", 0.25}}}}},
        {"KHR_materials_sheen", {{"sheenColorTexture", two}, {"sheenRoughnessTexture", zero}}},
        {"KHR_materials_anisotropy", {{"anisotropyTexture", one}}}};
    const Mesh read = mesh(fileWith(material));
    EXPECT_THAT(
        usesOf(read, read.materials[0]),
        ElementsAre("base_color image0.png srgb", "metallic image1.png b", "roughness image1.png g",
                    "specular image1.png a", "specular_color image2.png srgb", "transmission image2.png r",
                    "clearcoat image0.png r", "clearcoat_roughness image1.png g",
                    "sheen_color image2.png srgb", "sheen_roughness image0.png a", "anisotropy image1.png r",
                    "normal image2.png r", "emission image0.png srgb", "clearcoat_normal image2.png r"));
    EXPECT_EQ(read.materials[0].normalScale, -0.5f);
    EXPECT_EQ(read.materials[0].clearcoatNormalScale, 0.25f);
    EXPECT_EQ(read.images.size(), 3u) << "each image once";
    EXPECT_THAT(read.warnings, IsEmpty());

    material = {{"alphaMode", "MASK"}, {"pbrMetallicRoughness", {{"baseColorTexture", two}}}};
    const Mesh masked = mesh(fileWith(material));
    EXPECT_THAT(usesOf(masked, masked.materials[0]),
                ElementsAre("base_color image2.png srgb", "alpha image2.png a"));
}

TEST_F(GltfMaterialTest, GlossinessInImagesBecomesRoughness) {
    const json image{{"index", 1}};
    const auto materialWith = [&](const json& extension) {
        return mesh(fileWith(extensions("KHR_materials_pbrSpecularGlossiness", extension)));
    };
    const Mesh read = materialWith({{"glossinessFactor", 0.75}, {"specularGlossinessTexture", image}});
    EXPECT_THAT(usesOf(read, read.materials[0]),
                ElementsAre("roughness image1.png r", "specular_color image1.png srgb"));
    EXPECT_EQ(read.materials[0].roughness, 1.0f);
    const ImageConversion expected{.kind = ImageConversion::Kind::kGlossiness, .channel = 3, .factor = 0.75f};
    ASSERT_EQ(read.images.size(), 2u);
    EXPECT_EQ(read.images[read.materials[0].textures[0].texture.image].conversion, expected);
    EXPECT_EQ(read.images[read.materials[0].textures[1].texture.image].conversion, ImageConversion());
    EXPECT_THAT(read.warnings, IsEmpty());
}

TEST_F(GltfMaterialTest, TexturesHaveSamplersAndTransforms) {
    GltfFile file =
        fileWith({{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}, {"texCoord", 1}}}}}});
    file.add("samplers", {{"wrapS", 33071}, {"wrapT", 33648}, {"magFilter", 9728}});
    file.json["textures"][0]["sampler"] = 0;
    json& info = file.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"];
    Texture expected;
    expected.colourSpace = ColourSpace::kSrgb;
    expected.wrapU = Wrap::kClamp;
    expected.wrapV = Wrap::kMirror;
    expected.filter = Filter::kNearest;
    expected.uvSet = 1;
    EXPECT_EQ(mesh(file).materials[0].textures[0].texture, expected);
    info["extensions"]["KHR_texture_transform"] = {
        {"offset", {0.5, -1}}, {"scale", {2, 3}}, {"rotation", std::numbers::pi / 4}, {"texCoord", 0}};
    expected.transform = {{2, 3}, {0.5, -1}, 45};
    expected.uvSet = 0;
    EXPECT_EQ(mesh(file).materials[0].textures[0].texture, expected);
    info["extensions"]["KHR_texture_transform"]["texCoord"] = 2;
    const Mesh third = mesh(file);
    EXPECT_TRUE(third.materials[0].textures.empty());
    EXPECT_THAT(warningsOf(third),
                ElementsAre("mesh.gltf: materials[0].pbrMetallicRoughness.baseColorTexture: a texture "
                            "with a third set of texture coordinates is not supported: ignored"));
}

TEST_F(GltfMaterialTest, ImagesAreFilesOrPartsOfTheFile) {
    GltfFile file = fileWith({{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}},
                              {"normalTexture", {{"index", 1}}},
                              {"emissiveFactor", {1, 1, 1}},
                              {"emissiveTexture", {{"index", 2}}}});
    write("a b.png", "not decoded here");
    file.json["images"] = {{{"bufferView", file.view("the first")}, {"mimeType", "image/png"}},
                           {{"uri", "data:image/png;base64," + base64Of("second")}},
                           {{"uri", "a%20b.png"}}};
    const Mesh read = mesh(file);
    ASSERT_EQ(read.images.size(), 3u);
    EXPECT_EQ(*read.images[0].bytes, "the first");
    EXPECT_EQ(read.images[0].name, (folder_ / "mesh.gltf").string() + ": images[0]");
    EXPECT_EQ(*read.images[1].bytes, "second");
    EXPECT_EQ(read.images[2].path, folder_ / "a b.png");
    EXPECT_EQ(read.images[2].bytes, nullptr);
    EXPECT_THAT(read.files, ElementsAre(folder_ / "mesh.gltf", folder_ / "a b.png"))
        << "no output may replace it";
    std::filesystem::remove(folder_ / "a b.png");
    EXPECT_EQ(mesh(file).files.size(), 1u);
}

TEST_F(GltfMaterialTest, HarmlessErrorsAreOneWarningEach) {
    GltfFile file = fileWith({{"pbrMetallicRoughness", {{"metallicFactor", 1.5}, {"roughnessFactor", -1}}}});
    file.json["extensionsUsed"] = {"KHR_materials_ior", "KHR_materials_iridescence", "ACME_x"};
    const Mesh read = mesh(file);
    EXPECT_EQ(read.materials[0].metallic, 1.0f);
    EXPECT_EQ(read.materials[0].roughness, 0.0f);
    EXPECT_THAT(
        warningsOf(read),
        ElementsAre("mesh.gltf: extensionsUsed[1]: the extension \"KHR_materials_iridescence\" is not "
                    "supported: ignored",
                    "mesh.gltf: extensionsUsed[2]: the extension \"ACME_x\" is not supported: ignored",
                    "mesh.gltf: materials[0].pbrMetallicRoughness.metallicFactor: a factor is out of range "
                    "(and 1 more): the "
                    "nearest that is possible is used"));
    EXPECT_EQ(errorOfGltf(file, Reading::kStrict),
              "mesh.gltf: materials[0].pbrMetallicRoughness.metallicFactor: a "
              "factor is out of range; expected a number from 0 to 1");
}

TEST_F(GltfMaterialTest, PointLightsAreEmitters) {
    GltfFile file = triangleFile();
    file.json["extensions"]["KHR_lights_punctual"]["lights"] = {
        {{"type", "point"}, {"color", {1, 0.5, 0}}, {"intensity", 1366}},
        {{"type", "spot"}, {"spot", json::object()}},
        {{"type", "directional"}},
        {{"type", "point"}}};
    for (const int light : {0, 1, 2, 3})
        file.add("nodes", {{"extensions", {{"KHR_lights_punctual", {{"light", light}}}}},
                           {"translation", {1, 2, light}}});
    file.add("nodes", {{"children", {1, 2, 3, 4}}, {"scale", {2, 2, 2}}});
    const Mesh read = mesh(file);
    ASSERT_EQ(read.pointEmitters.size(), 2u);
    EXPECT_EQ(read.pointEmitters[0].position, glm::dvec3(2, 4, 0));
    EXPECT_THAT(read.pointEmitters[0].invisible, IsNear(V(2, 1, 0), 1e-6f)) << "1 cd is 1/683 W/sr";
    EXPECT_EQ(read.pointEmitters[0].visible, read.pointEmitters[0].invisible);
    EXPECT_THAT(read.pointEmitters[1].invisible, IsNear(V(1 / 683.0f), 1e-9f));
    EXPECT_THAT(warningsOf(read), ElementsAre("mesh.gltf: extensions.KHR_lights_punctual.lights[1]: spot and "
                                              "directional lights are not supported (and 1 more): left out"));
    const LoadedScene own = load("mesh.gltf");
    ASSERT_EQ(own.pointEmitters.size(), 2u);
    EXPECT_EQ(own.pointEmitters[0].position, V(2, 4, 0));
    const LoadedScene scene = loadJson(R"({"duolux": 1, "objects": [{"mesh": "mesh.gltf",
        "transform": [1,0,0,1000, 0,3,0,0, 0,0,1,0, 0,0,0,1]}, {"mesh": "mesh.gltf"}]})");
    ASSERT_EQ(scene.pointEmitters.size(), 4u);
    EXPECT_EQ(scene.pointEmitters[0].position, V(1002, 12, 0));
    EXPECT_EQ(scene.pointEmitters[2].position, V(2, 4, 0));
}

TEST_F(GltfMaterialTest, TheFirstCameraIsUsed) {
    GltfFile file = triangleFile();
    file.add("cameras",
             {{"type", "perspective"}, {"perspective", {{"yfov", std::numbers::pi / 3}, {"znear", 0.1}}}});
    file.add("cameras", {{"type", "orthographic"},
                         {"orthographic", {{"xmag", 4}, {"ymag", 3}, {"znear", 0.1}, {"zfar", 9}}}});
    // A quarter turn about y: what looked along -z looks along -x.
    const double half = std::sqrt(0.5);
    file.add("nodes", {{"camera", 0}, {"rotation", {0, half, 0, half}}, {"translation", {5, 0.5, 0}}});
    const LoadedScene scene = load(write("mesh.gltf", file.text()).filename().string());
    EXPECT_EQ(scene.camera.position, V(5, 0.5, 0));
    EXPECT_THAT(scene.camera.target, IsNear(V(0.5, 0.5, 0), 1e-5f)) << "as far as the middle of the triangle";
    EXPECT_THAT(scene.camera.up, IsNear(V(0, 1, 0), 1e-6f));
    EXPECT_FLOAT_EQ(scene.camera.vfov, 60.0f);

    file.add("nodes", {{"camera", 0}});
    file.json["nodes"][1]["camera"] = 1;
    file.json["nodes"][1]["scale"] = {2, 2, 2};
    const Mesh read = mesh(file);
    EXPECT_EQ(read.camera.type, CameraType::kOrthographic);
    EXPECT_EQ(read.camera.height, 6.0f) << "half of the height is in the file; nodes do not scale it";
    EXPECT_FALSE(read.camera.vfov);
    EXPECT_THAT(warningsOf(read), ElementsAre("mesh.gltf: has 2 cameras: the first, cameras[1], is used"));
    file.json["scenes"] = {{{"nodes", {0}}}};
    EXPECT_FALSE(mesh(file).camera.position) << "cameras outside the scene do not count";
}

}  // namespace
}  // namespace duolux::test

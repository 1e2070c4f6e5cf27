// Images in the materials of JSON scenes.
#include <fmt/format.h>

#include <array>
#include <stdexcept>
#include <string>

#include "host/loaders/scene_file.h"
#include "host/scene/material_textures.h"
#include "tests/unit/scene_files.h"

namespace duolux::test {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

/// Files are only named and not decoded, so that any content will do.
class JsonImagesTest : public SceneFiles {
  protected:
    JsonImagesTest() {
        write("mesh.obj",
              "mtllib mesh.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nusemtl white\nf 1/1 2/2 "
              "3/3\n"
              "usemtl lamp\nf 3/3 2/2 1/1\n");
        write("mesh.mtl", "newmtl white\nKd 0.5 0.6 0.7\nnewmtl lamp\nKd 0 0 0\nKe 3 2 1\nnewmtl idle\n");
        for (const char* const name : {"wood.png", "other.jpg"})
            write(name, "-");
    }

    LoadedScene read(const std::string& materials) const {
        write("scene.json",
              R"({"duolux": 1, "objects": [{"mesh": "mesh.obj"}], "materials": )" + materials + "}");
        return readSceneFile(folder_ / "scene.json", Reading::kLenient).scene;
    }
    LoadedScene white(const std::string& keys) const { return read("{\"white\": {" + keys + "}}"); }
    std::string errorOfWhite(const std::string& keys) const {
        return errorOfJson(R"({"duolux": 1, "objects": [{"mesh": "mesh.obj"}], "materials": {"white": {)" +
                           keys + "}}}");
    }
    static const Material& material(const LoadedScene& scene, const std::string& name = "white") {
        for (const Material& material : scene.materials) {
            if (material.name == name) return material;
        }
        throw std::out_of_range(name);
    }
};

TEST_F(JsonImagesTest, EveryKeyOfAnImage) {
    const LoadedScene scene = white(
        R"("base_color": {"image": "wood.png", "factor": [0.5, 0.25, 1], "uv_set": 1, "uv_scale": [2, -3],
           "uv_offset": [0.5, 0.125], "uv_rotation": 30, "wrap": ["clamp", "mirror"], "filter": "nearest"})");
    EXPECT_EQ(material(scene).baseColor, glm::vec3(0.5f, 0.25f, 1.0f));
    ASSERT_EQ(material(scene).textures.size(), 1u);
    const MaterialTexture& entry = material(scene).textures[0];
    EXPECT_EQ(entry.input, MaterialInput::kBaseColor);
    const Texture& texture = entry.texture;
    EXPECT_EQ(texture.image, 0u);
    EXPECT_EQ(texture.colourSpace, ColourSpace::kSrgb);
    EXPECT_EQ(texture.uvSet, 1u);
    EXPECT_EQ(texture.transform.scale, glm::vec2(2, -3));
    EXPECT_EQ(texture.transform.offset, glm::vec2(0.5f, 0.125f));
    EXPECT_EQ(texture.transform.rotation, 30.0f);
    EXPECT_EQ(texture.wrapU, Wrap::kClamp);
    EXPECT_EQ(texture.wrapV, Wrap::kMirror);
    EXPECT_EQ(texture.filter, Filter::kNearest);
    ASSERT_EQ(scene.imageSources.size(), 1u);
    EXPECT_EQ(scene.imageSources[0].path, folder_ / "wood.png");
    EXPECT_EQ(scene.imageSources[0].bytes, nullptr);
    EXPECT_THAT(scene.files, Contains(folder_ / "wood.png")) << "so that no output overwrites it";
    EXPECT_THAT(textsOf(scene.warnings), Contains(HasSubstr("material \"white\": 1 of its triangles has no")))
        << "the mesh has no second texture coordinates";
}

TEST_F(JsonImagesTest, DefaultsAreThoseOfTheWholeImage) {
    const LoadedScene scene =
        white(R"("diffuse": {"image": "wood.png", "wrap": "mirror"}, "metallic": {"image": "wood.png"})");
    EXPECT_EQ(material(scene).baseColor, glm::vec3(1.0f));
    EXPECT_EQ(material(scene).metallic, 1.0f);
    ASSERT_EQ(material(scene).textures.size(), 2u);
    Texture texture;
    texture.colourSpace = ColourSpace::kSrgb;
    texture.wrapU = texture.wrapV = Wrap::kMirror;
    EXPECT_EQ(material(scene).textures[0].texture, texture);
    EXPECT_EQ(material(scene).textures[1].texture, Texture());
    EXPECT_EQ(material(scene).textures[1].channel, 0u);
    EXPECT_THAT(scene.warnings, IsEmpty());
}

TEST_F(JsonImagesTest, EveryInputMayBeAnImage) {
    for (const MaterialInput input : kValuesOf<MaterialInput>) {
        const std::string key = nameOf(input);
        const std::string image = R"({"image": "wood.png"})";
        std::string keys = "\"" + key + "\": " + image;
        if (input == MaterialInput::kAlpha) keys = "\"alpha\": {\"value\": " + image + "}";
        if (input == MaterialInput::kEmission) keys = "\"emission\": {\"invisible\": " + image + "}";
        const LoadedScene scene = white(keys);
        ASSERT_EQ(material(scene).textures.size(), 1u) << key;
        EXPECT_EQ(material(scene).textures[0].input, input);
        const bool isColour = input == MaterialInput::kBaseColor || input == MaterialInput::kSpecularColor ||
                              input == MaterialInput::kSheenColor || input == MaterialInput::kEmission;
        EXPECT_EQ(material(scene).textures[0].texture.colourSpace,
                  isColour ? ColourSpace::kSrgb : ColourSpace::kLinear)
            << key;
    }
}

TEST_F(JsonImagesTest, ChannelsAndFactorsOfNumbers) {
    const LoadedScene scene = white(
        R"("roughness": {"image": "wood.png", "channel": "g", "factor": 0.25},
           "clearcoat": {"image": "wood.png", "channel": "a"},
           "normal": {"image": "other.jpg", "scale": -0.5})");
    const Material& surface = material(scene);
    ASSERT_EQ(surface.textures.size(), 3u);
    EXPECT_EQ(surface.textures[0].input, MaterialInput::kRoughness) << "in the order of inputs";
    EXPECT_EQ(surface.textures[0].channel, 1u);
    EXPECT_EQ(surface.roughness, 0.25f);
    EXPECT_EQ(surface.specular, 1.0f) << "as for a number";
    EXPECT_EQ(surface.textures[1].channel, 3u);
    EXPECT_EQ(surface.clearcoat, 1.0f);
    EXPECT_EQ(surface.textures[2].input, MaterialInput::kNormal);
    EXPECT_EQ(surface.normalScale, -0.5f);
    EXPECT_EQ(surface.textures[0].texture.image, surface.textures[1].texture.image) << "one source a file";
    EXPECT_EQ(scene.imageSources.size(), 2u);
}

TEST_F(JsonImagesTest, AFileIsOneSourceWhateverItsPath) {
    std::filesystem::create_directory(folder_ / "deep");
    const LoadedScene scene = white(
        R"("roughness": {"image": "wood.png"}, "metallic": {"image": "deep/../wood.png"}, "clearcoat": {"image": "deep\\..\\wood.png"})");
    EXPECT_EQ(scene.imageSources.size(), 1u);
    EXPECT_EQ(material(scene).textures.size(), 3u);
}

TEST_F(JsonImagesTest, NumbersReplaceTheImagesOfTheMesh) {
    write("mesh.mtl", "newmtl white\nKd 1 1 1\nmap_Kd wood.png\nnewmtl lamp\nKd 0 0 0\nKe 3 2 1\n");
    EXPECT_EQ(material(white("")).textures.size(), 1u);
    EXPECT_EQ(material(white(R"("roughness": 0.5)")).textures.size(), 1u);
    const LoadedScene scene = white(R"("base_color": 0.25)");
    EXPECT_THAT(material(scene).textures, IsEmpty());
    EXPECT_EQ(material(scene).baseColor, glm::vec3(0.25f));
    EXPECT_EQ(material(white(R"("base_color": {"image": "other.jpg"})")).textures.size(), 1u);
}

TEST_F(JsonImagesTest, AlphaIsUsedIfItIsGiven) {
    const auto alpha = [&](const std::string& keys) {
        return material(white("\"alpha\": {" + keys + "}")).alpha;
    };
    EXPECT_EQ(alpha(R"("mode": "mask", "value": 0.75, "cutoff": 0.25)"),
              (Alpha{AlphaMode::kMask, 0.75f, 0.25f}));
    EXPECT_EQ(alpha(R"("value": 0.75)").mode, AlphaMode::kBlend);
    EXPECT_EQ(alpha(R"("value": {"image": "wood.png", "channel": "a"})").mode, AlphaMode::kBlend);
    EXPECT_EQ(alpha(R"("value": 0.75, "cutoff": 0.5)").mode, AlphaMode::kMask);
    EXPECT_EQ(alpha(R"("mode": "opaque", "value": 0.75)").mode, AlphaMode::kOpaque);
}

TEST_F(JsonImagesTest, ComponentsOfEmissionShareAnImage) {
    const auto lamp = [&](const std::string& keys) {
        return material(read(R"({"lamp": {"emission": {)" + keys + "}}}"), "lamp");
    };
    const Material both =
        lamp(R"("invisible": {"image": "wood.png", "factor": [4, 5, 6]}, "visible": {"image": "wood.png"})");
    EXPECT_EQ(both.emission.invisible, glm::vec3(4, 5, 6));
    EXPECT_EQ(both.emission.visible, glm::vec3(1));
    EXPECT_NE(findTexture(both, MaterialInput::kEmission), nullptr);
    const Material one = lamp(R"("invisible": {"image": "wood.png", "factor": 1e12}, "visible": 0)");
    EXPECT_EQ(one.emission.invisible, glm::vec3(1e12f));
    EXPECT_NE(findTexture(one, MaterialInput::kEmission), nullptr);

    write("mesh.mtl", "newmtl white\nnewmtl lamp\nKe 3 2 1\nmap_Ke wood.png\n");
    EXPECT_NE(findTexture(lamp(R"("visible": 0)"), MaterialInput::kEmission), nullptr);
    EXPECT_EQ(findTexture(lamp(R"("visible": 2)"), MaterialInput::kEmission), nullptr);

    const auto error = [&](const std::string& keys) { return errorOfWhite("\"emission\": {" + keys + "}"); };
    EXPECT_THAT(
        error(R"("invisible": {"image": "wood.png"}, "visible": {"image": "other.jpg"})"),
        HasSubstr("materials.white.emission.visible: is another image than that of the other component"));
    EXPECT_THAT(error(R"("invisible": 3, "visible": {"image": "other.jpg"})"),
                HasSubstr("materials.white.emission.invisible: is a number beside an image"));
}

TEST_F(JsonImagesTest, ImagesOfUnusedMaterialsAreCheckedAndNotLoaded) {
    const LoadedScene scene = read(R"({"idle": {"base_color": {"image": "wood.png"}}})");
    EXPECT_THAT(scene.imageSources, IsEmpty());
    EXPECT_THAT(scene.files, Not(Contains(folder_ / "wood.png")));
    EXPECT_THAT(errorOfJson(R"({"duolux": 1, "objects": [{"mesh": "mesh.obj"}],
                               "materials": {"idle": {"base_color": {"image": "none.png"}}}})"),
                HasSubstr("materials.idle.base_color.image: there is no file none.png"));
}

TEST_F(JsonImagesTest, AreChecked) {
    EXPECT_THAT(
        errorOfWhite(R"("roughness": {"image": "none.png"})"),
        HasSubstr("materials.white.roughness.image: there is no file none.png; expected the path of an "
                  "image, relative to the scene file"));
    EXPECT_THAT(errorOfWhite(R"("roughness": {"image": 3})"),
                HasSubstr("materials.white.roughness.image: is 3; expected the path of an image"));
    EXPECT_THAT(
        errorOfWhite(R"("roughness": {"factor": 3})"),
        HasSubstr("materials.white.roughness: is an object; expected a number from 0 to 1, or {\"image\""));
    EXPECT_THAT(errorOfWhite(R"("roughness": {"image": "wood.png", "factor": 3})"),
                HasSubstr("materials.white.roughness.factor: is 3; expected a number from 0 to 1"));
    EXPECT_THAT(errorOfWhite(R"("roughness": {"image": "wood.png", "channel": "red"})"),
                HasSubstr("materials.white.roughness.channel: is \"red\"; did you mean \"r\"?"));
    EXPECT_THAT(errorOfWhite(R"("base_color": {"image": "wood.png", "channel": "r"})"),
                HasSubstr("materials.white.base_color.channel: unknown key"));
    EXPECT_THAT(errorOfWhite(R"("base_color": {"image": "wood.png", "uvscale": 2})"),
                HasSubstr("materials.white.base_color.uvscale: unknown key; did you mean \"uv_scale\"?"));
    EXPECT_THAT(errorOfWhite(R"("base_color": {"image": "wood.png", "uv_scale": 2})"),
                HasSubstr("materials.white.base_color.uv_scale: is 2; expected [u, v]"));
    EXPECT_THAT(errorOfWhite(R"("base_color": {"image": "wood.png", "uv_set": 2})"),
                HasSubstr("materials.white.base_color.uv_set: is 2; expected a whole number from 0 to 1"));
    EXPECT_THAT(errorOfWhite(R"("base_color": {"image": "wood.png", "wrap": ["clamp", "repaet"]})"),
                HasSubstr("materials.white.base_color.wrap[1]: is \"repaet\"; did you mean \"repeat\"?"));
    EXPECT_THAT(errorOfWhite(R"("base_color": {"image": "wood.png", "filter": "cubic"})"),
                HasSubstr("materials.white.base_color.filter: is \"cubic\"; expected one of"));
    EXPECT_THAT(errorOfWhite(R"("base_color": {"image": "wood.png", "uv_rotation": "90"})"),
                HasSubstr("materials.white.base_color.uv_rotation: is \"90\"; expected an angle in degrees"));
    EXPECT_THAT(errorOfWhite(R"("normal": {"scale": 2})"),
                HasSubstr("materials.white.normal: scales an image that the material does not have"));
    EXPECT_THAT(errorOfWhite(R"("normal": {"image": "wood.png", "factor": 2})"),
                HasSubstr("materials.white.normal.factor: unknown key"));
    EXPECT_THAT(errorOfWhite(R"("alpha": {"value": {"image": "none.png"}})"),
                HasSubstr("materials.white.alpha.value.image: there is no file none.png"));
}

TEST_F(JsonImagesTest, NeedTextureCoordinates) {
    write("mesh.obj",
          "mtllib mesh.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nusemtl white\nf 1 2 3\nf 1/1 2/1 3/1\nusemtl "
          "lamp\nf 3 2 1\n");
    EXPECT_THAT(
        textsOf(white(R"("base_color": {"image": "wood.png"})").warnings),
        ElementsAre(HasSubstr("scene.json: material \"white\": 1 of its triangles has no coordinates for "
                              "its images: (0, 0) is used")));
    EXPECT_THAT(white("").warnings, IsEmpty());
}

TEST_F(JsonImagesTest, SpecularHasNoEffectOnGlass) {
    const auto warnings = [&](const std::string& keys) { return textsOf(white(keys).warnings); };
    const auto isWarned = ElementsAre(HasSubstr(
        "material \"white\": specular and specular_color have no effect where light is transmitted"));
    EXPECT_THAT(warnings(R"("transmission": 0.5, "specular": 0.5)"), isWarned);
    EXPECT_THAT(warnings(R"("transmission": 1, "specular_color": [1, 0.5, 1])"), isWarned);
    EXPECT_THAT(warnings(R"("transmission": 1, "specular": {"image": "wood.png"})"), isWarned);
    EXPECT_THAT(warnings(R"("transmission": 1)"), IsEmpty());
    EXPECT_THAT(warnings(R"("transmission": 1, "specular": 0.5, "metallic": 1)"), IsEmpty());
    EXPECT_THAT(warnings(R"("specular": 0.5, "specular_color": [1, 0.5, 1])"), IsEmpty());
}

}  // namespace
}  // namespace duolux::test

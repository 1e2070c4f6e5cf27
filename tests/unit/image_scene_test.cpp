#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <png.h>

#include "host/base/error.h"
#include "host/image/scene_images.h"
#include "host/scene/compose.h"
#include "tests/unit/image_files.h"

// The images of a scene: each source once, and materials without the images that cannot be read.

namespace duolux::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

ImageSource sourceOf(const std::string& name, std::string bytes) {
    return {name, {}, std::make_shared<const std::string>(std::move(bytes))};
}

std::string onePixel(std::uint16_t red) {
    return pngOf(1, 1, 8, PNG_COLOR_TYPE_RGB, {red, 0, 0});
}

Material materialWith(const std::vector<std::uint32_t>& images) {
    Material material;
    for (std::size_t i = 0; i < images.size(); ++i) {
        MaterialTexture entry{kValuesOf<MaterialInput>[i], {}, 0};
        entry.texture.image = images[i];
        entry.texture.colourSpace = ColourSpace::kSrgb;
        material.textures.push_back(entry);
    }
    return material;
}

Mesh meshWith(std::vector<ImageSource> images, const Material& material) {
    Mesh mesh;
    mesh.geometry.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    mesh.geometry.triangles = {{0, 1, 2}};
    mesh.geometry.materials = {0};
    mesh.materials = {material};
    mesh.images = std::move(images);
    return mesh;
}

TEST(SceneImages, MeshesShareImagesAndMaterials) {
    const ImageSource a = sourceOf("a", onePixel(1)), b = sourceOf("b", onePixel(2));
    ImageSource file{"c", "c.png", nullptr};
    LoadedScene scene;
    Composer composer(scene);
    composer.append(meshWith({a, b}, materialWith({1})));
    // The same materials after their images have the same numbers.
    composer.append(meshWith({b, a, file}, materialWith({0})));
    composer.append(meshWith({file, b}, materialWith({0, 1})));
    composer.append(meshWith({sourceOf("a", onePixel(1))}, materialWith({0})));  // other bytes
    ASSERT_EQ(scene.materials.size(), 3u);
    ASSERT_EQ(scene.imageSources.size(), 4u);
    EXPECT_EQ(scene.imageSources[2].path, "c.png");
    EXPECT_THAT(scene.geometry.materials, ElementsAre(0, 0, 1, 2));
    EXPECT_EQ(scene.materials[0].textures[0].texture.image, 1u);
    EXPECT_EQ(scene.materials[1].textures[0].texture.image, 2u);
    EXPECT_EQ(scene.materials[1].textures[1].texture.image, 1u);
    EXPECT_EQ(scene.materials[2].textures[0].texture.image, 3u);
}

LoadedScene sceneWith(std::vector<ImageSource> sources, std::vector<Material> materials) {
    LoadedScene scene;
    scene.imageSources = std::move(sources);
    scene.materials = std::move(materials);
    return scene;
}

TEST(SceneImages, UnreadableImagesLeaveMaterialsWithOneWarningEach) {
    LoadedScene scene = sceneWith({sourceOf("bad", "nonsense"),
                                   sourceOf("a", onePixel(1)),
                                   {"no.png", "/no/such/no.png", nullptr},
                                   sourceOf("b", exrOf(1, 1, "BGR", true, {1, 2, 3}))},
                                  {materialWith({0, 1, 3}), materialWith({0, 2})});
    decodeImages(scene, Reading::kLenient);
    ASSERT_EQ(scene.images.size(), 2u);
    ASSERT_EQ(scene.imageSources.size(), 2u);
    EXPECT_EQ(scene.images[0]->bytes[0], 1);
    EXPECT_EQ(scene.images[1]->floats[0], 3.0f);
    ASSERT_EQ(scene.warnings.size(), 2u);
    EXPECT_THAT(scene.warnings[0].text, HasSubstr("bad: is not an image of a known format"));
    EXPECT_THAT(scene.warnings[1].text, HasSubstr("/no/such/no.png: cannot open"));
    ASSERT_EQ(scene.materials[0].textures.size(), 2u);
    EXPECT_EQ(scene.materials[0].textures[0].input, MaterialInput::kAlpha);
    EXPECT_EQ(scene.materials[0].textures[0].texture.image, 0u);
    EXPECT_EQ(scene.materials[0].textures[0].texture.colourSpace, ColourSpace::kSrgb);
    EXPECT_EQ(scene.materials[0].textures[1].texture.image, 1u);
    EXPECT_EQ(scene.materials[0].textures[1].texture.colourSpace, ColourSpace::kLinear);
    EXPECT_TRUE(scene.materials[1].textures.empty());
}

TEST(SceneImages, StrictReadingRefusesThem) {
    LoadedScene scene = sceneWith({sourceOf("bad", "nonsense")}, {materialWith({0})});
    EXPECT_THROW(decodeImages(scene, Reading::kStrict), InputError);
}

TEST(SceneImages, ManyAreDecodedInOrder) {
    std::vector<ImageSource> sources;
    for (std::uint16_t i = 0; i < 100; ++i)
        sources.push_back(sourceOf(std::to_string(i), onePixel(i)));
    LoadedScene scene = sceneWith(std::move(sources), {});
    decodeImages(scene, Reading::kStrict);
    for (std::size_t i = 0; i < 100; ++i)
        EXPECT_EQ(scene.images[i]->bytes[0], i);
}

}  // namespace
}  // namespace duolux::test

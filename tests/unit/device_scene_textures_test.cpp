#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>

#include "host/base/error.h"
#include "host/device_scene/textures.h"

// Which images are made smaller where memory is short, and what becomes of their pixels.

namespace duolux {
namespace {

using testing::HasSubstr;

std::shared_ptr<const Image> uniformImage(std::uint32_t width, std::uint32_t height, std::uint8_t value) {
    Image image;
    image.name = std::to_string(width);
    image.width = width;
    image.height = height;
    image.bytes.assign(std::size_t{4} * width * height, value);
    return std::make_shared<const Image>(std::move(image));
}

/// A material with a triangle for each image.
Scene sceneOf(std::vector<std::shared_ptr<const Image>> images, ColourSpace space = ColourSpace::kLinear) {
    Scene scene;
    for (std::uint32_t i = 0; i < images.size(); ++i) {
        Material material;
        MaterialTexture entry;
        entry.texture.image = i;
        entry.texture.colourSpace = space;
        material.textures = {entry};
        scene.materials.push_back(material);
        scene.geometry.materials.push_back(i);
    }
    scene.images = std::move(images);
    return scene;
}

TEST(Atlas, LargestImagesShrinkFirst) {
    // 64 x 64 / 4 = 1024 texels, 32 x 32 / 4 = 256, 16 x 16 / 4 = 64.
    const Scene scene = sceneOf({uniformImage(32, 32, 1), uniformImage(64, 64, 2), uniformImage(16, 16, 3)});
    const AtlasPlan whole = planAtlas(scene, 1344);
    EXPECT_EQ(whole.texels, 1344u);
    EXPECT_EQ(whole.warning, "");
    EXPECT_EQ(whole.images[1].firstTexel, 256u);
    EXPECT_EQ(whole.images[2].firstTexel, 1280u);
    const AtlasPlan smaller = planAtlas(scene, 1343);
    EXPECT_EQ(smaller.texels, 256u + 256 + 64);
    EXPECT_EQ(smaller.images[1].size(), glm::uvec2(32));
    EXPECT_EQ(smaller.images[0].size(), glm::uvec2(32));
    EXPECT_THAT(smaller.warning, HasSubstr("1 of 3 images are made smaller"));
    EXPECT_THAT(smaller.warning, HasSubstr("64 from 64 x 64 to 32 x 32 pixels"));
    const AtlasPlan smallest = planAtlas(scene, 3);
    EXPECT_EQ(smallest.texels, 3u);
    EXPECT_THROW(planAtlas(scene, 2), DeviceError);
}

TEST(Atlas, OnlyUsedImagesCountAndEachOnce) {
    Scene scene = sceneOf({uniformImage(32, 32, 1), uniformImage(64, 64, 2)});
    scene.geometry.materials = {0, 0};
    scene.materials[0].textures.push_back(scene.materials[0].textures[0]);
    EXPECT_EQ(planAtlas(scene, 4096).texels, 256u);
}

TEST(Atlas, SidesAreRoundedUp) {
    const AtlasImage image{uniformImage(5, 1, 0), false, 1, 0};
    EXPECT_EQ(image.size(), glm::uvec2(3, 1));
    EXPECT_EQ(image.texels(), 2u);
}

std::uint32_t byteOf(const std::vector<glm::uvec4>& texels, int channel) {
    return texels[0].x >> (8 * channel) & 255u;
}

/// A chequered image becomes the mean light: one half, which as an sRGB code is 188. Alpha is linear.
TEST(Atlas, ShrinksInLinearLight) {
    Image image;
    image.width = image.height = 2;
    image.bytes = {0, 0, 255, 0, 255, 0, 255, 255, 255, 0, 255, 255, 0, 0, 255, 0};
    const auto shared = std::make_shared<const Image>(image);
    const auto shrunk = [&](ColourSpace space) {
        AtlasPlan plan = planAtlas(sceneOf({shared}, space), 4);
        plan.images[0].halvings = 1;
        std::vector<glm::uvec4> texels(plan.texels);
        writeAtlas(plan, texels);
        return texels;
    };
    EXPECT_EQ(byteOf(shrunk(ColourSpace::kSrgb), 0), 188u);
    EXPECT_EQ(byteOf(shrunk(ColourSpace::kSrgb), 1), 0u);
    EXPECT_EQ(byteOf(shrunk(ColourSpace::kSrgb), 2), 255u);
    EXPECT_EQ(byteOf(shrunk(ColourSpace::kSrgb), 3), 128u);
    EXPECT_EQ(byteOf(shrunk(ColourSpace::kLinear), 0), 128u);
}

/// Three pixels become two: each covers one and a half.
TEST(Atlas, WeightsPixelsByTheirArea) {
    Image image;
    image.width = 3;
    image.height = 1;
    image.floats = {0, 0, 0, 1, 0.9f, 0, 0, 1, 0.3f, 0, 0, 1};
    AtlasPlan plan = planAtlas(sceneOf({std::make_shared<const Image>(image)}), 2);
    EXPECT_EQ(plan.images[0].size(), glm::uvec2(2, 1));
    std::vector<glm::uvec4> texels(plan.texels);
    writeAtlas(plan, texels);
    EXPECT_NEAR(std::bit_cast<float>(texels[0].x), 0.9f / 3.0f, 1e-6f);
    EXPECT_NEAR(std::bit_cast<float>(texels[1].x), (0.45f + 0.3f) / 1.5f, 1e-6f);
    EXPECT_EQ(std::bit_cast<float>(texels[1].w), 1.0f);
}

TEST(Atlas, DevicesLimitIt) {
    DeviceInfo device;
    device.maxTexelBufferElements = 1000;
    device.memoryBytes = 8 << 20;
    EXPECT_EQ(largestAtlas(device, 7 << 20), 1000u);  // of a software driver, memory is not a limit
    device.kind = DeviceKind::kGpu;
    EXPECT_EQ(largestAtlas(device, 0), 1000u);
    device.maxTexelBufferElements = std::uint64_t{1} << 40;
    EXPECT_EQ(largestAtlas(device, 3 << 20), (std::uint64_t{4} << 20) / 16);
    EXPECT_EQ(largestAtlas(device, 8 << 20), 0u);
    device.memoryBytes = std::uint64_t{1} << 40;
    EXPECT_EQ(largestAtlas(device, 0), 0x7fffffffu);
}

}  // namespace
}  // namespace duolux

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "host/base/srgb.h"
#include "host/device_scene/material_records.h"
#include "host/device_scene/textures.h"
#include "tests/shader/inputs.h"
#include "tests/shader/oracles.h"
#include "tests/support/scene_builder.h"

// Lookups in an atlas that the host made, against the images in double precision; and which lookups a
// material has.

namespace duolux::test {
namespace {

std::shared_ptr<const Image> randomImage(std::mt19937& random, bool floats) {
    Image image;
    image.width = 1 + random() % 9;
    image.height = 1 + random() % 9;
    for (std::size_t i = 0; i < std::size_t{4} * image.width * image.height; ++i) {
        if (floats) {
            image.floats.push_back(static_cast<float>(random() % 4096) / 4096.0f);
        } else {
            image.bytes.push_back(static_cast<std::uint8_t>(random()));
        }
    }
    return std::make_shared<const Image>(std::move(image));
}

/// A scene with a triangle for each material.
Scene sceneOf(std::vector<duolux::Material> materials, std::vector<std::shared_ptr<const Image>> images) {
    SceneBuilder builder;
    for (const duolux::Material& material : materials)
        builder.triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, builder.add(material));
    builder.scene.images = std::move(images);
    return builder.scene;
}

duolux::Material textured(std::vector<MaterialTexture> textures) {
    duolux::Material material;
    material.textures = std::move(textures);
    return material;
}

/// Every combination of wraps, filter, colour space and kind of pixels.
Scene randomTextures() {
    std::mt19937 random(5);
    std::vector<duolux::Material> materials;
    std::vector<std::shared_ptr<const Image>> images;
    const auto uniform = [&](float low, float high) {
        return low + (high - low) * static_cast<float>(random() >> 8) * 0x1p-24f;
    };
    for (const Wrap wrapU : kValuesOf<Wrap>) {
        for (const Wrap wrapV : kValuesOf<Wrap>) {
            for (const Filter filter : kValuesOf<Filter>) {
                for (const ColourSpace space : {ColourSpace::kLinear, ColourSpace::kSrgb}) {
                    for (const bool floats : {false, true}) {
                        duolux::Texture texture;
                        texture.image = static_cast<std::uint32_t>(images.size());
                        texture.colourSpace = space;
                        texture.wrapU = wrapU;
                        texture.wrapV = wrapV;
                        texture.filter = filter;
                        texture.transform = {{uniform(-2, 2), uniform(-2, 2)},
                                             {uniform(-3, 3), uniform(-3, 3)},
                                             uniform(-180, 180)};
                        images.push_back(randomImage(random, floats));
                        materials.push_back(textured({{MaterialInput::kBaseColor, texture}}));
                    }
                }
            }
        }
    }
    return sceneOf(std::move(materials), std::move(images));
}

std::int64_t wrapped(Wrap wrap, std::int64_t i, std::int64_t n) {
    const auto modulo = [](std::int64_t a, std::int64_t b) { return ((a % b) + b) % b; };
    switch (wrap) {
        case Wrap::kRepeat:
            return modulo(i, n);
        case Wrap::kClamp:
            return std::clamp<std::int64_t>(i, 0, n - 1);
        case Wrap::kMirror:
            break;
    }
    const std::int64_t inPeriod = modulo(i, 2 * n);
    return inPeriod < n ? inPeriod : 2 * n - 1 - inPeriod;
}

glm::dvec4 pixelOf(const Image& image, ColourSpace space, std::int64_t x, std::int64_t y) {
    glm::dvec4 value;
    for (int c = 0; c < 4; ++c) {
        const std::size_t at = 4 * (static_cast<std::size_t>(y) * image.width + static_cast<std::size_t>(x)) +
                               static_cast<std::size_t>(c);
        value[c] = image.floats.empty() ? image.bytes[at] / 255.0 : static_cast<double>(image.floats[at]);
        if (space == ColourSpace::kSrgb && c < 3) value[c] = srgbDecode(value[c]);
    }
    return value;
}

/// The expected value, and how far the place is from a border at which it jumps, in pixels.
glm::dvec4 expectedValue(const Scene& scene, const duolux::Texture& texture, glm::dvec2 uv, double& margin) {
    const Image& image = *scene.images[texture.image];
    const double angle = static_cast<double>(texture.transform.rotation) * std::numbers::pi / 180.0;
    // (1, 0) turns towards -v.
    const glm::dvec2 scaledUv = glm::dvec2(texture.transform.scale) * uv;
    const glm::dvec2 place = glm::dvec2(texture.transform.offset) +
                             scaledUv.x * glm::dvec2(std::cos(angle), -std::sin(angle)) +
                             scaledUv.y * glm::dvec2(std::sin(angle), std::cos(angle));
    const glm::dvec2 at = place * glm::dvec2(image.width, image.height);
    margin = 1.0;
    const auto pixel = [&](double x, double y) {
        return pixelOf(image, texture.colourSpace,
                       wrapped(texture.wrapU, static_cast<std::int64_t>(x), image.width),
                       wrapped(texture.wrapV, static_cast<std::int64_t>(y), image.height));
    };
    if (texture.filter == Filter::kNearest) {
        margin = std::min(std::abs(at.x - std::round(at.x)), std::abs(at.y - std::round(at.y)));
        return pixel(std::floor(at.x), std::floor(at.y));
    }
    const glm::dvec2 first = glm::floor(at - 0.5);
    const glm::dvec2 f = at - 0.5 - first;
    return (1.0 - f.y) * ((1.0 - f.x) * pixel(first.x, first.y) + f.x * pixel(first.x + 1, first.y)) +
           f.y * ((1.0 - f.x) * pixel(first.x, first.y + 1) + f.x * pixel(first.x + 1, first.y + 1));
}

TEST(Textures, LookupsAreThoseOfDoublePrecision) {
    const Scene scene = randomTextures();
    const AtlasPlan plan = planAtlas(scene, 1 << 20);
    std::vector<glm::uvec4> atlas(plan.texels);
    writeAtlas(plan, atlas);
    const TextureTable table = makeTextureTable(scene, plan);
    ASSERT_EQ(table.records.size(), scene.materials.size());
    ShaderLibrary library("shaders/lib/texture.glsl");
    library.texels("fetchTextureTexel", std::span(table.records))
        .texels("fetchAtlasTexel", std::span(std::as_const(atlas)));
    std::vector<std::uint32_t> indices;
    std::vector<glm::vec2> uvs;
    for (const glm::vec2 u : randomSquare(1 << 15, 9)) {
        indices.push_back(static_cast<std::uint32_t>(indices.size() % table.records.size()));
        uvs.push_back(4.0f * u - 2.0f);
    }
    const auto values =
        library.evaluate<glm::vec4>("result = sampleTexture(fetchTexture(x0), x1);", indices, uvs);
    std::size_t compared = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
        const duolux::Texture& texture = scene.materials[indices[i]].textures[0].texture;
        double margin = 0.0;
        const glm::dvec4 expected = expectedValue(scene, texture, glm::dvec2(uvs[i]), margin);
        if (margin < 1e-4) continue;
        ++compared;
        for (int c = 0; c < 4; ++c) {
            const double decoding =
                texture.colourSpace == ColourSpace::kSrgb && c < 3 ? 8e-4 * expected[c] : 0.0;
            ASSERT_NEAR(static_cast<double>(values[i][c]), expected[c], 3e-5 + decoding)
                << "texture " << indices[i] << ", channel " << c << ", lookup " << i;
        }
    }
    EXPECT_GT(compared, values.size() * 99 / 100);
}

duolux::Texture textureOf(std::uint32_t image, ColourSpace space = ColourSpace::kLinear) {
    duolux::Texture texture;
    texture.image = image;
    texture.colourSpace = space;
    return texture;
}

/// The component that a record has no channel for.
constexpr std::uint32_t kAbsent = shared::kNoChannel;

std::array<std::uint32_t, 4> swizzleOf(const shared::DeviceTexture& record) {
    std::array<std::uint32_t, 4> swizzle{};
    for (std::uint32_t i = 0; i < 4; ++i)
        swizzle[i] = record.flags >> (shared::kTextureSwizzleShift + i * shared::kTextureSwizzleBits) & 7u;
    return swizzle;
}

TEST(Textures, InputsOfAGroupFromOneImageAreOneLookup) {
    using enum MaterialInput;
    std::mt19937 random(7);
    duolux::Texture elsewhere = textureOf(1);
    elsewhere.transform.offset.x = 0.5f;
    const Scene scene =
        sceneOf({textured({{kBaseColor, textureOf(0, ColourSpace::kSrgb)},
                           {kAlpha, textureOf(0), 3},
                           {kMetallic, textureOf(1), 2},
                           {kRoughness, textureOf(1), 1},
                           {kTransmission, elsewhere, 0}}),
                 textured({{kAlpha, textureOf(0), 1}}),
                 textured({{kBaseColor, textureOf(0, ColourSpace::kSrgb)}, {kAlpha, textureOf(0), 0}})},
                {randomImage(random, false), randomImage(random, false)});
    const TextureTable table = makeTextureTable(scene, planAtlas(scene, 1 << 20));
    ASSERT_EQ(table.records.size(), 6u);
    const auto expect = [&](std::size_t record, std::uint32_t group, std::array<std::uint32_t, 4> swizzle) {
        EXPECT_EQ(table.records[record].flags & shared::kTextureGroupMask, group) << record;
        EXPECT_EQ(swizzleOf(table.records[record]), swizzle) << record;
    };
    expect(0, shared::kGroupBase, {0, 1, 2, 3});
    EXPECT_NE(table.records[0].flags & shared::kTextureSrgb, 0u);
    expect(1, shared::kGroupSurface, {2, 1, kAbsent, kAbsent});
    expect(2, shared::kGroupSurface, {kAbsent, kAbsent, 0, kAbsent});
    expect(3, shared::kGroupBase, {kAbsent, kAbsent, kAbsent, 1});
    // Red as alpha is not decoded, unlike red as a colour.
    expect(4, shared::kGroupBase, {0, 1, 2, kAbsent});
    expect(5, shared::kGroupBase, {kAbsent, kAbsent, kAbsent, 0});
    EXPECT_EQ(table.ranges[1].first, 3u);
    EXPECT_EQ(table.ranges[1].count, 1u);
    EXPECT_EQ(table.groups, 1u << shared::kGroupBase | 1u << shared::kGroupSurface);
}

TEST(Textures, LookupsUseTheirOwnCoordinates) {
    Image image;
    image.width = 2;
    image.height = 1;
    image.floats = {0.25f, 0.25f, 0.25f, 1.0f, 0.75f, 0.75f, 0.75f, 1.0f};
    duolux::Texture first = textureOf(0), second = textureOf(0);
    first.filter = second.filter = Filter::kNearest;
    second.uvSet = 1;
    const Scene scene =
        sceneOf({textured({{MaterialInput::kBaseColor, first, 0}, {MaterialInput::kEmission, second, 0}})},
                {std::make_shared<const Image>(image)});
    const AtlasPlan plan = planAtlas(scene, 1 << 10);
    const TextureTable table = makeTextureTable(scene, plan);
    std::vector<shared::DeviceMaterial> materials = makeMaterialRecords(scene);
    materials[0].textureCount = table.ranges[0].count;
    std::vector<glm::uvec4> atlas(plan.texels);
    writeAtlas(plan, atlas);
    ShaderLibrary library("shaders/lib/material_textures.glsl");
    library.texels("fetchTextureTexel", std::span(table.records))
        .texels("fetchAtlasTexel", std::span(std::as_const(atlas)))
        .texels("fetchMaterialTexel", std::span(std::as_const(materials)))
        .constant(shared::kSpecTextureGroups, table.groups);
    const glm::vec2 values = library.evaluate<glm::vec2>(
        "TextureValues v = sampleTextures(0u, ~0u, x0, x1); result = vec2(v.base.x, v.emission.y);",
        glm::vec2(0.25f, 0.5f), glm::vec2(0.75f, 0.5f))[0];
    EXPECT_EQ(values, glm::vec2(0.25f, 0.75f));
}

/// A texture of one pixel whose channels are these bytes.
std::shared_ptr<const Image> pixelImage(std::array<std::uint8_t, 4> bytes) {
    Image image;
    image.width = image.height = 1;
    image.bytes.assign(bytes.begin(), bytes.end());
    return std::make_shared<const Image>(std::move(image));
}

TEST(Textures, EveryInputReachesItsComponent) {
    constexpr std::array<const char*, 8> kFields{"base",   "surface",    "specular", "sheen",
                                                 "normal", "anisotropy", "emission", "coatNormal"};
    // All inputs, each from its own image: a number from the channel of its turn.
    std::vector<MaterialTexture> entries;
    std::vector<std::shared_ptr<const Image>> images;
    for (const MaterialInput input : kValuesOf<MaterialInput>) {
        const auto i = static_cast<std::uint32_t>(images.size());
        const auto byte = [&](std::uint32_t c) { return static_cast<std::uint8_t>(4 * i + c + 100); };
        images.push_back(pixelImage({byte(0), byte(1), byte(2), byte(3)}));
        entries.push_back({input, textureOf(i), i % 4});
    }
    const Scene scene = sceneOf({duolux::Material(), textured(entries)}, images);
    const AtlasPlan plan = planAtlas(scene, 1 << 10);
    const TextureTable table = makeTextureTable(scene, plan);
    EXPECT_EQ(table.groups, (1u << shared::kTextureGroupCount) - 1);
    std::vector<shared::DeviceMaterial> materials = makeMaterialRecords(scene);
    for (std::size_t i = 0; i < materials.size(); ++i) {
        materials[i].firstTexture = table.ranges[i].first;
        materials[i].textureCount = table.ranges[i].count;
    }
    std::vector<glm::uvec4> atlas(plan.texels);
    writeAtlas(plan, atlas);
    ShaderLibrary library("shaders/lib/material_textures.glsl");
    library.texels("fetchTextureTexel", std::span(table.records))
        .texels("fetchAtlasTexel", std::span(std::as_const(atlas)))
        .texels("fetchMaterialTexel", std::span(std::as_const(materials)))
        .constant(shared::kSpecTextureGroups, table.groups);
    // The byte of a component, by hand: inputs in the order of MaterialInput.
    const auto colour = [](double input) {
        return glm::dvec3(4 * input + 100, 4 * input + 101, 4 * input + 102) / 255.0;
    };
    const auto number = [](int input) { return (4 * input + input % 4 + 100) / 255.0; };
    const std::array<glm::dvec4, 8> expected{
        glm::dvec4(colour(0), number(1)),  glm::dvec4(number(2), number(3), number(6), number(7)),
        glm::dvec4(colour(5), number(4)),  glm::dvec4(colour(9), number(10)),
        glm::dvec4(colour(12), number(8)), glm::dvec4(colour(11), 1.0),
        glm::dvec4(colour(13), 1.0),       glm::dvec4(colour(14), 1.0)};
    // A material without textures, one with all, and this one where the group is not asked for.
    const std::vector<std::uint32_t> asked{0, 1, 1};
    for (std::size_t group = 0; group < kFields.size(); ++group) {
        const auto values = library.evaluate<glm::vec4>(
            fmt::format("result = sampleTextures(x0, x1, vec2(0.5), vec2(0.5)).{};", kFields[group]), asked,
            std::vector<std::uint32_t>{table.groups, table.groups, table.groups & ~(1u << group)});
        const glm::vec4 neutral = group == shared::kGroupNormal || group == shared::kGroupCoatNormal
                                      ? glm::vec4(0.5, 0.5, 1, 1)
                                  : group == shared::kGroupAnisotropy ? glm::vec4(1, 0.5, 1, 1)
                                                                      : glm::vec4(1.0);
        EXPECT_EQ(values[0], neutral) << kFields[group];
        EXPECT_LT(glm::length(glm::dvec4(values[1]) - expected[group]), 1e-6) << kFields[group];
        EXPECT_EQ(values[2], neutral) << kFields[group];
    }
}

}  // namespace
}  // namespace duolux::test
